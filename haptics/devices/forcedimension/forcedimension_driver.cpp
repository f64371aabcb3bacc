#include "haptics/devices/forcedimension/forcedimension_driver.h"

#include "haptics/error.h"
#include "haptics/units.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <dlfcn.h>
#include <numbers>
#include <string_view>
#include <utility>

namespace palp
{
namespace
{

using namespace units::literals;

constexpr unsigned char kWatchdog = 160; // 20 ms, in steps of 125 us: as long as a command holds

// @source  documentation of the Force Dimension SDK 3, as facts
struct Library
{
  int (*open)();
  int (*close)(char);
  bool (*isInitialized)(char);
  const char* (*systemName)(char);
  const char* (*lastError)();
  int (*enableForce)(unsigned char, char);
  int (*setWatchdog)(unsigned char, char);
  int (*position)(double*, double*, double*, char);
  bool (*hasWrist)(char);
  bool (*hasActiveWrist)(char);
  int (*orientation)(double (*)[3], char);
  unsigned int (*buttons)(char);
  int (*setForceAndTorque)(double, double, double, double, double, double, char);
  int (*force)(double*, double*, double*, char);
};

template <typename Function>
void find(void* file, const std::string& path, const char* name, Function*& function)
{
  function = reinterpret_cast<Function*>(dlsym(file, name));
  if (function == nullptr)
  {
    throw Error(ErrorCode::NoDevice,
      path + ": lacks " + name +
        "; give libdrd of the Force Dimension SDK 3, as --device "
        "forcedimension:FILE");
  }
}

Library load(const std::string& path)
{
  void* file = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL); // stays: its threads may outlive an arm
  if (file == nullptr)
  {
    throw Error(ErrorCode::NoDevice,
      "Force Dimension: cannot load " + path +
        "; install the makers' SDK 3, or give its libdrd as --device forcedimension:FILE");
  }
  Library library{};
  find(file, path, "drdOpen", library.open);
  find(file, path, "drdClose", library.close);
  find(file, path, "drdIsInitialized", library.isInitialized);
  find(file, path, "dhdGetSystemName", library.systemName);
  find(file, path, "dhdErrorGetLastStr", library.lastError);
  find(file, path, "dhdEnableForce", library.enableForce);
  find(file, path, "dhdSetWatchdog", library.setWatchdog);
  find(file, path, "dhdGetPosition", library.position);
  find(file, path, "dhdHasWrist", library.hasWrist);
  find(file, path, "dhdHasActiveWrist", library.hasActiveWrist);
  find(file, path, "dhdGetOrientationFrame", library.orientation);
  find(file, path, "dhdGetButtonMask", library.buttons);
  find(file, path, "dhdSetForceAndTorque", library.setForceAndTorque);
  find(file, path, "dhdGetForce", library.force);
  return library;
}

constexpr const char* kLibrary = "libdrd.so.3";

// of every arm with an active wrist: a quarter of the angular stiffness that its makers state, for
// nobody has tried ours on one
// @source  chai3d/chai3d src/devices/CDeltaDevices.cpp, of which Force Dimension is an author
constexpr double kMaxTorque = 0.2;            // [N m]
constexpr double kMaxAngularStiffness = 0.25; // [N m/rad]

// arms of one name
struct Family
{
  std::string_view name;
  double maxForce; // [N]
  double radius;   // of the sphere in its workspace [m]
};

// @source  the same
constexpr std::array kFamilies{
  Family{ "omega", 12.0, 75.0_mm },
  Family{ "sigma", 12.0, 75.0_mm },
  Family{ "delta", 20.0, 150.0_mm },
};

// of another arm, less than any of theirs, and no bound of its reach
Family familyOf(const std::string& name) noexcept
{
  const auto* found = std::ranges::find_if(
    kFamilies, [&](const Family& one) { return name.find(one.name) != name.npos; });
  return found == kFamilies.end() ? Family{ "", 8.0, 0.0 } : *found;
}

std::string textOf(const char* text)
{
  return text != nullptr ? text : "unknown";
}

class ForceDimensionDriver final : public Driver
{
public:
  ForceDimensionDriver(const Library& library, char arm)
    : library_(library)
    , arm_(arm)
    , name_(textOf(library.systemName(arm)))
    , family_(familyOf(name_))
    , hasWrist_(library.hasWrist(arm))
    , turns_(hasWrist_ && library.hasActiveWrist(arm))
  {
    (void)library_.setWatchdog(kWatchdog, arm_);
    if (library_.enableForce(1, arm_) < 0)
    {
      (void)library_.close(arm_);
      throw Error(ErrorCode::NoDevice,
        "Force Dimension " + name_ +
          ": its motors cannot be enabled; release its emergency stop, and try again");
    }
  }
  ~ForceDimensionDriver() override
  {
    (void)library_.setForceAndTorque(0, 0, 0, 0, 0, 0, arm_);
    (void)library_.enableForce(0, arm_);
    (void)library_.close(arm_);
  }
  ForceDimensionDriver(const ForceDimensionDriver&) = delete;
  ForceDimensionDriver& operator=(const ForceDimensionDriver&) = delete;

