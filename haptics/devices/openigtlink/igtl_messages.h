#pragma once

#include "haptics/devices/bytes.h"

#include <Eigen/Geometry>
#include <optional>
#include <string>

namespace palp
{

/// Where a tracker has seen a tool.
struct TrackedPose
{
  Eigen::Vector3d position = Eigen::Vector3d::Zero();              ///< [m]
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity(); ///< unit
};

/// Finds the poses of one tool in what an OpenIGTLink peer sends, however split or joined.
///
/// TRANSFORM and POSITION are read, with header versions 1 and 2; all else is skipped, however
/// large, and so is a pose whose checksum does not fit or that no tool can have.
/// @source  OpenIGTLink protocol, Documents/Protocol: header, transform, position, and the extended
///          header of version 3
class IgtlReader
{
public:
  /// @param tool  name of the device in the messages, of 20 bytes at most; empty: of the first pose
  explicit IgtlReader(std::string tool = {})
    : tool_(std::move(tool))
    , named_(!tool_.empty())
  {
    tool_.reserve(kName);
  }

  /// Forgets a message that was cut short.
  void restart() noexcept
  {
    filled_ = 0;
    left_ = 0;
  }

  /// Takes up bytes.
  /// @param newest  set where a pose was completed
  /// @return        false: this is no OpenIGTLink, and nothing after it can be found
  /// @realtime      no allocation, no lock, no exception
  [[nodiscard]] bool take(Bytes bytes, std::optional<TrackedPose>& newest) noexcept;

  /// Whether a message has begun that is not yet whole.
  [[nodiscard]] bool inMessage() const noexcept
  {
    return filled_ > 0;
  }

private:
  static constexpr std::size_t kName = 20;
  static constexpr std::size_t kHeader = 58;
  static constexpr std::size_t kLargestBody = 4096; // of a pose with its metadata

  [[nodiscard]] bool beginBody() noexcept;
  [[nodiscard]] std::optional<TrackedPose> endBody() noexcept;
  [[nodiscard]] bool isOurs(std::string_view name) noexcept;

  std::string tool_;
  bool named_;
  std::array<std::byte, kHeader + kLargestBody> message_{};
  std::size_t filled_ = 0;
  std::uint64_t left_ = 0; // of the body
  bool kept_ = false;      // a pose, not skipped
};

inline constexpr std::size_t kIgtlForce = 58 + 10 + 3 * 8; ///< [bytes]

/// A force as a SENSOR message of three values in newtons; its device is named Force.
/// @param force  [N]
/// @realtime     no allocation, no lock, no exception
/// @source       OpenIGTLink protocol, Documents/Protocol/sensor.md, unit.md
[[nodiscard]] std::array<std::byte, kIgtlForce> encodeIgtlForce(
  const Eigen::Vector3d& force) noexcept;

} // namespace palp
