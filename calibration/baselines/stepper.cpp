#include "calibration/baselines/stepper.h"

#include "calibration/baselines/backward_euler.h"
#include "calibration/baselines/corotational.h"
#include "calibration/baselines/mass_spring.h"
#include "haptics/error.h"

#include <array>
#include <cmath>
#include <optional>
#include <string>

namespace palp::fem
{
namespace
{

using Eigen::Matrix3Xd;
using Eigen::Vector3d;

constexpr double kNearBase = 1 - 1e-6; // a node on the rim of the tool is off it [-]
constexpr double kLongestStep = 1.0;   // [s]
constexpr double kPulled = 0.25; // of the push of a tool that presses; beyond, it is lifted [-]
constexpr int kMaxSolves = 3;    // in a step

void require(bool good, const std::string& message)
{
  if (!good)
  {
    throw Error(ErrorCode::BadValue, message);
  }
}

StepSettings checked(const StepSettings& settings)
{
  const auto atLeast = [](double value, double least)
  { return std::isfinite(value) && value >= least; };
  require(settings.mostIterations >= 1, "step: at least 1 iteration of conjugate gradients");
  require(atLeast(settings.tolerance, 0.0) && settings.tolerance < 1.0,
    "step: the tolerance must be from 0 to less than 1");
  require(atLeast(settings.density, 1.0), "step: the density must be 1 kg/m^3 or more");
  require(atLeast(settings.massDamping, 0.0) && atLeast(settings.stiffnessDamping, 0.0),
    "step: damping must not be negative");
  return settings;
}

Material checked(const Material& material, Baseline baseline)
{
  const double nu = material.poissonRatio;
  require(baseline == Baseline::MassSpring || nu < 0.5,
    std::string(name(baseline)) + ": nu = 0.5 locks linear elements; give 0.49 or less");
  require(baseline != Baseline::MassSpringVolume || nu >= 0.25,
    "mass-spring-volume: springs have nu = 1/4 already; give 0.25 or more");
  return makeMaterial(material.youngModulus, nu);
}

Eigen::VectorXd lumpedMasses(const TetMesh& mesh, double density)
{
  Eigen::VectorXd masses = Eigen::VectorXd::Zero(mesh.positions.cols());
  for (const auto& tet : mesh.tets)
  {
    masses(tet).array() += 0.25 * density * volume(mesh.positions, tet);
  }
  return masses;
}

const TetMesh& checkedMesh(const TetMesh& mesh)
{
  check(mesh);
  return mesh;
}

std::unique_ptr<Elasticity> makeElasticity(
  Baseline baseline, const TetMesh& mesh, const BlockMatrix& matrix, const Material& material)
{
  if (baseline == Baseline::Corotational)
  {
    return std::make_unique<CorotationalTets>(mesh, matrix, material);
  }
  return std::make_unique<MassSprings>(
    mesh, matrix, material, baseline == Baseline::MassSpringVolume);
}

} // namespace

std::string_view name(Baseline baseline) noexcept
{
  constexpr std::array<std::string_view, 3> kNames{ "corotational", "mass-spring",
    "mass-spring-volume" };
  return kNames[static_cast<std::size_t>(baseline)];
}

struct Stepper::State
{
  State(TetMesh body, Baseline baseline, const Tip& tool, const Material& material,
    const StepSettings& how)
    : mesh(std::move(body))
    , tip(checkedTip(tool))
    , settings(checked(how))
    , stiffness(static_cast<int>(checkedMesh(mesh).positions.cols()), mesh.tets)
    , elasticity(makeElasticity(baseline, mesh, stiffness, checked(material, baseline)))
    , masses(lumpedMasses(mesh, settings.density))
    , euler(masses, mesh.bonded)
    , positions(mesh.positions)
    , velocities(Matrix3Xd::Zero(3, positions.cols()))
    , forces(velocities)
    , touching(mesh.surface.size(), 0)
  {
  }

  void findContacts(double dt);
  [[nodiscard]] double push(const VelocityConstraint& contact) const; // of the tool on a node [N]
  [[nodiscard]] bool dropPulled();
  BackwardEuler::Solution solve(double dt);
  StepOutcome step(double dt);

