#include "haptics/devices/openigtlink/igtl_messages.h"

#include <cstring>
#include <openigtlink/igtl_header.h>
#include <openigtlink/igtl_position.h>
#include <openigtlink/igtl_sensor.h>
#include <openigtlink/igtl_transform.h>
#include <openigtlink/igtl_unit.h>
#include <openigtlink/igtl_util.h>
#include <string_view>

namespace palp
{
namespace
{

constexpr double kMillimeter = 1e-3; // of the wire [m]
constexpr double kFarthest = 10.0;   // that a tracker sees [m]

// of a field that its name may fill
template <std::size_t Size>
std::string_view textOf(const char (&field)[Size]) noexcept
{
  return { field, strnlen(field, Size) };
}

igtl_header headerOf(Bytes message) noexcept
{
  igtl_header header{};
  std::memcpy(&header, message.data(), sizeof(header));
  igtl_header_convert_byte_order(&header);
  return header;
}

std::size_t bigEndian(Bytes bytes, std::size_t size) noexcept
{
  std::size_t value = 0;
  for (const std::byte byte : bytes.first(size))
  {
    value = value << 8 | std::to_integer<std::size_t>(byte);
  }
  return value;
}

// without what version 3 of the protocol puts around it, in messages whose header has version 2
Bytes contentOf(const igtl_header& header, Bytes body) noexcept
{
  constexpr std::size_t kExtended = 12;
  if (header.version < 2)
  {
    return body;
  }
  if (body.size() < kExtended)
  {
    return {};
  }
  const std::size_t front = bigEndian(body, 2);
  const std::size_t back = bigEndian(body.subspan(2), 2) + bigEndian(body.subspan(4), 4);
  return front >= kExtended && front <= body.size() && back <= body.size() - front
    ? body.subspan(front, body.size() - front - back)
    : Bytes{};
}

std::optional<TrackedPose> checked(
  const Eigen::Vector3d& millimeters, const Eigen::Quaterniond& orientation) noexcept
{
  constexpr double kUnit = 0.01; // by which it may miss it
  const TrackedPose pose{ kMillimeter * millimeters, orientation.normalized() };
  const bool possible = pose.position.allFinite() && pose.position.norm() <= kFarthest &&
    std::abs(orientation.norm() - 1.0) < kUnit;
  return possible ? std::optional(pose) : std::nullopt;
}

// three columns of a rotation, then the place
std::optional<TrackedPose> transformOf(Bytes content) noexcept
{
  std::array<igtl_float32, 12> words{};
  if (content.size() != sizeof(words))
  {
    return std::nullopt;
  }
  std::memcpy(words.data(), content.data(), sizeof(words));
  igtl_transform_convert_byte_order(words.data());
  const auto all = Eigen::Map<const Eigen::Matrix<float, 3, 4>>(words.data()).cast<double>();
  const Eigen::Matrix3d rotation = all.leftCols<3>();
  constexpr double kOrthonormal = 0.01;
  const double off = (rotation.transpose() * rotation - Eigen::Matrix3d::Identity()).norm();
  return off < kOrthonormal && rotation.determinant() > 0.0
    ? checked(all.col(3), Eigen::Quaterniond(rotation))
    : std::nullopt;
}

// place, then no orientation, three parts of a unit quaternion, or all four
std::optional<TrackedPose> placeOf(Bytes content) noexcept
{
  igtl_position words{ { 0, 0, 0 }, { 0, 0, 0, 1 } };
  if (content.size() > sizeof(words))
  {
    return std::nullopt;
  }
  std::memcpy(&words, content.data(), content.size());
  switch (content.size())
  {
    case IGTL_POSITION_MESSAGE_POSITON_ONLY_SIZE:
      igtl_position_convert_byte_order_position_only(&words);
      break;
    case IGTL_POSITION_MESSAGE_WITH_QUATERNION3_SIZE:
      igtl_position_convert_byte_order_quaternion3(&words);
      words.quaternion[3] = std::sqrt(std::max(0.0F,
        1.0F - words.quaternion[0] * words.quaternion[0] -
          words.quaternion[1] * words.quaternion[1] - words.quaternion[2] * words.quaternion[2]));
      break;
    case IGTL_POSITION_MESSAGE_DEFAULT_SIZE:
      igtl_position_convert_byte_order(&words);
      break;
    default:
      return std::nullopt;
  }
  const Eigen::Vector3d place(words.position[0], words.position[1], words.position[2]);
  return checked(
    place, { words.quaternion[3], words.quaternion[0], words.quaternion[1], words.quaternion[2] });
}

} // namespace

bool IgtlReader::take(Bytes bytes, std::optional<TrackedPose>& newest) noexcept
{
  while (!bytes.empty())
  {
    if (filled_ < kHeader)
    {
      const std::size_t size = std::min(bytes.size(), kHeader - filled_);
      std::ranges::copy(bytes.first(size), message_.begin() + static_cast<long>(filled_));
      filled_ += size;
      bytes = bytes.subspan(size);
      if (filled_ == kHeader && !beginBody())
      {
        return false;
      }
    }
    const auto size = static_cast<std::size_t>(std::min<std::uint64_t>(bytes.size(), left_));
    if (kept_ && filled_ >= kHeader)
    {
      std::ranges::copy(bytes.first(size), message_.begin() + static_cast<long>(filled_));
      filled_ += size;
    }
    left_ -= size;
    bytes = bytes.subspan(size);
    if (filled_ >= kHeader && left_ == 0)
    {
      const auto pose = kept_ ? endBody() : std::nullopt;
      newest = pose ? pose : newest;
      filled_ = 0;
    }
  }
  return true;
}

bool IgtlReader::beginBody() noexcept
{
  constexpr std::uint16_t kNewest = 3;
  const igtl_header header = headerOf(message_);
  const std::string_view type = textOf(header.name);
  left_ = header.body_size;
  kept_ = (type == "TRANSFORM" || type == "POSITION" || type == "QTRANS") &&
    left_ <= kLargestBody && isOurs(textOf(header.device_name));
  return header.version >= 1 && header.version <= kNewest && !type.empty() &&
    std::ranges::all_of(type, [](char letter) { return letter >= ' ' && letter <= '~'; });
}

std::optional<TrackedPose> IgtlReader::endBody() noexcept
{
  const igtl_header header = headerOf(message_);
  const MutableBytes body = MutableBytes(message_).subspan(kHeader, filled_ - kHeader);
  if (crc64(reinterpret_cast<unsigned char*>(body.data()), body.size(), 0) != header.crc)
  {
    return std::nullopt;
  }
  const Bytes content = contentOf(header, body);
  auto pose = textOf(header.name) == "TRANSFORM" ? transformOf(content) : placeOf(content);
  if (pose && !named_)
  {
    tool_ = textOf(header.device_name);
    named_ = true;
  }
  return pose;
}

bool IgtlReader::isOurs(std::string_view name) noexcept
{
  return !named_ || name == tool_;
}

std::array<std::byte, kIgtlForce> encodeIgtlForce(const Eigen::Vector3d& force) noexcept
{
  igtl_unit_data newton{};
  igtl_unit_init(&newton);
  newton.unit[0] = IGTL_UNIT_SI_DERIVED_NEWTON;
  newton.exp[0] = 1;
  igtl_sensor_header sensor{};
  sensor.larray = 3;
  sensor.unit = igtl_unit_pack(&newton);
  std::array<igtl_float64, 3> values{ force.x(), force.y(), force.z() };
  igtl_sensor_convert_byte_order(&sensor, values.data());

  std::array<std::byte, kIgtlForce> message{};
  auto* body = reinterpret_cast<unsigned char*>(message.data()) + IGTL_HEADER_SIZE;
  constexpr std::size_t kBody = kIgtlForce - IGTL_HEADER_SIZE;
  std::memcpy(body, &sensor, IGTL_SENSOR_HEADER_SIZE);
  std::memcpy(body + IGTL_SENSOR_HEADER_SIZE, values.data(), sizeof(values));

  igtl_header header{};
  header.version = IGTL_HEADER_VERSION;
  std::memcpy(header.name, "SENSOR", sizeof("SENSOR"));
  std::memcpy(header.device_name, "Force", sizeof("Force"));
  header.body_size = kBody;
  header.crc = crc64(body, kBody, 0);
  igtl_header_convert_byte_order(&header);
  std::memcpy(message.data(), &header, IGTL_HEADER_SIZE);
  return message;
}

} // namespace palp
