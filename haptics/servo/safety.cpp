#include "haptics/servo/safety.h"

#include "haptics/error.h"
#include "haptics/servo/tissue_at.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <utility>

namespace palp
{
namespace
{

constexpr double kFreeSpace = 0.050;  // [s] without tissue or wall end a soft start
constexpr double kFastest = 0.25;     // pace of a bus, by the period that was asked for
constexpr double kSurely = 0.5;       // of the stated dissipation of a mechanism
constexpr double kQuickDamping = 0.5; // of a mass, by the delay after which it would swing [-]

// a damper that is late by half of mass / damping begins to drive what it should brake
double dampingOf(const DeviceLimits& device, const SafetySettings& settings)
{
  const double late = device.delay + device.velocityDelay + settings.period;
  return device.mass > 0.0 ? std::min(settings.passivityDamping, kQuickDamping * device.mass / late)
                           : settings.passivityDamping;
}

// of a tool that moves so much more than the hand
SafetySettings ofTool(SafetySettings settings, double scale)
{
  settings.fastest *= scale;
  settings.passivityDamping /= scale;
  return settings;
}

[[noreturn]] void refuse(
  const std::string& whose, const char* name, double value, const char* bounds)
{
  std::ostringstream text;
  text << whose << ": " << name << " is " << value << "; " << bounds;
  throw Error(ErrorCode::BadValue, text.str());
}

} // namespace

SafetyChain::SafetyChain(const DeviceLimits& device, const SafetySettings& settings)
  : device_(device)
  , settings_(ofTool(settings, device.scale))
  , passivity_(dampingOf(device, settings_), device.quantum,
      { kSurely * device.damping, kSurely * device.friction })
  , guard_(device.quantum / device.scale) // of the hand, which feels the swings
  , period_(settings.period, kFastest * settings.period)
  , delays_(settings.period, 0.0)
{
  using Named = std::pair<const char*, double>;
  for (const auto& [name, value] : { Named{ "period", settings.period },
         { "stiffnessFraction", settings.stiffnessFraction }, { "slewRate", settings.slewRate },
         { "softSlewRate", settings.softSlewRate }, { "softStart", settings.softStart },
         { "decay", settings.decay }, { "fastest", settings.fastest }, { "scale", device.scale } })
  {
    if (!(value > 0.0) || !std::isfinite(value))
    {
      refuse("safety chain", name, value, "must be > 0 and finite");
    }
  }
  if (!(settings.stiffnessFraction <= 1.0))
  {
    refuse("safety chain", "stiffnessFraction", settings.stiffnessFraction, "must be at most 1");
  }
  if (!device.workspaceCenter.allFinite())
  {
    refuse(device.model, "workspaceCenter", device.workspaceCenter.sum(), "must be finite");
  }
  if (settings.softSlewRate >= settings.slewRate) // a force that is let go would stay for ever
  {
    refuse("safety chain", "softSlewRate", settings.softSlewRate, "must be below slewRate");
  }
  for (const auto& [name, value] : { Named{ "maxForce", device.maxForce },
         { "maxTorque", device.maxTorque }, { "maxAngularStiffness", device.maxAngularStiffness },
         { "damping", device.damping }, { "friction", device.friction }, { "mass", device.mass },
         { "handDamping", device.handDamping }, { "quantum", device.quantum },
         { "delay", device.delay }, { "velocityDelay", device.velocityDelay },
         { "workspaceRadius", device.workspaceRadius },
         { "passivityDamping", settings.passivityDamping } })
  {
    if (!(value >= 0.0) || !std::isfinite(value))
    {
      refuse(device.model, name, value, "must be >= 0 and finite");
    }
  }
}

void SafetyChain::limit(Sample& sample, const DepthLaw& law, const Scene& scene,
  const TissueAt* tissue, TissueMemory* memory) noexcept
{
  const Eigen::Vector3d wanted = rendered(sample, law, scene, tissue, memory);
  const Eigen::Vector3d wall = workspaceForce(last_);
  const Eigen::Vector3d damping = passivity_.damp({ .position = last_.apex,
    .velocity = last_.velocity,
    .axis = last_.axis,
    .dt = elapsed_,
    .delay = measured_ ? newestDelay_ : device_.delay,
    .stored = forceOn() ? share_ * stored_ : 0.0,
    .share = guard_.stiffnessShare() });
  watchSwings(sample);
  sample.force.setZero();
  sample.torque.setZero();
  if (forceOn())
  {
    Eigen::Vector3d force = wanted + damping;
    if (sample.contact.touching()) // never pulls, whoever brakes
    {
      force += std::max(0.0, -force.dot(sample.contact.normal)) * sample.contact.normal;
    }
    else if (wall.isZero(0.0))
    {
      force.setZero();
      passivity_.leaveContact();
    }
    if (!damping.isZero(0.0) && !force.isZero(0.0))
    {
      raise(Flag::Passivity);
    }
    force += wall;
    shaped_ = bounded(force, largestForce(scene));
    fade();
    sample.force = share_ * shaped_ + watchdogGain_ * fading_;
    ramp(sample.contact.touching() || !wall.isZero(0.0));
    if (device_.maxTorque > 0.0 && tissue != nullptr && sample.contact.touching())
    {
      sample.torque = renderedTorque(sample, scene, *tissue);
    }
  }
  else
  {
    raise(Flag::Disarmed);
  }
  sent_ = sample.force;
  passivity_.sent({ sent_, sample.torque });
  sample.flags |= flags_ | latched_;
  sample.state = state_;
}

double SafetyChain::largestForce(const Scene& scene) const noexcept
{
  const double turns = device_.maxTorque > 0.0
    ? device_.maxTorque / baseRadius(scene.law.tip()) // at most, whatever the lean
    : std::numeric_limits<double>::infinity();
  return std::min({ device_.maxForce, scene.forceLimit, turns });
}

// the law through the coupling, with damping along the normal
Eigen::Vector3d SafetyChain::rendered(Sample& sample, const DepthLaw& law, const Scene& scene,
  const TissueAt* tissue, TissueMemory* memory) noexcept
{
  const double depth = sample.contact.depth;
  const double stiffest =
    guard_.stiffnessShare() * std::min(stiffnessLimit(scene.damping), torqueStiffnessLimit(scene));
  const bool isOther = std::exchange(organ_, sample.organ) != sample.organ;
  const bool touched = std::exchange(touched_, depth > 0.0);
  const bool changed = std::exchange(version_, scene.version) != scene.version;
  rebase(law, depth, stiffest, changed || (isOther && touched));
  followLean(sample, scene);
  resumeFraction();
  sample.response = depth > 0.0 ? law(depth) : Response{};
  Rendered felt = couple(law, depth - contactOffset_, stiffest);
  // what rises faster than may be slips: a force that lags, or grows while the tool rests, would
  // give energy to the hand
  if (const double highest = highestNormalForce(scene); felt.force > highest)
  {
    raise(Flag::SlewLimited);
    contactOffset_ = depth - depthOf(law, highest, stiffest, depth);
    felt = couple(law, depth - contactOffset_, stiffest);
  }
  if (contactOffset_ > 0.0) // also where the law is not yet felt
  {
    raise(Flag::Rebased);
  }
  normalForce_ = felt.force;
  stored_ = storedEnergy(law, felt, depth - contactOffset_);
  sample.proxyDepth = felt.proxyDepth;
  const Eigen::Vector3d friction =
    memory != nullptr ? memory->settle(felt, stiffest, sample) : Eigen::Vector3d::Zero();
  if (std::isnan(sample.response.force) || !(scene.damping >= 0.0) || !(scene.forceLimit >= 0.0))
  {
    fault(Flag::NotFinite);
    return Eigen::Vector3d::Zero();
  }
  Eigen::Vector3d force = push(sample.contact, felt, scene);
  if (tissue != nullptr && TissueAt::pushesAside(scene))
  {
    const SeriesResponse answer = tissue->answer(felt.proxyDepth);
    const double elastic = answer.felt.force;
    // what the body pushes aside relaxes as the rest
    sample.lateral = (memory == nullptr  ? 1.0
                         : elastic > 0.0 ? felt.force / elastic
                                         : 0.0) *
      tissue->lateral(answer);
    force += sample.lateral;
  }
  return memory != nullptr ? Eigen::Vector3d(force + friction) : force;
}

// where contact is felt to begin, so that no force jumps
void SafetyChain::rebase(const DepthLaw& law, double depth, double stiffest, bool changed) noexcept
{
  if (std::exchange(rebase_, false))
  {
    contactOffset_ = depth;
  }
  else if (changed && depth > 0.0)
  {
    contactOffset_ = depth - depthOf(law, normalForce_, stiffest, depth);
  }
  contactOffset_ = std::clamp(contactOffset_, 0.0, depth > 0.0 ? depth : 0.0);
}

// of the force that is sent; a fraction that grows goes on from the force that was
void SafetyChain::resumeFraction() noexcept
{
  const double fraction = watchdogGain_ * (state_ == DeviceState::Decay ? gain_ : 1.0);
  if (fraction > share_)
  {
    normalForce_ *= share_ / fraction;
    shaped_ *= share_ / fraction;
  }
  share_ = fraction;
}

// that the law may reach in this tick [N]
double SafetyChain::highestNormalForce(const Scene& scene) const noexcept
{
  return state_ == DeviceState::SoftStart
    ? std::min(normalForce_ + settings_.softSlewRate * dt_, gain_ * largestForce(scene))
    : normalForce_ + settings_.slewRate * dt_;
}

Eigen::Vector3d SafetyChain::push(
  const Contact& contact, const Rendered& felt, const Scene& scene) noexcept
{
  if (!(felt.force > 0.0))
  {
    return Eigen::Vector3d::Zero();
  }
  const double damping = std::max(renderedDamping(scene.damping),
    std::min(guard_.damping(felt.stiffness), settings_.passivityDamping));
  if (felt.limited)
  {
    raise(Flag::StiffnessLimited);
  }
  if (damping < scene.damping)
  {
    raise(Flag::DampingLimited);
  }
  const Eigen::Vector3d& normal = contact.normal;
  const double elastic = contact.slope * felt.force;
  return std::max(0.0, elastic - damping * last_.velocity.dot(normal)) * normal;
}

// at tissue or at the end of the workspace
void SafetyChain::watchSwings(const Sample& sample) noexcept
{
  const bool atEnd = (flags_ & static_cast<std::uint32_t>(Flag::Workspace)) != 0;
  const Eigen::Vector3d normal =
    sample.contact.touching() ? sample.contact.normal : (center_ - last_.apex).normalized();
  const Eigen::Vector3d along = atEnd || sample.contact.touching() ? normal : normal_;
  normal_ = along;
  guard_.record(last_.velocity.dot(along) / device_.scale, atEnd || sample.contact.touching(), dt_);
  if (device_.unproven && drive_.record(last_.velocity / device_.scale, sent_, dt_))
  {
    fault(Flag::DrivesMotion);
  }
}

// shortened to the largest force, then to the largest change
Eigen::Vector3d SafetyChain::bounded(Eigen::Vector3d force, double largest) noexcept
{
  if (!force.allFinite())
  {
    fault(Flag::NotFinite);
    return Eigen::Vector3d::Zero();
  }
  if (state_ == DeviceState::SoftStart)
  {
    largest *= gain_;
  }
  if (const double size = force.norm(); size > largest)
  {
    raise(Flag::Limited);
    force *= largest / size;
  }

  const double rate =
    state_ == DeviceState::SoftStart ? settings_.softSlewRate : settings_.slewRate;
  const Eigen::Vector3d change = force - shaped_;
  if (const double size = change.norm(); size > rate * dt_)
  {
    raise(Flag::SlewLimited);
    force = shaped_ + change * (rate * dt_ / size);
  }
  return force;
}

// together with a force that starts, no faster than any force
void SafetyChain::fade() noexcept
{
  const double step = std::max(0.0, settings_.slewRate - settings_.softSlewRate) * dt_;
  const double size = fading_.norm();
  fading_ *= size > step ? 1.0 - step / size : 0.0;
}

void SafetyChain::ramp(bool touching) noexcept
{
  apart_ = touching ? 0.0 : apart_ + dt_;
  if (state_ == DeviceState::SoftStart)
  {
    gain_ = apart_ >= kFreeSpace ? 1.0 : std::min(1.0, gain_ + dt_ / settings_.softStart);
    state_ = gain_ < 1.0 ? DeviceState::SoftStart : DeviceState::Active;
    restarts_ = gain_ < 1.0 ? restarts_ : 0;
  }
  else if (state_ == DeviceState::Decay)
  {
    gain_ = std::max(0.0, gain_ - dt_ / settings_.decay);
    if (gain_ == 0.0)
    {
      forceOff(DeviceState::Ready);
    }
  }
}

} // namespace palp
