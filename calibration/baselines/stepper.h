#pragma once

#include "calibration/baselines/tet_mesh.h"
#include "haptics/material.h"
#include "haptics/tip/tip.h"

#include <array>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

namespace palp::fem
{

/// What the paper's own step is compared with, Fig. 12.
enum class Baseline
{
  Corotational,     ///< linear tetrahedra that turn with their rotation; any nu below 0.5
  MassSpring,       ///< a spring along every edge; nu is 1/4 whatever is asked
  MassSpringVolume, ///< springs, and elements that hold their volume; nu from 1/4 to below 0.5
};

inline constexpr std::array kBaselines{ Baseline::Corotational, Baseline::MassSpring,
  Baseline::MassSpringVolume };

/// corotational, mass-spring, mass-spring-volume
[[nodiscard]] std::string_view name(Baseline baseline) noexcept;

/// How a step is solved. The paper states none of these figures; 25 iterations are usual.
struct StepSettings
{
  int mostIterations = 25;        ///< of conjugate gradients in one solve, 1 or more
  double tolerance = 1e-5;        ///< |residual| / |forces and momenta| at which they stop [-]
  double density = 1060.0;        ///< of the tissue [kg/m^3]
  double massDamping = 0.0;       ///< Rayleigh's alpha [1/s]
  double stiffnessDamping = 2e-3; ///< Rayleigh's beta [s]
};

/// What one step came to.
struct StepOutcome
{
  double force = 0.0;         ///< on the tool, along +z: positive pushes it out [N]
  double baseReaction = 0.0;  ///< of the bonded nodes on the body, along +z [N]; force, at rest
  int iterations = 0;         ///< of conjugate gradients
  double residual = 0.0;      ///< as tolerance is meant [-]
  int touching = 0;           ///< nodes on the tool
  double kineticEnergy = 0.0; ///< after the step [J]
  double elasticEnergy = 0.0; ///< before the step [J]
};

class Elasticity;

/// A soft body under a rigid, frictionless tool, stepped in time.
///
/// Backward Euler with one linearisation a step (Baraff and Witkin 1998), lumped masses, Rayleigh
/// damping. Conjugate gradients with the diagonal as preconditioner start from the last
/// velocities. Surface nodes inside the tool are put on it within the step: their velocity along
/// its normal is prescribed in the solve and the force that takes is the contact force, exact
/// whatever the stiffness. Nodes that the tool would pull are let go in the next step; where the
/// pull is above a quarter of the push, as of a tool that is lifted quickly, in another solve of
/// this one. The sharp rim of a punch holds no node: they slip around it, and the force shivers.
class Stepper
{
public:
  /// @param material  nu as the baseline takes it
  /// @throws Error    BadMesh: see check(); BadValue: material, tool or a setting out of range
  Stepper(TetMesh mesh, Baseline baseline, const Tip& tip, const Material& material,
    const StepSettings& settings = {});
  ~Stepper();
  Stepper(Stepper&&) noexcept;
  Stepper& operator=(Stepper&&) noexcept;

  /// Where the tool is at the end of the next steps, its axis along z, apex down.
  /// @param apex    [m]; without a call the tool is away
  /// @throws Error  BadValue: no number, beside the surface, or below the base
  void placeTool(const Eigen::Vector3d& apex);

  /// Takes the tool away.
  void removeTool() noexcept;

  /// Advances by one time step.
  /// @param dt      [s], more than 0, to 1
  /// @throws Error  BadValue: dt; NoSolution: the motion ran away
  StepOutcome step(double dt);

  /// Back to rest, tool away.
  void reset();

  [[nodiscard]] const TetMesh& mesh() const noexcept;

  /// Of all nodes, now; columns mesh().surface are the surface [m].
  [[nodiscard]] const Eigen::Matrix3Xd& positions() const noexcept;
  [[nodiscard]] const Eigen::Matrix3Xd& velocities() const noexcept; ///< [m/s]

private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Times of steps along a path of the tool, one placeTool() and step() each.
struct StepTimes
{
  std::vector<double> milliseconds;  ///< per step, the wall clock
  std::vector<StepOutcome> outcomes; ///< of the same steps
  double mean = 0.0;                 ///< [ms], as are those below
  double deviation = 0.0;
  double median = 0.0;
  double iterations = 0.0; ///< in the mean
};

/// @param apexes  of the tool at the end of each step [m]; one or more
[[nodiscard]] StepTimes timeSteps(
  Stepper& stepper, std::span<const Eigen::Vector3d> apexes, double dt);

/// A press at the middle of a surface in z = 0: down at constant speed, then held.
/// @param depth  [m]
/// @param speed  [m/s]
/// @param hold   [s]
[[nodiscard]] std::vector<Eigen::Vector3d> pressPath(
  double depth, double speed, double hold, double dt);

/// Steps until the force of a tool stands still and the base carries it.
/// @param change  of the force in a step, and to that on the base, below which it stands still [-]
/// @throws Error  NoSolution: it still moves after mostSteps
StepOutcome settle(Stepper& stepper, double dt, double change = 1e-5, int mostSteps = 2000);

} // namespace palp::fem
