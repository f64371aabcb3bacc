#include "calibration/organ/organ_model.h"

#include "calibration/organ/cubes/cube_nodes.h"
#include "calibration/organ/cubes/cube_stiffness.h"
#include "calibration/organ/cubes/cut_grid.h"
#include "calibration/organ/shared_cholesky.h"
#include "calibration/organ/support_grip.h"
#include "calibration/organ/surface_parts.h"
#include "haptics/error.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

namespace palp
{
namespace
{

using Sparse = SharedCholesky::Sparse;
using Nodes = CubeNodes::Corners;

constexpr double kLeast = 0.03; // filled part of a cube that counts

} // namespace

struct OrganModel::State
{
  CutGrid grid;
  double young;
  double poisson;
  ModulusRatio ratio;
  CubeNodes nodes;
  CubeModuli moduli;
  std::vector<SupportGrip> grips{};
  Sparse even{};   // lower half, of the cubes if they were, where they are not
  Sparse varied{}; // the same as they are
  SharedCholesky cholesky{};

  State(const Surface& surface, double side, double youngModulus, double poissonRatio,
    const ModulusRatio& variation)
    : grid(surface, side)
    , young(youngModulus)
    , poisson(poissonRatio)
    , ratio(variation)
    , nodes(grid, kLeast)
    , moduli(ratio ? CubeModuli(grid, nodes.cells(), ratio) : CubeModuli())
  {
  }

  void hold(const OrganModel& model, const Surface& surface, std::span<const Support> supports)
  {
    for (const Support& support : supports)
    {
      std::map<int, SupportGrip> byCube;
      double held = 0.0; // [m^2]
      forParts(surface, Eigen::Vector3d::Zero(), 0.5 * grid.side(), 0.0,
        [&](const Eigen::Vector3d& middle, const Eigen::Vector3d& area)
        {
          OrganModel::Weights weights{};
          const bool isHeld = support.holds(middle);
          held += isHeld ? area.norm() : 0.0;
          if (isHeld && model.weightsAt(middle, area.normalized(), weights, kLeast))
          {
            byCube[weights.nodes[0]].add(weights, middle, area.norm());
          }
        });
      if (held > 0.0 && byCube.empty())
      {
        throw Error(ErrorCode::BadValue,
          "a support is on no cell of the body, or on a piece of it that no cells join to the "
          "largest; give smaller cells, or a file of one piece");
      }
      for (auto& [cube, grip] : byCube)
      {
        grip.along = support.along;
        grip.divide();
        grips.push_back(grip);
      }
    }
    checkHeld(grips, grid.side() * *std::max_element(grid.size().begin(), grid.size().end()));
  }

  [[nodiscard]] double stiffnessOf(const SupportGrip& grip) const
  {
    constexpr double stiff = 1e3; // against the cubes
    return stiff * young * moduli.largest() / grid.side() * grip.area;
  }

  // of all cubes, each times its ratio
  [[nodiscard]] Sparse assembled(std::span<const double> times) const
  {
    const CubeStiffness whole = cubeStiffness(grid.side(), young, poisson);
    std::vector<Eigen::Triplet<double>> all;
    const std::vector<Cube>& cells = nodes.cells();
    all.reserve(cells.size() * 300);
    for (std::size_t cube = 0; cube < cells.size(); ++cube)
    {
      const double part = times.empty() ? 1.0 : times[cube];
      const CubePoints& inside = grid.inside(cells[cube]);
      add(all, nodes.corners()[cube],
        CubeStiffness(
          part * (inside.all() ? whole : cutCubeStiffness(grid.side(), young, poisson, inside))));
    }
    return fromTriplets(all);
  }

  template <typename Stiffness>
  static void add(
    std::vector<Eigen::Triplet<double>>& all, const Nodes& nodes, const Stiffness& stiffness)
  {
    for (int i = 0; i < 24; ++i)
    {
      for (int j = 0; j < 24; ++j)
      {
        const int row = 3 * nodes[at(i / 3)] + i % 3;
        const int column = 3 * nodes[at(j / 3)] + j % 3;
        row >= column ? void(all.emplace_back(row, column, stiffness(i, j))) : void();
      }
    }
  }

  [[nodiscard]] Sparse fromTriplets(const std::vector<Eigen::Triplet<double>>& all) const
  {
    const auto count = static_cast<Eigen::Index>(3 * nodes.places().size());
    Sparse matrix(count, count); // its lower half
    matrix.setFromTriplets(all.begin(), all.end());
    return matrix;
  }

