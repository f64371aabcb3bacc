#include "calibration/fem/indenter.h"

#include "haptics/error.h"
#include "haptics/units.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace palp::fem
{
namespace
{

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::VectorXd;

constexpr int kMaxIterations = 40;
constexpr int kExtrapolated = 12; // iterations, before it begins again without extrapolation
constexpr int kMaxHalvings = 6;
constexpr double kBalanced = 1e-8; // unbalanced force to contact force [-]
constexpr double kChatterTolerance =
  1e-4; // the same, for a node that shivers on an edge of the tool [-]
constexpr int kMaxTightIterations = 20; // iterations before shivering is let pass
constexpr double kClosed = 1e-4; // gap to depth below which nodes are put on the tool exactly [-]

constexpr double kInTool = 1e-6;       // penetration to depth that is let pass [-]
constexpr double kPulled = 1e-7;       // pull at a node to contact force that is let pass [-]
constexpr double kNearBase = 1 - 1e-6; // a node on the rim of the tool is off it [-]
constexpr int kManyChanges = 8;        // of the contact, before nodes change one at a time
constexpr int kMaxChanges = 60;

constexpr double kShortest = 1e-2; // part of a Newton step that is still tried [-]
constexpr double kNoWorse = 1.5;   // growth of the imbalance that a step may cause [-]
constexpr double kDecrease = 0.5;  // of the imbalance, as good as a decrease of the energy [-]
constexpr std::array kAddedStiffness{ 0.0, 0.01, 0.1, 1.0 }; // to the diagonal [-]

} // namespace

Indenter::Indenter(const Body& body, const Tip& tip, StrainEnergy energy, const Material& material)
  : body_(body)
  , tip_(tip)
  , energy_(energy)
  , equilibrium_(body, energy, material)
  , displacement_(VectorXd::Zero(body.dofCount()))
  , touching_(body.surface.size(), 0)
  , previous_(displacement_)
{
  (void)equilibrium_.assemble(displacement_);
}

double Indenter::heightOf(int node) const
{
  const int d = body_.dimension;
  return body_.positions(d - 1, node) + displacement_[d * node + d - 1];
}

Indenter::ToolPoint Indenter::toolAt(int node) const
{
  // small-strain theory meets the tool at the undeformed radius
  const int horizontal = body_.dimension - 1;
  Vector2d at = Vector2d::Zero();
  at.head(horizontal) = body_.positions.col(node).head(horizontal);
  if (energy_ != StrainEnergy::Linear)
  {
    at.head(horizontal) += displacement_.segment(body_.dofOf(node), horizontal);
  }
  const double radius = at.norm();
  const double base = baseRadius(tip_);
  ToolPoint point{ .height = body_.top - depth_ + tipHeight(tip_, radius),
    .slope = Vector2d::Zero(),
    .curvature = Matrix2d::Zero(),
    .below = radius < kNearBase * base };
  if (energy_ == StrainEnergy::Linear)
  {
    return point;
  }
  const double h = 1e-4 * base; // short against elements, long against the shiver at an edge
  const double inner = std::max(0.0, radius - h);
  const double bend = (tipSlope(tip_, radius + h) - tipSlope(tip_, inner)) / (radius + h - inner);
  const double slope = tipSlope(tip_, radius);
  const Vector2d outward = radius > 0.0 ? Vector2d(at / radius) : Vector2d::UnitX();
  point.slope = slope * outward;
  point.curvature = bend * outward * outward.transpose() +
    (radius > 0.0 ? slope / radius : bend) * (Matrix2d::Identity() - outward * outward.transpose());
  return point;
}

std::vector<ContactConstraint> Indenter::sliding() const
{
  std::vector<ContactConstraint> result;
  for (std::size_t i = 0; i < touching_.size(); ++i)
  {
    if (touching_[i] != 0)
    {
      const int node = body_.surface[i];
      const ToolPoint tool = toolAt(node);
      result.push_back({ .node = node,
        .gap = tool.height - heightOf(node),
        .slope = tool.slope,
        .curvature = tool.curvature });
    }
  }
  return result;
}

// releases nodes that are pulled, takes nodes that are inside; false where nothing changed
bool Indenter::updateContact(double forceScale, bool onlyOne)
{
  const int d = body_.dimension;
  bool changed = false;
  for (std::size_t i = touching_.size(); i-- > 0 && !(changed && onlyOne);)
  {
    const int node = body_.surface[i];
    const ToolPoint tool = toolAt(node);
    const bool was = touching_[i] != 0;
    const bool enclosed = d == 2 && i + 1 < touching_.size() && touching_[i + 1] != 0;
    const double pull = equilibrium_.guessedForces()[d * node + d - 1];
    const bool inside = tool.below && heightOf(node) - tool.height > kInTool * depth_;
    const bool is = was ? enclosed || (tool.below && pull <= kPulled * forceScale) : inside;
    changed = changed || is != was;
    touching_[i] = is ? 1 : 0;
  }
  return changed;
}

// a step that goes downhill also where the energy is not convex, as where a node slips around an
// edge of the tool or a material softens: first without the tool's curvature, then stiffened
Equilibrium::Step Indenter::descentStep(std::vector<ContactConstraint> nodes, bool mayTurn)
{
  Equilibrium::Step step = equilibrium_.solve(nodes);
  for (const double added : kAddedStiffness)
  {
    if (step.stable || !mayTurn)
    {
      break;
    }
    for (ContactConstraint& s : nodes)
    {
      s.curvature.setZero();
    }
    step = equilibrium_.solve(nodes, added);
  }
  return step;
}

std::string Indenter::solveEquilibrium(double depth, const std::stop_token& stop, int iterations)
{
  depth_ = depth;
  if (!equilibrium_.follow(displacement_, 0.0))
  {
    return "an element is inverted";
  }
  double force = 0.0;
  double imbalance = 0.0;
  int changes = 0;
  for (int k = 0; k < iterations && !stop.stop_requested(); ++k)
  {
    // who touches is asked anew once the forces are nearly balanced: sooner, they mislead
    const bool careful = changes > kManyChanges;
    const bool ask = k == 0 ? force_ == 0.0 : imbalance <= (careful ? 0.01 : 1.0) * force;
    const bool changed = ask && updateContact(force, careful);
    changes += changed ? 1 : 0;
    k = changed && careful ? std::min(k, kMaxTightIterations / 2) : k;
    if (changes > kMaxChanges)
    {
      return "the contact active set did not converge";
    }

    const auto nodes = sliding();
    const auto step = descentStep(nodes, k > 0);
    double gap = 0.0;
    force = 0.0;
    for (const ContactConstraint& s : nodes)
    {
      gap = std::max(gap, std::abs(s.gap));
      force += std::abs(equilibrium_.guessedForces()[body_.dimension * (s.node + 1) - 1]);
    }
    imbalance = step.imbalance;
    const double balanced = k < kMaxTightIterations ? kBalanced : kChatterTolerance;
    if (ask && !changed && k > 0 && step.residual <= balanced * force && gap <= kInTool * depth)
    {
      force_ = force;
      return surfaceFault();
    }
    if (step.change.size() == 0)
    {
      return "the stiffness matrix is singular";
    }
    if (!lineSearch(step, nodes, gap <= kClosed * depth))
    {
      return "an element is inverted";
    }
  }
  return "equilibrium did not converge: the material may have lost its stability";
}

// along a Newton step, as far as elements stay valid and the forces or the energy get no worse
bool Indenter::lineSearch(
  const Equilibrium::Step& step, std::vector<ContactConstraint> nodes, bool closed)
{
  const VectorXd before = displacement_;
  const double energy = equilibrium_.energy();
  for (double length = 1.0; length > kShortest; length *= 0.5)
  {
    displacement_ = before + length * step.change;
    for (ContactConstraint& s : nodes)
    {
      const ToolPoint tool = toolAt(s.node);
      s.slope = tool.slope;
      if (closed)
      {
        const int height = body_.dimension * (s.node + 1) - 1;
        displacement_[height] = tool.height - body_.positions(body_.dimension - 1, s.node);
      }
    }
    if (equilibrium_.follow(displacement_, length))
    {
      const double imbalance = equilibrium_.imbalance(nodes);
      const bool better = closed ? equilibrium_.energy() < energy ||
          imbalance <= (step.stable ? kNoWorse : kDecrease) * step.imbalance
                                 : imbalance <= kNoWorse * step.imbalance;
      if (better || length < 4.0 * kShortest)
      {
        return true;
      }
    }
  }
  return false;
}

// no mesh folds around a sharp edge; a sphere meets its shaft without one
bool Indenter::contactReachesRim() const
{
  const double base = baseRadius(tip_);
  return tipSlope(tip_, base) < 1e3 && contactRadius() > base - body_.elementSize;
}

void Indenter::press(double depth, const std::stop_token& stop)
{
  double step = depth - depth_;
  const double smallest = step / (1 << kMaxHalvings);
  while (depth_ < depth)
  {
    const Held start{ displacement_, touching_, depth_, force_ };
    const double to = depth - depth_ < 1.5 * step ? depth : depth_ + step;
    if (depth_ > previousDepth_)
    {
      displacement_ += (to - depth_) / (depth_ - previousDepth_) * (start.displacement - previous_);
    }
    std::string failure =
      solveEquilibrium(to, stop, start.depth > 0.0 ? kExtrapolated : kMaxIterations);
    if (!failure.empty() && start.depth > 0.0)
    {
      restore(start); // without extrapolation
      failure = solveEquilibrium(to, stop, kMaxIterations);
    }
    if (failure.empty())
    {
      previous_ = start.displacement;
      previousDepth_ = start.depth;
      continue;
    }
    restore(start);
    if (stop.stop_requested())
    {
      throw Error(ErrorCode::NoSolution, kInterrupted);
    }
    step *= 0.5;
    if (step < smallest)
    {
      failure = contactReachesRim() ? "the contact reaches the edge of the tool's rim" : failure;
      char reached[32];
      std::snprintf(reached, sizeof reached, "%.3f mm", units::toMillimeters(depth_));
      throw Error(ErrorCode::NoSolution,
        "indentation: beyond " + std::string(reached) + " " + failure +
          "; stop there, or try another element size");
    }
  }
}

void Indenter::restore(const Held& held)
{
  displacement_ = held.displacement;
  touching_ = held.touching;
  depth_ = held.depth;
  force_ = held.force;
  (void)equilibrium_.assemble(displacement_);
}

void Indenter::resume(const Checkpoint& checkpoint)
{
  if (checkpoint.displacement.size() == displacement_.size())
  {
    displacement_ = checkpoint.displacement;
    touching_.assign(touching_.size(), 0);
    force_ = 0.0; // who touches is asked at once
    depth_ = previousDepth_ = checkpoint.depth;
    previous_ = displacement_;
    for (std::size_t i = 0; i < touching_.size(); ++i)
    {
      const ToolPoint tool = toolAt(body_.surface[i]);
      const bool touches =
        tool.below && heightOf(body_.surface[i]) >= tool.height - kInTool * depth_;
      touching_[i] = touches ? 1 : 0;
    }
    if (equilibrium_.assemble(displacement_) &&
      solveEquilibrium(checkpoint.depth, {}, kMaxIterations).empty())
    {
      return;
    }
  }
  throw Error(ErrorCode::BadFile,
    "checkpoint: does not belong to this body and tool; start again without --resume");
}

} // namespace palp::fem
