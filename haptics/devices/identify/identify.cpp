#include "haptics/devices/identify/identify.h"

#include "haptics/devices/identify/joint_watch.h"
#include "haptics/devices/identify/swing.h"
#include "haptics/error.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

namespace palp
{
namespace
{

using Eigen::Vector3d;

constexpr double kMostForce = 0.3;   // [N]
constexpr double kSwingForce = 0.27; // leaves room for holding the other axes [N]
constexpr double kRamp = 0.6;        // of the first pushes [N/s]
constexpr double kFar = 0.025;       // from where it began [m]
constexpr std::array kNames{ "x", "y", "z" };

[[noreturn]] void refuse(const std::string& what)
{
  throw Error(ErrorCode::NoDevice, "identify: " + what);
}

class Pusher
{
public:
  Pusher(const ArmExchange& exchange, double step)
    : exchange_(exchange)
    , step_(step)
  {
    begin_ = send(Vector3d::Zero());
    center_ = begin_.position;
  }

  [[nodiscard]] ArmPosition send(const Vector3d& force)
  {
    const double size = force.norm();
    const auto answer =
      exchange_(size > kMostForce ? Vector3d(force * (kMostForce / size)) : force);
    stopAt(faultOf(answer));
    stopAt(joints_.take(answer->joints, answer->time));
    heard_ = answer;
    return *answer;
  }

  void stopAt(const std::string& fault)
  {
    if (!fault.empty())
    {
      (void)exchange_(Vector3d::Zero());
      refuse(fault);
    }
  }

  // once it was pushed along all axes; motors of the wrong sign leave no direction unmoved
  void checkThatAllMoves()
  {
    constexpr double kFlat = 0.12; // steps of encoders and a bent path stay below
    stopAt(joints_.neverCounted());
    stopAt(std::abs(motions_.determinant()) < kFlat
        ? "pushes along x, y and z move the arm within one plane; an encoder or its cable may be "
          "dead, or a hand holds the arm"
        : "");
  }

  void checkThatItRests()
  {
    constexpr double kQuiet = 0.5; // [s]
    ArmPosition now = begin_;
    while (now.time < begin_.time + kQuiet)
    {
      now = send(Vector3d::Zero());
    }
    if ((now.position - center_).norm() > std::max(0.002, 20.0 * step_))
    {
      refuse("the arm moves by itself; balance it, let go of it, and try again");
    }
  }

  // one push that grows until the arm has moved a millimeter, and the same backwards, which stops
  // it
  [[nodiscard]] double agreement(int axis, double& breakaway)
  {
    constexpr double kLongest = 0.7;  // [s], of which 0.2 with the largest force
    constexpr double kUnmoved = 0.55; // where it does not begin to: it may move unseen [s]
    const double enough = std::max(0.001, 8.0 * step_);
    const ArmPosition from = send(Vector3d::Zero());
    double passed = 0.0;
    std::vector<double> pushes;
    Vector3d moved = Vector3d::Zero();
    double start = 0.0;
    double longest = kUnmoved;
    for (double force = 0.0; moved.norm() < enough && passed < longest;)
    {
      pushes.push_back(force);
      const ArmPosition now = send(force * Vector3d::Unit(axis));
      moved = now.position - from.position;
      const bool begins = moved.norm() >= std::max(2.5 * step_, 0.1e-3);
      start = begins ? start : force;
      longest = begins ? kLongest : longest;
      passed = now.time - from.time;
      force = std::min(kMostForce, kRamp * passed);
    }
    const bool follows = moved.norm() >= enough;
    const Vector3d direction = moved / std::max(moved.norm(), 1e-12);
    double furthest = moved.norm();
    std::ranges::reverse(pushes);
    for (const double force : pushes)
    {
      moved = send(-force * Vector3d::Unit(axis)).position - from.position;
      furthest = std::max(furthest, moved.norm());
      if (moved.norm() < furthest - std::max(1.5 * step_, 30e-6)) // it comes back: it has stopped
      {
        break;
      }
    }
    letRest();
    if (!follows)
    {
      refuse(std::string("0.3 N do not move the arm along ") +
        kNames[static_cast<std::size_t>(axis)] +
        "; it is held, has more friction than that, its motors are off, or its encoder is dead");
    }
    breakaway = start;
    motions_.col(axis) = direction;
    return direction[axis];
  }

