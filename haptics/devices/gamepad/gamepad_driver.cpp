#include "haptics/devices/gamepad/gamepad_driver.h"

#include "haptics/error.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <fcntl.h>
#include <sys/ioctl.h>
#include <unistd.h>

namespace palp
{
namespace
{

constexpr double kRumbleEvery = 0.02;        // at most [s]: a motor takes longer to follow
constexpr double kRumbleAgain = 0.1;         // at least, before what was told ends by itself [s]
constexpr int kRumbleStep = 1024;            // of 65535 that it is told of
constexpr std::uint16_t kRumbleLength = 200; // [ms]
constexpr int kFirstButton = BTN_SOUTH;
constexpr int kButtons = BTN_THUMBR - BTN_SOUTH + 1;

// whether a node knows a code of a type
bool knows(int node, unsigned type, unsigned code) noexcept
{
  std::array<unsigned char, KEY_MAX / 8 + 1> bits{};
  return ioctl(node, EVIOCGBIT(type, bits.size()), bits.data()) >= 0 &&
    (bits[code / 8] >> code % 8 & 1U) != 0;
}

bool isGamepad(int node) noexcept
{
  return knows(node, EV_KEY, BTN_GAMEPAD) && knows(node, EV_ABS, ABS_X);
}

// for writing, too, where that is permitted
Descriptor openNode(const std::string& path) noexcept
{
  Descriptor node(open(path.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC));
  return node || errno != EACCES
    ? std::move(node)
    : Descriptor(open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
}

bool mayWrite(int node) noexcept
{
  const int flags = fcntl(node, F_GETFL);
  return flags >= 0 && (flags & O_ACCMODE) != O_RDONLY;
}

} // namespace

std::vector<FoundGamepad> listGamepads(const std::filesystem::path& folder)
{
  std::vector<FoundGamepad> found;
  std::error_code unread; // a folder that cannot be read shows none
  for (const auto& entry : std::filesystem::directory_iterator(folder, unread))
  {
    const Descriptor node =
      entry.path().filename().string().starts_with("event") ? openNode(entry.path()) : Descriptor();
    if (node && isGamepad(node.get()))
    {
      std::array<char, 128> name{};
      (void)ioctl(node.get(), EVIOCGNAME(name.size() - 1), name.data());
      found.push_back(
        { name.data(), entry.path(), mayWrite(node.get()) && knows(node.get(), EV_FF, FF_RUMBLE) });
    }
  }
  std::ranges::sort(found, {}, &FoundGamepad::path);
  return found;
}

GamepadDriver::GamepadDriver(Descriptor node)
  : node_(std::move(node))
  , rumbles_(mayWrite(node_.get()) && knows(node_.get(), EV_FF, FF_RUMBLE))
{
  effect_.type = FF_RUMBLE;
  effect_.id = -1; // the kernel gives it one
  effect_.replay.length = kRumbleLength;
  synchronize();
}

GamepadDriver::~GamepadDriver()
{
  play(false);
}

DeviceLimits GamepadDriver::limits() const
{
  return { .model = "game pad" };
}

IoCode GamepadDriver::tick(const Wrench& wrench, double dt, DriverSample& sample) noexcept
{
  std::array<input_event, 64> events; // NOLINT(cppcoreguidelines-pro-type-member-init): read into
  const ssize_t size = read(node_.get(), events.data(), sizeof(events));
  if (size == 0 || (size < 0 && errno != EAGAIN && errno != EINTR))
  {
    return IoCode::Gone;
  }
  const std::size_t count = size > 0 ? static_cast<std::size_t>(size) / sizeof(input_event) : 0;
  for (std::size_t i = 0; i < count; ++i)
  {
    take(events[i]);
  }
  rumble(wrench.force.allFinite() ? wrench.force.norm() : 0.0, dt);
  SpaceMouseState now = state();
  sample = motion_.move(now, true, dt); // a stick that is held tells nothing anew
  return IoCode::Ok;
}

// at the start, and where the kernel has dropped events
void GamepadDriver::synchronize() noexcept
{
  for (std::size_t i = 0; i < kAxes; ++i)
  {
    input_absinfo axis{};
    axes_[i] = ioctl(node_.get(), EVIOCGABS(i), &axis) >= 0 ? axis : input_absinfo{};
  }
  std::array<unsigned char, KEY_MAX / 8 + 1> keys{};
  buttons_ = 0;
  if (ioctl(node_.get(), EVIOCGKEY(keys.size()), keys.data()) >= 0)
  {
    for (int i = 0; i < kButtons; ++i)
    {
      const auto code = static_cast<unsigned>(kFirstButton + i);
      buttons_ |= (keys[code / 8] >> code % 8 & 1U) << i;
    }
  }
}

void GamepadDriver::take(const input_event& event) noexcept
{
  if (event.type == EV_ABS && event.code < kAxes)
  {
    axes_[event.code].value = event.value;
  }
  else if (event.type == EV_KEY && event.code >= kFirstButton &&
    event.code < kFirstButton + kButtons)
  {
    const std::uint32_t bit = 1U << (event.code - kFirstButton);
    buttons_ = event.value != 0 ? buttons_ | bit : buttons_ & ~bit;
  }
  else if (event.type == EV_SYN && event.code == SYN_DROPPED)
  {
    synchronize();
  }
}

// -1 to 1; 0 where it has no such axis, or in what the kernel calls its flat part
double GamepadDriver::deflection(std::size_t axis) const noexcept
{
  const input_absinfo& one = axes_[axis];
  const double half = 0.5 * (static_cast<double>(one.maximum) - one.minimum);
  const double off = one.value - 0.5 * (static_cast<double>(one.maximum) + one.minimum);
  return half > 0.0 && std::abs(off) > one.flat ? std::clamp(off / half, -1.0, 1.0) : 0.0;
}

// as a six-axis mouse would tell it: x right, y to the user, z down
SpaceMouseState GamepadDriver::state() const noexcept
{
  constexpr double kFull = 350.0;
  const auto axis = [&](double fraction) { return nearestInt<std::int16_t>(kFull * fraction); };
  return { .axes = { axis(deflection(ABS_X)), axis(deflection(ABS_Y)), axis(deflection(ABS_RY)),
             axis(deflection(ABS_HAT0Y)), axis(-deflection(ABS_HAT0X)), 0 },
    .buttons = buttons_ };
}

void GamepadDriver::rumble(double force, double dt) noexcept
{
  sinceTold_ += dt;
  if (!rumbles_ || sinceTold_ < kRumbleEvery)
  {
    return;
  }
  const auto level = static_cast<int>(std::lround(65'535.0 * std::min(1.0, force / kFullForce)));
  const int told = effect_.u.rumble.strong_magnitude;
  const bool changed = std::abs(level - told) >= kRumbleStep || (level == 0) != (told == 0);
  const bool ends = level > 0 && sinceTold_ >= kRumbleAgain;
  if (!changed && !ends)
  {
    return;
  }
  sinceTold_ = 0.0;
  effect_.u.rumble.strong_magnitude = static_cast<std::uint16_t>(level);
  if (level == 0)
  {
    play(false);
    return;
  }
  rumbles_ = ioctl(node_.get(), EVIOCSFF, &effect_) >= 0;
  play(true);
}

void GamepadDriver::play(bool on) noexcept
{
  if (rumbles_ && effect_.id >= 0)
  {
    input_event event{};
    event.type = EV_FF;
    event.code = static_cast<std::uint16_t>(effect_.id);
    event.value = on ? 1 : 0;
    const ssize_t size = write(node_.get(), &event, sizeof(event));
    rumbles_ = size == static_cast<ssize_t>(sizeof(event)) || errno == EAGAIN;
  }
}

std::unique_ptr<Driver> openGamepad(const std::string& path)
{
  const std::vector<FoundGamepad> found =
    path.empty() ? listGamepads() : std::vector<FoundGamepad>();
  if (path.empty() && found.empty())
  {
    throw Error(ErrorCode::NoDevice,
      "game pad: none that may be read; plug it in, and sit at its machine or join the group "
      "input");
  }
  const std::string place = path.empty() ? found.front().path : path;
  Descriptor node = openNode(place);
  if (!node)
  {
    throw Error(ErrorCode::NoDevice,
      place +
        (errno == EACCES ? ": no permission; sit at its machine, or join the group input"
                         : ": cannot be opened; plug it in again"));
  }
  if (!isGamepad(node.get()))
  {
    throw Error(ErrorCode::NoDevice, place + ": no game pad; see palp devices");
  }
  return std::make_unique<GamepadDriver>(std::move(node));
}

} // namespace palp
