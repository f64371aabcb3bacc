#include "calibration/baselines/tet_mesh.h"

#include "haptics/error.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <string>

namespace palp::fem
{
namespace
{

constexpr double kSliver = 1e-3; // volume to that of the regular tetrahedron with such edges [-]

void require(bool good, ErrorCode code, const std::string& message)
{
  if (!good)
  {
    throw Error(code, message);
  }
}

// ratio of neighboring layers so that `count` of them, the first of thickness `top`, fill height
double layerGrowth(double height, double top, int count)
{
  double low = 1e-3;
  double high = 1e3;
  for (int k = 0; k < 100; ++k)
  {
    const double growth = std::sqrt(low * high);
    double sum = 0.0;
    for (int i = 0; i < count; ++i)
    {
      sum += top * std::pow(growth, i);
    }
    (sum < height ? low : high) = growth;
  }
  return std::sqrt(low * high);
}

// heights of the layers, from the base upwards to 0
std::vector<double> layerHeights(double height, double spacing, int layers)
{
  const int count = layers - 1;
  const double top = std::min(spacing, height / count);
  const double growth = layerGrowth(height, top, count);
  std::vector<double> heights(static_cast<std::size_t>(layers), 0.0);
  double thickness = top;
  for (std::size_t k = heights.size() - 1; k > 0; --k)
  {
    heights[k - 1] = heights[k] - thickness;
    thickness *= growth;
  }
  heights.front() = -height;
  return heights;
}

double squaredEdge(const Eigen::Matrix3Xd& x, const std::array<int, 4>& tet)
{
  double sum = 0.0;
  for (std::size_t a = 0; a < 4; ++a)
  {
    for (std::size_t b = a + 1; b < 4; ++b)
    {
      sum += (x.col(tet[a]) - x.col(tet[b])).squaredNorm();
    }
  }
  return sum / 6.0;
}

// numbers of the nodes of a block
struct Nodes
{
  int n; // along each side
  int layers;