  // without force, until it does or a second has passed
  void letRest()
  {
    constexpr double kStill = 0.06; // [s]
    ArmPosition last = send(Vector3d::Zero());
    const double until = last.time + 1.0;
    for (ArmPosition now = last; now.time < until && now.time < last.time + kStill;)
    {
      now = send(Vector3d::Zero());
      last = (now.position - last.position).norm() > std::max(3.0 * step_, 0.1e-3) ? now : last;
    }
  }

  // back to where it began, by a soft spring and a damper
  void bringBack(double time)
  {
    const double until = last_.time + time;
    do
    {
      Vector3d force = hold();
      last_ = send(force);
    } while (last_.time < until);
  }

  // of two strengths and several widths
  [[nodiscard]] std::vector<Swing> swings(int axis, double breakaway)
  {
    const double soft = 0.5 * (std::min(breakaway, kSwingForce) + kSwingForce);
    std::vector<Swing> all;
    for (const auto& [force, width] : { std::pair{ kSwingForce, 0.010 }, std::pair{ soft, 0.010 },
           std::pair{ kSwingForce, 0.003 }, std::pair{ soft, 0.005 } })
    {
      bringBack(0.4);
      all.push_back(swing(axis, force, width));
    }
    return all;
  }

private:
  // why an answer is that of no arm that 0.3 N push; empty: nothing is wrong
  [[nodiscard]] std::string faultOf(const std::optional<ArmPosition>& answer) const
  {
    constexpr double kFastest = 2.0; // [m/s]
    constexpr double kNoise = 0.002; // [m]
    constexpr double kAway = 0.1;    // [m]
    if (!answer)
    {
      return "the arm went away, was stopped or is not homed, or this computer was late by 50 ms; "
             "see palp devices, end what else runs, and try again";
    }
    if (!answer->position.allFinite())
    {
      return "the arm tells a position that is no number; check its encoders and their cables";
    }
    const ArmPosition& before = heard_.value_or(*answer);
    const double jump = (answer->position - before.position).norm();
    if (jump > kNoise + kFastest * (answer->time - before.sent)) // an answer may have been held up
    {
      return "the position leaps by " + std::to_string(std::lround(1e3 * jump)) +
        " mm; check the encoders, their cables and the configuration";
    }
    return heard_ && (answer->position - center_).norm() > kAway
      ? "the arm moves by itself, 100 mm from where it began; balance it, let go of it, and try "
        "again"
      : "";
  }

  // between two forces: each change comes where the last swing was so long ago that this one will
  // be as wide as asked
  [[nodiscard]] Swing swing(int axis, double force, double width)
  {
    constexpr int kSwings = 14;
    constexpr double kLongest = 4.0; // [s]
    constexpr double kStands = 0.2;  // [s]
    Swing record;
    double way = 1.0;
    double shift = 0.5 * width; // of the change behind the center
    double furthest = 0.0;
    int turns = 0;
    last_ = send(hold());
    const double begin = last_.time;
    const double noise = std::max(3.0 * step_, 0.1e-3);
    ArmPosition moved = last_;
    while (turns < kSwings && last_.time - begin < kLongest)
    {
      const double x = last_.position[axis] - center_[axis];
      if (way * x > shift)
      {
        way = -way;
        furthest = x;
        moved = last_;
      }
      if (std::abs(last_.position[axis] - moved.position[axis]) > std::max(step_, 10e-6))
      {
        moved = last_;
      }
      if (last_.time - moved.time > kStands)
      {
        stopAt(std::string("the arm stands still along ") + kNames[static_cast<std::size_t>(axis)] +
          " though it is pushed by more than moved it before; an encoder hangs, or a hand holds "
          "it");
      }
      furthest = way < 0.0 ? std::max(furthest, x) : std::min(furthest, x);
      if (furthest != 0.0 && -way * (furthest - x) > noise && !turned_)
      {
        turned_ = true;
        ++turns;
        shift = std::clamp(shift + 0.4 * (width - std::abs(furthest)), -width, width);
      }
      turned_ = turned_ && way == lastWay_;
      lastWay_ = way;
      if (std::abs(x) > kFar)
      {
        break;
      }
      Vector3d told = 0.4 * hold();
      told[axis] = way * force;
      last_ = send(told);
      record.sent.push_back(last_.sent);
      record.time.push_back(last_.time);
      record.position.push_back(last_.position[axis]);
      record.force.push_back({ told[axis], told[(axis + 1) % 3], told[(axis + 2) % 3] });
    }
    return record;
  }

