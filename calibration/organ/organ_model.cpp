#include "calibration/organ/organ_model.h"

#include "calibration/organ/cube_stiffness.h"
#include "haptics/error.h"

#include <Eigen/CholmodSupport>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <string>

namespace palp
{
namespace
{

using Cube = std::array<int, 3>;
using Sparse = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;
using Nodes = std::array<int, kCubeCorners>;

constexpr double kLeast = 0.03; // filled part of a cube that counts
constexpr double kFull = 0.5;   // of one that displacements are read from

Cube cornerOf(const Cube& cube, int corner)
{
  return { cube[0] + (corner & 1), cube[1] + ((corner >> 1) & 1), cube[2] + ((corner >> 2) & 1) };
}

// the cubes that hang together by their faces, most of them
std::vector<Cube> largestPiece(const CutGrid& grid)
{
  const int nx = grid.size()[0];
  const int ny = grid.size()[1];
  const int nz = grid.size()[2];
  const auto index = [&](const Cube& c)
  { return (at(c[2]) * at(ny) + at(c[1])) * at(nx) + at(c[0]); };
  std::vector<bool> met(at(nx) * at(ny) * at(nz));
  std::vector<Cube> largest;
  for (int k = 0; k < nz; ++k)
  {
    for (int j = 0; j < ny; ++j)
    {
      for (int i = 0; i < nx; ++i)
      {
        std::vector<Cube> piece;
        const auto visit = [&](const Cube& cube)
        {
          if (grid.filled(cube) >= kLeast && !met[index(cube)])
          {
            met[index(cube)] = true;
            piece.push_back(cube);
          }
        };
        visit({ i, j, k });
        std::size_t next = 0;
        while (next < piece.size())
        {
          const Cube cube = piece[next++];
          for (std::size_t axis = 0; axis < 3; ++axis)
          {
            for (const int step : { -1, 1 })
            {
              Cube beside = cube;
              beside[axis] += step;
              visit(beside);
            }
          }
        }
        largest = piece.size() > largest.size() ? std::move(piece) : largest;
      }
    }
  }
  return largest;
}

} // namespace

struct OrganModel::State
{
  CutGrid grid;
  double young;
  double poisson;
  std::vector<int> number{};             // of each corner of the grid; -1: of no cube that counts
  std::vector<Eigen::Vector3d> places{}; // of the nodes
  std::vector<Nodes> cubes{};
  std::vector<CubePoints> inside{}; // each of these
  std::vector<int> free{}; // number of each x, y and z of the nodes among the free ones; -1: held
  int count = 0;           // of the free ones
  mutable Eigen::CholmodSupernodalLLT<Sparse> cholesky{};

  [[nodiscard]] std::size_t cornerIndex(const Cube& c) const
  {
    const auto& size = grid.size();
    return (at(c[2]) * at(size[1] + 1) + at(c[1])) * at(size[0] + 1) + at(c[0]);
  }

  void addCubes()
  {
    const auto& [nx, ny, nz] = grid.size();
    number.assign(at(nx + 1) * at(ny + 1) * at(nz + 1), -1);
    for (const Cube& cube : largestPiece(grid))
    {
      Nodes nodes{};
      for (int corner = 0; corner < kCubeCorners; ++corner)
      {
        const Cube place = cornerOf(cube, corner);
        int& known = number[cornerIndex(place)];
        if (known < 0)
        {
          known = static_cast<int>(places.size());
          places.emplace_back(
            grid.low() + grid.side() * Eigen::Vector3d(place[0], place[1], place[2]));
        }
        nodes[at(corner)] = known;
      }
      cubes.push_back(nodes);
      inside.push_back(grid.inside(cube));
    }
  }

  // what is left to move freely is named
  void checkHeld(const Eigen::Matrix<double, 6, 6>& held) const
  {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> solver(held);
    constexpr double least = 1e-9;
    if (solver.eigenvalues()[0] > least * std::max(1e-300, solver.eigenvalues()[5]))
    {
      return;
    }
    Eigen::Index motion = 0;
    solver.eigenvectors().col(0).cwiseAbs().maxCoeff(&motion);
    throw Error(ErrorCode::BadValue,
      std::string("the supports leave the body free to ") +
        (motion < 3 ? "move along " : "turn about ") + "xyz"[motion % 3] +
        "; add one that holds it");
  }