  void factorize()
  {
    varied = assembled(moduli.ratios());
    std::vector<Eigen::Triplet<double>> held;
    for (const SupportGrip& grip : grips)
    {
      const Eigen::Matrix3d spring = stiffnessOf(grip) * grip.direction();
      add(held, grip.weights.nodes,
        [&](int i, int j) {
          return grip.weights.values[at(i / 3)] * grip.weights.values[at(j / 3)] *
            spring(i % 3, j % 3);
        });
    }
    cholesky.cholmod().print = 0; // the error below says it
    cholesky.compute(Sparse(varied + fromTriplets(held)));
    if (cholesky.info() != Eigen::Success)
    {
      throw Error(ErrorCode::NoSolution,
        "the body's stiffness cannot be factorized; give larger cells or another support");
    }
    moduli.ratios().empty() ? void(varied = Sparse()) : void(even = assembled({}));
  }
};

OrganModel::OrganModel(const Surface& surface, double side, double youngModulus,
  double poissonRatio, std::span<const Support> supports, const ModulusRatio& ratio)
  : state_(new State(surface, side, youngModulus, poissonRatio, ratio))
{
  if (state_->nodes.places().empty())
  {
    throw Error(ErrorCode::BadValue, "no cell is filled by the body; give smaller ones");
  }
  SharedCholesky::checkMemory(state_->nodes.places().size());
  state_->hold(*this, surface, supports);
  state_->factorize();
}

OrganModel::~OrganModel() = default;
OrganModel::OrganModel(OrganModel&&) noexcept = default;
OrganModel& OrganModel::operator=(OrganModel&&) noexcept = default;

int OrganModel::nodes() const noexcept
{
  return static_cast<int>(state_->nodes.places().size());
}

double OrganModel::leftOut() const noexcept
{
  return state_->nodes.leftOut();
}

double OrganModel::side() const noexcept
{
  return state_->grid.side();
}

double OrganModel::contactModulus() const noexcept
{
  return state_->young / (1.0 - state_->poisson * state_->poisson);
}

double OrganModel::shearModulus() const noexcept
{
  return state_->young / (2.0 * (1.0 + state_->poisson));
}

double OrganModel::poissonRatio() const noexcept
{
  return state_->poisson;
}

bool OrganModel::weightsAt(const Eigen::Vector3d& place, const Eigen::Vector3d& outward,
  Weights& weights, double filled) const
{
  const State& state = *state_;
  const double side = state.grid.side();
  constexpr int kSteps = 11; // of a quarter of a side, inwards
  for (int step = 0; step < kSteps; ++step)
  {
    const Eigen::Vector3d from = place - outward * (0.25 * step + 1e-7) * side;
    const Cube cube = state.grid.cubeAt(from);
    const Nodes* nodes = state.nodes.of(cube);
    if (nodes == nullptr || !(state.grid.filled(cube) >= filled))
    {
      continue;
    }
    const Eigen::Vector3d within = (place - state.grid.cornerOf(cube)) / side;
    for (int corner = 0; corner < kCubeCorners; ++corner)
    {
      double value = 1.0;
      for (int axis = 0; axis < 3; ++axis)
      {
        value *= ((corner >> axis) & 1) != 0 ? within[axis] : 1.0 - within[axis];
      }
      weights.values[at(corner)] = value;
    }
    weights.nodes = *nodes;
    return true;
  }
  return false;
}

bool OrganModel::isBesideSupport(
  const Eigen::Vector3d& place, const Eigen::Vector3d& outward) const noexcept
{
  constexpr double kNear = 2.0; // sides, as wide as the load is
  return std::ranges::any_of(state_->grips,
    [&](const SupportGrip& grip)
    {
      const Eigen::Vector3d away = grip.place - place;
      return grip.along.isZero(0.0) && away.norm() < kNear * side() && -outward.dot(away) < side();
    });
}

void OrganModel::moveSupports(Eigen::Ref<Eigen::VectorXd> forces, const Moved& supports) const
{
  for (const SupportGrip& grip : state_->grips)
  {
    const Eigen::Vector3d pull =
      state_->stiffnessOf(grip) * grip.direction() * supports(grip.place);
    for (std::size_t i = 0; i < grip.weights.nodes.size(); ++i)
    {
      forces.segment<3>(3L * grip.weights.nodes[i]) += grip.weights.values[i] * pull;
    }
  }
}

const CubeModuli& OrganModel::moduli() const noexcept
{
  return state_->moduli;
}

const ModulusRatio& OrganModel::ratio() const noexcept
{
  return state_->ratio;
}

void OrganModel::varyLoad(
  Eigen::Ref<Eigen::VectorXd> forces, const Moved& field, double ratio) const
{
  const State& state = *state_;
  if (state.moduli.ratios().empty())
  {
    return;
  }
  Eigen::VectorXd moved(forces.size());
  for (std::size_t i = 0; i < state.nodes.places().size(); ++i)
  {
    moved.segment<3>(3 * static_cast<Eigen::Index>(i)) = field(state.nodes.places()[i]);
  }
  const Eigen::VectorXd even = state.even.selfadjointView<Eigen::Lower>() * moved;
  const Eigen::VectorXd varied = state.varied.selfadjointView<Eigen::Lower>() * moved;
  forces += ratio * even - varied;
}

Eigen::MatrixXd OrganModel::solve(const Eigen::MatrixXd& forces) const
{
  return state_->cholesky.solveAll(forces);
}

} // namespace palp