  // of the position and its change over the last exchanges
  [[nodiscard]] Vector3d hold()
  {
    constexpr double kSpring = 20.0; // [N/m]
    constexpr double kDamper = 1.0;  // [N s/m]
    const double dt = last_.time - before_.time;
    if (dt > 0.008)
    {
      velocity_ = (last_.position - before_.position) / dt;
      before_ = last_;
    }
    const Vector3d asked = -kSpring * (last_.position - center_) - kDamper * velocity_;
    const double size = asked.norm();
    return size > kSwingForce ? Vector3d(asked * (kSwingForce / size)) : asked;
  }

  const ArmExchange& exchange_;
  double step_;
  std::optional<ArmPosition> heard_; // the last that was taken
  JointWatch joints_;
  Eigen::Matrix3d motions_ = Eigen::Matrix3d::Identity(); // unit, of a push along each axis
  ArmPosition begin_;
  Vector3d center_ = Vector3d::Zero();
  ArmPosition last_;
  ArmPosition before_;
  Vector3d velocity_ = Vector3d::Zero();
  bool turned_ = false;
  double lastWay_ = 1.0;
};

// why no mass was found
std::string noSwing(const char* axis, double late)
{
  constexpr double kOften = 0.01;
  return late > kOften ? "this computer was late in " + std::to_string(std::lround(100.0 * late)) +
      " % of the exchanges, and nothing is kept; end what else runs, and try again"
                       : std::string("the arm does not swing along ") + axis +
      " as a mass with friction does, and nothing is kept; balance it, let go of it, and try again";
}

} // namespace

IdentifiedArm identifyArm(const ArmExchange& exchange, double step)
{
  Pusher pusher(exchange, step);
  pusher.checkThatItRests();
  IdentifiedArm arm{ .encoderStep = step };
  std::array<double, 3> breakaway{};
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto i = static_cast<std::size_t>(axis);
    arm.axes[i].agreement = pusher.agreement(axis, breakaway[i]);
  }
  (void)pusher.send(Vector3d::Zero());
  pusher.checkThatAllMoves();
  if (!arm.agrees())
  {
    return arm;
  }
  std::array<std::vector<Swing>, 3> swings;
  std::array<double, 3> delays{};
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto i = static_cast<std::size_t>(axis);
    swings[i] = pusher.swings(axis, breakaway[i]);
    delays[i] = fitSwings(swings[i], step).delay;
    arm.late = std::max(arm.late, lateShare(swings[i]));
  }
  pusher.bringBack(0.5);
  (void)pusher.send(Vector3d::Zero());
  std::ranges::sort(delays);
  arm.delay = delays[1];
  for (std::size_t i = 0; i < 3; ++i)
  {
    const SwingModel model = fitSwings(swings[i], step, arm.delay);
    if (!(model.mass >= IdentifiedArm::kLeastMass))
    {
      refuse(noSwing(kNames[i], arm.late));
    }
    arm.axes[i].mass = model.mass;
    arm.axes[i].damping = model.damping;
    arm.axes[i].friction = model.friction;
  }
  return arm;
}

} // namespace palp
