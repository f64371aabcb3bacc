#include "calibration/organ/organ_model.h"

#include "calibration/organ/cube_stiffness.h"
#include "calibration/organ/cut_grid.h"
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
using Nodes = std::array<int, kCubeCorners>;

constexpr double kLeast = 0.03; // filled part of a cube that counts

Cube cornerOf(const Cube& cube, int corner)
{
  return { cube[0] + (corner & 1), cube[1] + ((corner >> 1) & 1), cube[2] + ((corner >> 2) & 1) };
}

} // namespace

struct OrganModel::State
{
  CutGrid grid;
  double young;
  double poisson;
  ModulusRatio ratio;
  std::vector<int> number{};             // of each corner of the grid; -1: of no cube that counts
  std::vector<Eigen::Vector3d> places{}; // of the nodes
  std::vector<Nodes> cubes{};
  std::vector<Cube> cells{}; // of the grid, each of these
  double leftOut = 0.0;      // of the volume, what no cubes join to these
  std::vector<SupportGrip> grips{};
  CubeModuli moduli{};
  Sparse even{};   // lower half, of the cubes if they were, where they are not
  Sparse varied{}; // the same as they are
  SharedCholesky cholesky{};

  [[nodiscard]] std::size_t cornerIndex(const Cube& c) const
  {
    const auto& size = grid.size();
    return (at(c[2]) * at(size[1] + 1) + at(c[1])) * at(size[0] + 1) + at(c[0]);
  }

  // whether a cube within the grid is one of those that hang together
  [[nodiscard]] bool counts(const Cube& cube) const
  {
    int corner = 0;
    while (corner < kCubeCorners && number[cornerIndex(cornerOf(cube, corner))] >= 0)
    {
      ++corner;
    }
    return corner == kCubeCorners;
  }

  void addCubes()
  {
    const auto& [nx, ny, nz] = grid.size();
    number.assign(at(nx + 1) * at(ny + 1) * at(nz + 1), -1);
    cells = grid.largestPiece(kLeast);
    moduli = ratio ? CubeModuli(grid, cells, ratio) : CubeModuli();
    for (const Cube& cube : cells)
    {
      Nodes nodes{};
      for (int corner = 0; corner < kCubeCorners; ++corner)
      {
        const Cube place = cornerOf(cube, corner);
        int& known = number[cornerIndex(place)];
        if (known < 0)
        {
          known = static_cast<int>(places.size());
          places.push_back(grid.cornerOf(place));
        }
        nodes[at(corner)] = known;
      }
      cubes.push_back(nodes);
    }
    double all = 0.0;
    double joined = 0.0;
    grid.forEach(grid.low(), grid.low() + grid.side() * Eigen::Vector3d(nx, ny, nz),
      [&](const Cube& cube)
      {
        const double filled = grid.filled(cube);
        all += filled >= kLeast ? filled : 0.0;
      });
    for (const Cube& cube : cells)
    {
      joined += grid.filled(cube);
    }
    leftOut = 1.0 - joined / all;
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
    all.reserve(cubes.size() * 300);
    for (std::size_t cube = 0; cube < cubes.size(); ++cube)
    {
      const double part = times.empty() ? 1.0 : times[cube];
      const CubePoints& inside = grid.inside(cells[cube]);
      add(all, cubes[cube],
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
    const auto count = static_cast<Eigen::Index>(3 * places.size());
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
  : state_(new State{ CutGrid(surface, side), youngModulus, poissonRatio, ratio })
{
  state_->addCubes();
  if (state_->places.empty())
  {
    throw Error(ErrorCode::BadValue, "no cell is filled by the body; give smaller ones");
  }
  SharedCholesky::checkMemory(state_->places.size());
  state_->hold(*this, surface, supports);
  state_->factorize();
}

OrganModel::~OrganModel() = default;
OrganModel::OrganModel(OrganModel&&) noexcept = default;
OrganModel& OrganModel::operator=(OrganModel&&) noexcept = default;

int OrganModel::nodes() const noexcept
{
  return static_cast<int>(state_->places.size());
}

double OrganModel::leftOut() const noexcept
{
  return state_->leftOut;
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
    // a corner, or an edge, of a cube that does not count may be one of a cube that does
    if (!(state.grid.filled(cube) >= filled) || !state.counts(cube))
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
      weights.nodes[at(corner)] = state.number[state.cornerIndex(cornerOf(cube, corner))];
      weights.values[at(corner)] = value;
    }
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
  for (std::size_t i = 0; i < state.places.size(); ++i)
  {
    moved.segment<3>(3 * static_cast<Eigen::Index>(i)) = field(state.places[i]);
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