  // damping, friction and delay conservative, until identified
  [[nodiscard]] DeviceLimits limits() const override
  {
    return { .model = "Force Dimension " + name_,
      .rendersForce = true,
      .needsHoming = true,
      .maxForce = family_.maxForce,
      .maxTorque = turns_ ? kMaxTorque : 0.0,
      .maxAngularStiffness = turns_ ? kMaxAngularStiffness : 0.0,
      .damping = 0.2,
      .friction = 0.05,
      .handDamping = kGripDamping,
      .quantum = 10.0_um,
      .delay = 1.0_ms,
      .velocityDelay = 4.5_ms,
      .workspaceRadius = family_.radius };
  }

  [[nodiscard]] IoCode tick(const Wrench& wrench, double, DriverSample& sample) noexcept override
  {
    const bool pushes = homed_ && wrench.force.allFinite() && wrench.torque.allFinite();
    const Wrench asked = pushes ? wrench : Wrench{};
    Eigen::Vector3d sent = toDevice(asked.force);
    const Eigen::Vector3d turn = toDevice(turns_ ? asked.torque : Eigen::Vector3d::Zero());
    const int code =
      library_.setForceAndTorque(sent.x(), sent.y(), sent.z(), turn.x(), turn.y(), turn.z(), arm_);
    if (code == kSaturated)
    {
      (void)library_.force(&sent.x(), &sent.y(), &sent.z(), arm_);
    }
    sample.sent = fromDevice(sent);
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
    double frame[3][3] = { { 1, 0, 0 }, { 0, 1, 0 },
      { 0, 0, 1 } }; // NOLINT: as the library takes it
    if (code < 0 || library_.position(&place.x(), &place.y(), &place.z(), arm_) < 0 ||
      library_.orientation(frame, arm_) < 0)
    {
      return IoCode::Gone;
    }
    homed_ = library_.isInitialized(arm_);
    constexpr double kFarthest = 2.0; // that any of their arms reaches [m]
    const auto turned = Eigen::Map<const Eigen::Matrix3d>(&frame[0][0]);
    if (!place.allFinite() || place.norm() > kFarthest || !turned.allFinite())
    {
      return IoCode::Timeout;
    }
    sample = { .position = fromDevice(place),
      .orientation = orientationOf(frame),
      .buttons = library_.buttons(arm_),
      .homed = homed_,
      .sent = fromDevice(sent) };
    return IoCode::Ok;
  }

private:
  static constexpr int kSaturated = 2; // DHD_MOTOR_SATURATED: it did what its motors can

  // theirs: x to the user, y to the right, z up
  static Eigen::Vector3d fromDevice(const Eigen::Vector3d& of) noexcept
  {
    return { of.y(), -of.x(), of.z() };
  }
  static Eigen::Vector3d toDevice(const Eigen::Vector3d& of) noexcept
  {
    return { -of.y(), of.x(), of.z() };
  }

  // of a pen along x of their frame, whose tip is at the arm; without a wrist it stays upright
  [[nodiscard]] Eigen::Quaterniond orientationOf(const double (&frame)[3][3]) const noexcept
  {
    if (!hasWrist_)
    {
      return Eigen::Quaterniond::Identity();
    }
    Eigen::Matrix3d pen;
    for (int column = 0; column < 3; ++column)
    {
      pen.col(column) = fromDevice({ frame[0][column], frame[1][column], frame[2][column] });
    }
    const Eigen::Matrix3d turn =
      pen * Eigen::AngleAxisd(0.5 * std::numbers::pi, Eigen::Vector3d::UnitY());
    const bool possible = turn.allFinite() && std::abs(turn.determinant() - 1.0) < 0.05;
    return possible ? Eigen::Quaterniond(turn).normalized() : Eigen::Quaterniond::Identity();
  }

  Library library_;
  char arm_;
  std::string name_;
  Family family_;
  bool hasWrist_;
  bool turns_; // its wrist has motors
  bool homed_ = false;
};

} // namespace

std::unique_ptr<Driver> openForceDimension(const std::string& library)
{
  const Library functions = load(library.empty() ? kLibrary : library);
  const int arm = functions.open();
  if (arm < 0)
  {
    throw Error(ErrorCode::NoDevice,
      "Force Dimension: no arm (" + textOf(functions.lastError()) +
        "); switch it on and plug it in, and see the makers' HapticDesk");
  }
  return std::make_unique<ForceDimensionDriver>(functions, static_cast<char>(arm));
}

void requireForceDimension()
{
  (void)load(kLibrary);
}

} // namespace palp
