#include "haptics/devices/haply/haply_driver.h"

#include "haptics/devices/guard/guarded_driver.h"
#include "haptics/devices/haply/haply_link.h"
#include "haptics/error.h"
#include "haptics/files/descriptor.h"
#include "haptics/units.h"

#include <charconv>
#include <cstddef>
#include <optional>
#include <sys/socket.h>
#include <sys/un.h>

namespace palp
{
namespace
{

using namespace units::literals;
using namespace std::chrono_literals;

constexpr std::uint16_t kUsualPort = 10'001;

// one palp drives an arm at a time; the system frees the name with the program
Descriptor claimArm(std::uint16_t port)
{
  Descriptor name(socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  sockaddr_un where{ .sun_family = AF_UNIX, .sun_path = {} };
  const std::string text = "palp haply " + std::to_string(port);
  text.copy(&where.sun_path[1], sizeof(where.sun_path) - 1); // begins with 0: not in a folder
  const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + text.size());
  if (bind(name.get(), reinterpret_cast<const sockaddr*>(&where), size) != 0)
  {
    throw Error(ErrorCode::NoDevice, "Haply Inverse3: is driven by another palp; close it");
  }
  return name;
}

class HaplyDriver final : public Driver
{
public:
  explicit HaplyDriver(std::uint16_t port)
    : taken_(claimArm(port))
    , link_(port)
  {
    constexpr double kTurned = 50.0_mm; // that no hand goes meanwhile
    const Eigen::Vector3d before = link_.state().position;
    const bool replied = link_.exchange(Eigen::Vector3d::Zero(), 100ms);
    const HaplyState& now = link_.state();
    const bool isAsked = replied && !now.oldWords; // for the middle
    if (now.centered || (isAsked && (now.position - before).norm() > kTurned))
    {
      start_ = Eigen::Vector3d::Zero();
      reach_ = now.reach;
    }
    guard_ = std::make_shared<Guard>(link_.descriptor(), GuardWire::File, haplyZero(now));
  }

  [[nodiscard]] std::shared_ptr<Guard> guard() const
  {
    return guard_;
  }

  // force and step of Haply's data sheet: 4 N in 80 % of the workspace, 10 N at its peak, 0.01 mm;
  // damping and friction nobody has measured here: low on purpose
  [[nodiscard]] DeviceLimits limits() const override
  {
    return { .model = "Haply Inverse3",
      .rendersForce = true,
      .needsHoming = true,
      .maxForce = 4.0,
      .damping = 0.2,
      .friction = 0.05,
      .handDamping = kGripDamping,
      .quantum = 10.0_um,
      .delay = 1.0_ms,
      .velocityDelay = 4.5_ms,
      .workspaceRadius = reach_ };
  }

  [[nodiscard]] IoCode tick(const Wrench& wrench, double, DriverSample& sample) noexcept override
  {
    const bool pushes = homed_ && wrench.force.allFinite();
    const Eigen::Vector3d sent = pushes ? wrench.force : Eigen::Vector3d(Eigen::Vector3d::Zero());
    sample.sent = sent;
    guard_->beat();
    if (!sent.isZero(0.0))
    {
      guard_->setForced(true);
    }
    const bool replied = link_.exchange(sent, 2ms);
    guard_->beat();
    guard_->setForced(link_.pushes());
    if (link_.gone())
    {
      return IoCode::Gone;
    }
    if (!replied)
    {
      return IoCode::Timeout;
    }
    const HaplyState& state = link_.state();
    homed_ = state.calibrated;
    start_ = homed_ && !start_ ? std::optional(state.position) : start_;
    upright_ = homed_ && !upright_ && state.hasGrip ? std::optional(state.orientation) : upright_;
    sample = { .position = state.position - start_.value_or(state.position),
      .orientation = state.orientation * upright_.value_or(state.orientation).inverse(),
      .buttons = state.buttons,
      .homed = homed_,
      .sent = sent };
    return IoCode::Ok;
  }

private:
  Descriptor taken_;
  std::shared_ptr<Guard> guard_; // ends after the link, which ends with zero force
  HaplyLink link_;
  bool homed_ = false;
  std::optional<Eigen::Vector3d> start_; // zero of its poses: the middle, where it is known [m]
  double reach_ = 0.0;                   // from there [m]; 0: not known
  std::optional<Eigen::Quaterniond> upright_; // of the grip, which may wake later
};

} // namespace

std::unique_ptr<Driver> openHaply(const std::string& port)
{
  std::uint16_t number = kUsualPort;
  const char* end = port.data() + port.size();
  const auto read = std::from_chars(port.data(), end, number);
  if (!port.empty() && (read.ec != std::errc{} || read.ptr != end || number == 0))
  {
    throw Error(ErrorCode::BadValue,
      "--device: haply:" + port + ": not a port; write as in haply or haply:10001");
  }
  auto driver = std::make_unique<HaplyDriver>(number);
  auto guard = driver->guard();
  return std::make_unique<GuardedDriver>(std::move(driver), std::move(guard));
}

void findHaply()
{
  const HaplyLink link(kUsualPort);
}

} // namespace palp