  // @return  springs that hold nodes along a direction
  std::vector<Eigen::Triplet<double>> hold(std::span<const Support> supports)
  {
    free.assign(3 * places.size(), 0);
    const double size = grid.side() * *std::max_element(grid.size().begin(), grid.size().end());
    Eigen::Matrix<double, 6, 6> held = Eigen::Matrix<double, 6, 6>::Zero();
    std::vector<Eigen::Triplet<double>> springs;
    for (std::size_t node = 0; node < places.size(); ++node)
    {
      for (const Support& support : supports)
      {
        if (!support.holds(places[node]))
        {
          continue;
        }
        const bool slides = !support.along.isZero();
        for (int axis = 0; axis < (slides ? 1 : 3); ++axis)
        {
          const Eigen::Vector3d way =
            slides ? support.along : Eigen::Vector3d(Eigen::Vector3d::Unit(axis));
          Eigen::Matrix<double, 6, 1> row;
          row << way, (places[node] - places.front()).cross(way) / size;
          held += row * row.transpose();
          slides ? void() : void(free[3 * node + at(axis)] = -1);
        }
        constexpr double stiff = 1e3; // against the cubes
        for (int i = 0; i < 9 && slides; ++i)
        {
          springs.emplace_back(static_cast<int>(3 * node) + i / 3,
            static_cast<int>(3 * node) + i % 3,
            stiff * young * grid.side() * support.along[i / 3] * support.along[i % 3]);
        }
      }
    }
    checkHeld(held);
    for (int& one : free)
    {
      one = one < 0 ? -1 : count++;
    }
    return springs;
  }

  void factorize(const std::vector<Eigen::Triplet<double>>& springs)
  {
    const CubeStiffness whole = cubeStiffness(grid.side(), young, poisson);
    std::vector<Eigen::Triplet<double>> all;
    all.reserve(cubes.size() * 300);
    const auto add = [&](int row, int column, double value)
    {
      const int i = free[at(row)];
      const int j = free[at(column)];
      i >= j&& j >= 0 ? void(all.emplace_back(i, j, value)) : void(); // the lower half
    };
    for (std::size_t cube = 0; cube < cubes.size(); ++cube)
    {
      const CubeStiffness stiffness =
        inside[cube].all() ? whole : cutCubeStiffness(grid.side(), young, poisson, inside[cube]);
      for (int i = 0; i < 24; ++i)
      {
        for (int j = 0; j < 24; ++j)
        {
          add(3 * cubes[cube][at(i / 3)] + i % 3, 3 * cubes[cube][at(j / 3)] + j % 3,
            stiffness(i, j));
        }
      }
    }
    for (const auto& spring : springs)
    {
      add(spring.row(), spring.col(), spring.value());
    }
    cholesky.cholmod().print = 0; // the error below says it
    Sparse matrix(count, count);
    matrix.setFromTriplets(all.begin(), all.end());
    cholesky.compute(matrix);
    if (cholesky.info() != Eigen::Success)
    {
      throw Error(ErrorCode::NoSolution,
        "the body's stiffness cannot be factorized; give larger cells or another support");
    }
  }
};

OrganModel::OrganModel(
  CutGrid grid, double youngModulus, double poissonRatio, std::span<const Support> supports)
  : state_(new State{ std::move(grid), youngModulus, poissonRatio })
{
  state_->addCubes();
  if (state_->places.empty())
  {
    throw Error(ErrorCode::BadValue, "no cell is filled by the body; give smaller ones");
  }
  state_->factorize(state_->hold(supports));
}

OrganModel::~OrganModel() = default;
OrganModel::OrganModel(OrganModel&&) noexcept = default;
OrganModel& OrganModel::operator=(OrganModel&&) noexcept = default;

int OrganModel::nodes() const noexcept
{
  return static_cast<int>(state_->places.size());
}

double OrganModel::side() const noexcept
{
  return state_->grid.side();
}

double OrganModel::contactModulus() const noexcept
{
  return state_->young / (1.0 - state_->poisson * state_->poisson);
}

bool OrganModel::weightsAt(
  const Eigen::Vector3d& place, const Eigen::Vector3d& outward, Weights& weights) const
{
  const State& state = *state_;
  const double side = state.grid.side();
  constexpr int kSteps = 11; // of a quarter of a side, inwards
  for (int step = 0; step < kSteps; ++step)
  {
    const Eigen::Vector3d from = place - outward * (0.25 * step + 1e-7) * side;
    const Eigen::Vector3d cell = (from - state.grid.low()) / side;
    const Cube cube{ static_cast<int>(std::floor(cell.x())), static_cast<int>(std::floor(cell.y())),
      static_cast<int>(std::floor(cell.z())) };
    if (!(state.grid.filled(cube) >= kFull) || state.number[state.cornerIndex(cube)] < 0)
    {
      continue;
    }
    const Eigen::Vector3d within =
      (place - state.grid.low()) / side - Eigen::Vector3d(cube[0], cube[1], cube[2]);
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

Eigen::MatrixXd OrganModel::solve(const Eigen::MatrixXd& forces) const
{
  const State& state = *state_;
  Eigen::MatrixXd reduced(state.count, forces.cols());
  for (std::size_t i = 0; i < state.free.size(); ++i)
  {
    if (state.free[i] >= 0)
    {
      reduced.row(state.free[i]) = forces.row(static_cast<Eigen::Index>(i));
    }
  }
  const Eigen::MatrixXd solved = state.cholesky.solve(reduced);
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(forces.rows(), forces.cols());
  for (std::size_t i = 0; i < state.free.size(); ++i)
  {
    if (state.free[i] >= 0)
    {
      result.row(static_cast<Eigen::Index>(i)) = solved.row(state.free[i]);
    }
  }
  return result;
}

} // namespace palp
