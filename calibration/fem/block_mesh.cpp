#include "calibration/fem/mesh.h"

#include "haptics/numerics/roots.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <numbers>

namespace palp::fem
{
namespace
{

using Eigen::Matrix3d;
using Gradient = Eigen::Matrix<double, 9, Eigen::Dynamic>;

// the corner a of a brick, as offsets 0 or 1
std::array<int, 3> offset(int a)
{
  return { a & 1, (a >> 1) & 1, (a >> 2) & 1 };
}

// gradient operator at a point of a brick with the given edges, local coordinates in [0, 1]
Gradient brickGradient(const std::array<double, 3>& edges, const std::array<double, 3>& at)
{
  Gradient gradient = Gradient::Zero(9, 24);
  for (int a = 0; a < 8; ++a)
  {
    const auto corner = offset(a);
    for (std::size_t d = 0; d < 3; ++d)
    {
      double slope = (corner[d] == 1 ? 1.0 : -1.0) / edges[d];
      for (std::size_t e = 0; e < 3; ++e)
      {
        if (e != d)
        {
          slope *= corner[e] == 1 ? at[e] : 1.0 - at[e];
        }
      }
      for (int i = 0; i < 3; ++i)
      {
        gradient(i + 3 * static_cast<int>(d), 3 * a + i) = slope;
      }
    }
  }
  return gradient;
}

// boundaries of steps that grow by one ratio from 0 to length, the first
// of them `head * first` long
std::vector<double> growingSteps(double length, std::size_t count, double first, double head)
{
  const auto steps = [&](double ratio)
  {
    std::vector<double> boundaries{ 0.0, head * first };
    for (double step = ratio * first; boundaries.size() <= count; step *= ratio)
    {
      boundaries.push_back(boundaries.back() + step);
    }
    return boundaries;
  };
  const auto isShort = [&](double ratio) { return steps(ratio).back() < length; };
  return steps(bisect(isShort, { 0.1, 10.0 }, 60).low);
}

// half of a row of n nodes, from the middle outwards; where n is even,
// node -1 is the image of node 0
struct HalfRow
{
  int firstElement;
  std::vector<double> positions;

  HalfRow(double width, int n, double fine)
    : firstElement(n % 2 == 0 ? -1 : 0)
    , positions(
        growingSteps(0.5 * width, static_cast<std::size_t>(n / 2), fine, n % 2 == 0 ? 0.5 : 1.0))
  {
    if (firstElement < 0)
    {
      positions.erase(positions.begin());
    }
  }
  [[nodiscard]] int count() const
  {
    return static_cast<int>(positions.size());
  }
  [[nodiscard]] double position(int k) const
  {
    return k < 0 ? -positions.front() : positions[static_cast<std::size_t>(k)];
  }
  [[nodiscard]] double edge(int k) const
  {
    return position(k + 1) - position(k);
  }
};

// the nodes of a quarter: layers of rows, from the base up
struct Grid
{
  HalfRow row;
  std::vector<double> heights; // of the layers [m]

  [[nodiscard]] int layers() const
  {
    return static_cast<int>(heights.size());
  }
  [[nodiscard]] double height(int k) const
  {
    return heights[static_cast<std::size_t>(k)];
  }
  [[nodiscard]] int node(int i, int j, int k) const
  {
    return (k * row.count() + j) * row.count() + i;
  }
};

// one node, held at the base and on the middle planes
void addNode(Body& body, const Grid& grid, int i, int j, int k)
{
  const int number = grid.node(i, j, k);
  body.positions.col(number) << grid.row.position(i), grid.row.position(j), grid.height(k);
  const bool held = k == 0;
  if (held)
  {
    body.base.push_back(number);
    body.heldDofs.push_back(3 * number + 2);
  }
  if (held || grid.row.position(i) == 0.0)
  {
    body.heldDofs.push_back(3 * number);
  }
  if (held || grid.row.position(j) == 0.0)
  {
    body.heldDofs.push_back(3 * number + 1);
  }
  if (k == grid.layers() - 1)
  {
    body.surface.push_back(number);
    if (j == 0)
    {
      body.profile.push_back(number);
    }
  }
}

// one element; where i or j is -1 it lies across a middle plane and its far nodes are images
Element brick(const Grid& grid, int i, int j, int k)
{
  Element element{ .meanDilatation = true };
  std::vector<int> nodes;
  Eigen::MatrixXd image = Eigen::MatrixXd::Zero(24, 24); // corners from the element's nodes
  for (int a = 0; a < 8; ++a)
  {
    const auto corner = offset(a);
    const int x = i + corner[0];
    const int y = j + corner[1];
    const int number = grid.node(std::max(x, 0), std::max(y, 0), k + corner[2]);
    const auto known = std::find(nodes.begin(), nodes.end(), number);
    const auto column = 3 * (known - nodes.begin());
    if (known == nodes.end())
    {
      nodes.push_back(number);
      element.dofs.insert(element.dofs.end(), { 3 * number, 3 * number + 1, 3 * number + 2 });
    }
    image.block<3, 3>(static_cast<Eigen::Index>(3) * a, column).diagonal() << (x < 0 ? -1.0 : 1.0),
      (y < 0 ? -1.0 : 1.0), 1.0;
  }
  image.conservativeResize(Eigen::NoChange, 3 * static_cast<Eigen::Index>(nodes.size()));

  const double gauss = 0.5 / std::numbers::sqrt3;
  const std::array edges{ grid.row.edge(i), grid.row.edge(j), grid.height(k + 1) - grid.height(k) };
  const double volume = edges[0] * edges[1] * edges[2];
  const double images = (i < 0 ? 1.0 : 2.0) * (j < 0 ? 1.0 : 2.0);
  for (int p = 0; p < 8; ++p)
  {
    const auto corner = offset(p);
    std::array<double, 3> at;
    for (std::size_t d = 0; d < 3; ++d)
    {
      at[d] = 0.5 + (corner[d] == 1 ? gauss : -gauss);
    }
    element.points.push_back(
      { .weight = images * volume / 8.0, .gradient = brickGradient(edges, at) * image });
  }
  return element;
}

} // namespace

Body blockBody(double width, double height, int n, int layers, double fine)
{
  Grid grid{ .row = HalfRow(width, n, fine),
    .heights = growingSteps(height, static_cast<std::size_t>(layers - 1), fine, 1.0) };
  std::ranges::reverse(grid.heights);
  for (double& h : grid.heights)
  {
    h = height - h; // counted from the base, and not from the top, where the first is fine
  }

  const int count = grid.row.count();
  Body body{ .dimension = 3, .top = height, .elementSize = fine };
  body.positions.resize(3, static_cast<Eigen::Index>(count) * count * layers);
  for (int k = 0; k < layers; ++k)
  {
    for (int j = 0; j < count; ++j)
    {
      for (int i = 0; i < count; ++i)
      {
        addNode(body, grid, i, j, k);
      }
    }
  }
  for (int k = 0; k + 1 < layers; ++k)
  {
    for (int j = grid.row.firstElement; j + 1 < count; ++j)
    {
      for (int i = grid.row.firstElement; i + 1 < count; ++i)
      {
        body.elements.push_back(brick(grid, i, j, k));
      }
    }
  }
  return body;
}

} // namespace palp::fem