  TetMesh mesh;
  Tip tip;
  StepSettings settings;
  BlockMatrix stiffness;
  std::unique_ptr<Elasticity> elasticity;
  Eigen::VectorXd masses;
  BackwardEuler euler;
  Matrix3Xd positions;  // [m]
  Matrix3Xd velocities; // [m/s]
  Matrix3Xd before;     // velocities at the start of a step [m/s]
  Matrix3Xd forces;     // of elasticity [N]
  std::optional<Vector3d> apex;
  std::vector<char> touching;               // per node of the surface, as the last step left it
  std::vector<VelocityConstraint> contacts; // in this step
  std::vector<std::size_t> touchers;        // the same, into mesh.surface
};

// nodes in the tool, or on it since the last step, are put on its surface by the end of this one
void Stepper::State::findContacts(double dt)
{
  contacts.clear();
  touchers.clear();
  if (!apex)
  {
    touching.assign(touching.size(), 0);
    return;
  }
  const double base = kNearBase * baseRadius(tip);
  for (std::size_t i = 0; i < touching.size(); ++i)
  {
    const int node = mesh.surface[i];
    const Vector3d at = positions.col(node) - *apex;
    const double radius = at.head<2>().norm();
    const bool below = radius < base;
    const double gap = below ? tipHeight(tip, radius) - at.z() : 0.0; // vertical
    touching[i] = below && (touching[i] != 0 || gap < 0.0) ? 1 : 0;
    if (touching[i] != 0)
    {
      const double slope = tipSlope(tip, radius);
      const double steep = std::hypot(1.0, slope);
      Vector3d normal(0.0, 0.0, -1.0 / steep); // out of the tool
      if (radius > 0.0)
      {
        normal.head<2>() = slope / (steep * radius) * at.head<2>();
      }
      contacts.push_back(
        { .node = node, .normal = normal.normalized(), .speed = -gap / (steep * dt) });
      touchers.push_back(i);
    }
  }
}

double Stepper::State::push(const VelocityConstraint& contact) const
{
  return contact.normal.dot(euler.reactions().col(contact.node));
}

// drops the nodes that the tool pulls; false where they hardly matter
bool Stepper::State::dropPulled()
{
  double pushed = 0.0;
  double pulled = 0.0;
  for (const VelocityConstraint& contact : contacts)
  {
    (push(contact) >= 0.0 ? pushed : pulled) += std::abs(push(contact));
  }
  if (pulled <= kPulled * pushed)
  {
    return false;
  }
  std::size_t kept = 0;
  for (std::size_t c = 0; c < contacts.size(); ++c)
  {
    const bool keep = push(contacts[c]) >= 0.0;
    touching[touchers[c]] = keep ? 1 : 0;
    contacts[kept] = contacts[c];
    touchers[kept] = touchers[c];
    kept += keep ? 1 : 0;
  }
  contacts.resize(kept);
  touchers.resize(kept);
  return true;
}

BackwardEuler::Solution Stepper::State::solve(double dt)
{
  before = velocities;
  BackwardEuler::Solution all{};
  for (int k = 0; k < kMaxSolves; ++k)
  {
    velocities = before;
    const auto solution = euler.solve({ .stiffness = stiffness,
                                        .forces = forces,
                                        .given = contacts,
                                        .dt = dt,
                                        .alpha = settings.massDamping,
                                        .beta = settings.stiffnessDamping,
                                        .mostIterations = settings.mostIterations,
                                        .tolerance = settings.tolerance },
      velocities);
    all.iterations += solution.iterations;
    all.residual = solution.residual;
    if (k + 1 == kMaxSolves || !dropPulled())
    {
      break;
    }
  }
  return all;
}

StepOutcome Stepper::State::step(double dt)
{
  require(std::isfinite(dt) && dt > 0.0 && dt <= kLongestStep,
    "step: the time step must be more than 0 and at most 1 s");
  StepOutcome outcome;
  outcome.elasticEnergy = elasticity->evaluate(positions, forces, stiffness);
  findContacts(dt);
  const auto solution = solve(dt);
  positions += dt * velocities;
  if (!positions.allFinite())
  {
    throw Error(ErrorCode::NoSolution,
      "the simulation diverged; start again by reset(), with shorter time steps");
  }

  outcome.iterations = solution.iterations;
  outcome.residual = solution.residual;
  outcome.touching = static_cast<int>(contacts.size());
  for (std::size_t c = 0; c < contacts.size(); ++c)
  {
    outcome.force -= push(contacts[c]) * contacts[c].normal.z();
    touching[touchers[c]] = push(contacts[c]) >= 0.0 ? 1 : 0; // a node that is pulled is let go
  }
  for (const int i : mesh.bonded)
  {
    outcome.baseReaction += euler.reactions()(2, i);
  }
  outcome.kineticEnergy = 0.5 * velocities.colwise().squaredNorm().dot(masses);
  return outcome;
}

Stepper::Stepper(TetMesh mesh, Baseline baseline, const Tip& tip, const Material& material,
  const StepSettings& settings)
  : state_(std::make_unique<State>(std::move(mesh), baseline, tip, material, settings))
{
}

Stepper::~Stepper() = default;
Stepper::Stepper(Stepper&&) noexcept = default;
Stepper& Stepper::operator=(Stepper&&) noexcept = default;

void Stepper::placeTool(const Vector3d& apex)
{
  const Matrix3Xd& rest = state_->mesh.positions;
  const auto top = rest(Eigen::all, state_->mesh.surface);
  const auto base = rest(Eigen::all, state_->mesh.bonded);
  require(apex.allFinite(), "tool: its position is not a finite number");
  require((apex.array() >= top.rowwise().minCoeff().array()).head<2>().all() &&
      (apex.array() <= top.rowwise().maxCoeff().array()).head<2>().all(),
    "tool: its apex is beside the surface; place it above");
  require(apex.z() > base.row(2).minCoeff(), "tool: its apex is below the bonded base; lift it");
  state_->apex = apex;
}

void Stepper::removeTool() noexcept
{
  state_->apex.reset();
}

StepOutcome Stepper::step(double dt)
{
  return state_->step(dt);
}

void Stepper::reset()
{
  state_->positions = state_->mesh.positions;
  state_->velocities.setZero();
  state_->touching.assign(state_->touching.size(), 0);
  state_->apex.reset();
  state_->elasticity->reset();
}

const TetMesh& Stepper::mesh() const noexcept
{
  return state_->mesh;
}

const Matrix3Xd& Stepper::positions() const noexcept
{
  return state_->positions;
}

const Matrix3Xd& Stepper::velocities() const noexcept
{
  return state_->velocities;
}

} // namespace palp::fem