  int operator()(int i, int j, int k) const
  {
    return (k * n + j) * n + i;
  }
};

void placeNodes(TetMesh& mesh, const Nodes& node, double width, double height)
{
  const double spacing = width / (node.n - 1);
  const std::vector<double> heights = layerHeights(height, spacing, node.layers);
  for (int k = 0; k < node.layers; ++k)
  {
    for (int j = 0; j < node.n; ++j)
    {
      for (int i = 0; i < node.n; ++i)
      {
        mesh.positions.col(node(i, j, k)) << i * spacing - 0.5 * width, j * spacing - 0.5 * width,
          heights[static_cast<std::size_t>(k)];
      }
    }
  }
}

// one tetrahedron for each way along three edges from one corner of a cell to the opposite one;
// in odd cells the way is mirrored
void addTets(TetMesh& mesh, const Nodes& node, const std::array<int, 3>& cell)
{
  const auto corner = [&](std::array<int, 3> at)
  {
    for (std::size_t d = 0; d < 3; ++d)
    {
      at[d] = cell[d] + (cell[d] % 2 == 0 ? at[d] : 1 - at[d]);
    }
    return node(at[0], at[1], at[2]);
  };
  std::array<std::size_t, 3> axes{ 0, 1, 2 };
  do
  {
    std::array<int, 3> at{ 0, 0, 0 };
    std::array<int, 4> tet{ corner(at) };
    for (std::size_t s = 0; s < 3; ++s)
    {
      at[axes[s]] = 1;
      tet[s + 1] = corner(at);
    }
    mesh.tets.push_back(tet);
  } while (std::next_permutation(axes.begin(), axes.end()));
}

// the top of a cell, cut along the diagonal that its tetrahedra have there
void addTriangles(TetMesh& mesh, const Nodes& node, int i, int j)
{
  const int from = i % 2 == j % 2 ? 0 : 1;
  const int z = node.layers - 1;
  const int a = node(i + from, j, z);
  const int b = node(i + 1, j + from, z);
  const int c = node(i + 1 - from, j + 1, z);
  const int d = node(i, j + 1 - from, z);
  mesh.triangles.push_back({ a, b, c });
  mesh.triangles.push_back({ a, c, d });
}

} // namespace

Eigen::Matrix3d edgesOf(const Eigen::Matrix3Xd& positions, const std::array<int, 4>& tet)
{
  Eigen::Matrix3d edges;
  edges.col(0) = positions.col(tet[1]) - positions.col(tet[0]);
  edges.col(1) = positions.col(tet[2]) - positions.col(tet[0]);
  edges.col(2) = positions.col(tet[3]) - positions.col(tet[0]);
  return edges;
}

double volume(const Eigen::Matrix3Xd& positions, const std::array<int, 4>& tet)
{
  return std::abs(edgesOf(positions, tet).determinant()) / 6.0;
}

int invertedElements(const TetMesh& mesh, const Eigen::Matrix3Xd& positions)
{
  return static_cast<int>(std::count_if(mesh.tets.begin(), mesh.tets.end(),
    [&](const std::array<int, 4>& tet)
    {
      return edgesOf(positions, tet).determinant() * edgesOf(mesh.positions, tet).determinant() <=
        0.0;
    }));
}

TetMesh blockTets(double width, double height, int n, int layers)
{
  require(std::isfinite(width) && width > 0.0 && std::isfinite(height) && height > 0.0,
    ErrorCode::BadValue, "block: width and height must be positive lengths");
  require(n >= 2 && layers >= 2 && n <= 1000 && layers <= 1000, ErrorCode::BadValue,
    "block: give 2 to 1000 nodes along each side and along the height");

  const Nodes nodes{ n, layers };
  TetMesh mesh;
  mesh.positions.resize(3, static_cast<Eigen::Index>(n) * n * layers);
  placeNodes(mesh, nodes, width, height);
  for (int i = 0; i < n * n; ++i)
  {
    mesh.bonded.push_back(i);
    mesh.surface.push_back(nodes(0, 0, layers - 1) + i);
  }
  for (int k = 0; k + 1 < layers; ++k)
  {
    for (int j = 0; j + 1 < n; ++j)
    {
      for (int i = 0; i + 1 < n; ++i)
      {
        addTets(mesh, nodes, { i, j, k });
        if (k + 2 == layers)
        {
          addTriangles(mesh, nodes, i, j);
        }
      }
    }
  }
  return mesh;
}

void check(const TetMesh& mesh)
{
  const auto nodes = static_cast<int>(mesh.positions.cols());
  const auto known = [nodes](int i) { return i >= 0 && i < nodes; };
  const auto ask = [](bool good, const std::string& what)
  { require(good, ErrorCode::BadMesh, "soft body: " + what); };

  ask(!mesh.tets.empty(), "no tetrahedron; give a volume mesh, not a surface");
  ask(!mesh.surface.empty(), "no surface node; name the nodes that the tool may touch");
  ask(!mesh.bonded.empty(), "no bonded node; name the nodes that hold it, or it flies away");
  ask(mesh.positions.allFinite(), "a coordinate is not a finite number; repair the mesh");
  ask(std::all_of(mesh.surface.begin(), mesh.surface.end(), known) &&
      std::all_of(mesh.bonded.begin(), mesh.bonded.end(), known),
    "a surface or bonded node is not one of the mesh; number them from 0");

  std::vector<char> used(static_cast<std::size_t>(nodes), 0);
  for (std::size_t e = 0; e < mesh.tets.size(); ++e)
  {
    const std::array<int, 4>& tet = mesh.tets[e];
    const std::string which = "tetrahedron " + std::to_string(e);
    ask(std::all_of(tet.begin(), tet.end(), known),
      which + " has a node that is not one of the mesh; number them from 0");
    for (const int i : tet)
    {
      used[static_cast<std::size_t>(i)] = 1;
    }
    const double edge = std::sqrt(squaredEdge(mesh.positions, tet));
    const double regular = edge * edge * edge / (6.0 * std::sqrt(2.0));
    ask(volume(mesh.positions, tet) > kSliver * regular,
      which + " is a sliver or empty; improve the mesh there");
  }
  ask(std::all_of(used.begin(), used.end(), [](char u) { return u != 0; }),
    "a node belongs to no tetrahedron; remove it");
}

} // namespace palp::fem
