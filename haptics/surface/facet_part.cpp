#include "haptics/surface/facet_part.h"

#include "haptics/surface/edges.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace palp
{
namespace
{

constexpr double kFlat = 0.01;    // [rad] to which a side of a triangle is within a flat face
constexpr double kBodyEdge = 0.8; // likewise, from which on it is an edge of the body itself
constexpr double kCrease = 0.3;   // likewise, where the faces beside it are flat
constexpr double kBeside = 0.2;   // part of its turn by which those may turn along with it

const Triangle& cornersAt(const LinkedTriangles& mesh, int triangle)
{
  return mesh.triangles[static_cast<std::size_t>(triangle)];
}

int across(const LinkedTriangles& mesh, int triangle, std::size_t side)
{
  return mesh.across[static_cast<std::size_t>(triangle)][side];
}

// How a surface turns at a side of a triangle, convex positive, and across which direction.
struct Turn
{
  double angle = 0.0; // [rad]
  Eigen::Vector3d across = Eigen::Vector3d::Zero();
};

Turn turnAt(const LinkedTriangles& mesh, int triangle, std::size_t side)
{
  const int other = across(mesh, triangle, side);
  if (other < 0)
  {
    return {};
  }
  const Triangle& corners = cornersAt(mesh, triangle);
  const auto point = [&](std::size_t k) -> const Eigen::Vector3d&
  { return mesh.points[static_cast<std::size_t>(corners[k % 3])]; };
  const Eigen::Vector3d normal = unitNormal(mesh.points, corners);
  const Eigen::Vector3d beyond = unitNormal(mesh.points, cornersAt(mesh, other));
  const Eigen::Vector3d along = (point(side + 1) - point(side)).normalized();
  return { std::atan2(normal.cross(beyond).dot(along), normal.dot(beyond)),
    along.cross(normal + beyond).normalized() };
}

// Whether no side at the corner beyond a side of a triangle turns along with it: the face is flat.
bool isFlatBeside(const LinkedTriangles& mesh, const Turn& turn, int triangle, std::size_t side)
{
  constexpr int kMost = 100; // triangles about a corner
  const int corner = cornersAt(mesh, triangle)[(side + 2) % 3];
  int current = triangle;
  for (int i = 0; i < kMost; ++i)
  {
    const auto k = static_cast<std::size_t>(
      std::ranges::find(cornersAt(mesh, current), corner) - cornersAt(mesh, current).begin());
    const Turn own = turnAt(mesh, current, k);
    const double along = own.across.dot(turn.across);
    current = across(mesh, current, k);
    if (current < 0 || std::abs(own.angle) * along * along > kBeside * std::abs(turn.angle))
    {
      return false;
    }
    if (current == triangle)
    {
      return true;
    }
  }
  return false;
}

bool isCrease(const LinkedTriangles& mesh, const Turn& turn, int triangle, std::size_t side)
{
  if (std::abs(turn.angle) < kCrease || turn.angle >= kBodyEdge)
  {
    return turn.angle >= kBodyEdge;
  }
  const int other = across(mesh, triangle, side);
  const int from =
    cornersAt(mesh, triangle)[(side + 1) % 3]; // the other one goes along it backwards
  const auto back = static_cast<std::size_t>(
    std::ranges::find(cornersAt(mesh, other), from) - cornersAt(mesh, other).begin());
  return isFlatBeside(mesh, turn, triangle, side) && isFlatBeside(mesh, turn, other, back);
}

} // namespace

Creases creasesOf(const LinkedTriangles& mesh)
{
  Creases result;
  result.sides.resize(mesh.triangles.size());
  double sum = 0.0;
  double count = 0.0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
  {
    double squares = 0.0;
    bool isRound = false;
    for (std::size_t k = 0; k < 3; ++k)
    {
      const auto [a, b] = std::pair(mesh.triangles[i][k], mesh.triangles[i][(k + 1) % 3]);
      squares +=
        (mesh.points[static_cast<std::size_t>(a)] - mesh.points[static_cast<std::size_t>(b)])
          .squaredNorm();
      const Turn turn = turnAt(mesh, static_cast<int>(i), k);
      result.sides[i][k] = isCrease(mesh, turn, static_cast<int>(i), k);
      isRound = isRound || (std::abs(turn.angle) > kFlat && !result.sides[i][k]);
    }
    sum += isRound ? squares : 0.0;
    count += isRound ? 3.0 : 0.0;
  }
  result.facetLength = count > 0.0 ? std::sqrt(sum / count) : 0.0;
  return result;
}

std::array<Eigen::Matrix3d, 3> bendsOf(const LinkedTriangles& mesh, int triangle)
{
  std::array<Eigen::Matrix3d, 3> result;
  for (std::size_t k = 0; k < 3; ++k)
  {
    const Turn turn = turnAt(mesh, triangle, k);
    result[k] = 0.5 * turn.angle * turn.across * turn.across.transpose();
  }
  return result;
}

std::vector<FacetBend> evenBends(
  const BoxTree& tree, const LinkedTriangles& mesh, const Creases& creases, double longest)
{
  const std::span<const Facet> facets = tree.facets();
  const auto areaOf = [](const Facet& facet)
  {
    const auto& [a, b, c] = facet.corners;
    return static_cast<float>(0.5 * (b - a).cross(c - a).norm());
  };
  const auto cornersOf = [&](std::size_t i) -> const Triangle&
  { return mesh.triangles[static_cast<std::size_t>(tree.triangle(static_cast<int>(i)))]; };

  std::vector<FacetBend> result(facets.size());
  std::vector<Eigen::Matrix3f> bends(mesh.points.size(), Eigen::Matrix3f::Zero());
  std::vector<float> areas(mesh.points.size(), 0.0F);
  for (std::size_t i = 0; i < facets.size(); ++i)
  {
    const auto& p = facets[i].corners;
    const int triangle = tree.triangle(static_cast<int>(i));
    const std::array<double, 3> sides{ (p[1] - p[0]).norm(), (p[2] - p[1]).norm(),
      (p[0] - p[2]).norm() };
    const auto turns = bendsOf(mesh, triangle);
    bool creased = std::ranges::count(creases.sides[at(triangle)], true) > 0;
    for (std::size_t k = 0; k < 3; ++k)
    {
      const double turn = turns[k].trace();
      result[i].turns[k] = static_cast<float>(turn);
      creased = creased || std::abs(turn) > 0.5 * kBodyEdge;
    }
    if (creased || std::ranges::max(sides) > longest)
    {
      continue;
    }
    const Eigen::Matrix3f bend =
      (sides[0] * turns[0] + sides[1] * turns[1] + sides[2] * turns[2]).cast<float>();
    result[i].even = bend;
    for (const int corner : cornersOf(i))
    {
      bends[static_cast<std::size_t>(corner)] += bend / 3.0F;
      areas[static_cast<std::size_t>(corner)] += areaOf(facets[i]);
    }
  }
  for (std::size_t i = 0; i < facets.size(); ++i)
  {
    if (std::optional<Eigen::Matrix3f>& even = result[i].even)
    {
      even->setZero();
      for (const int corner : cornersOf(i))
      {
        const auto k = static_cast<std::size_t>(corner);
        *even += areaOf(facets[i]) / areas[k] * bends[k];
      }
    }
  }
  return result;
}

std::vector<float> hollowRadii(const LinkedTriangles& mesh)
{
  struct Piece
  {
    Eigen::Vector3d from;
    double volume = 0.0; // six times that [m^3]
    double area = 0.0;   // twice that [m^2]
    bool isClosed = true;
  };
  const std::vector<int> pieceOf = piecesOf(mesh.across);
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
  {
    const auto [a, b, c] = mesh.triangles[i];
    if (at(pieceOf[i]) == pieces.size())
    {
      pieces.push_back({ mesh.points[at(a)] });
    }
    Piece& piece = pieces[at(pieceOf[i])];
    const Eigen::Vector3d u = mesh.points[at(a)] - piece.from;
    const Eigen::Vector3d v = mesh.points[at(b)] - piece.from;
    const Eigen::Vector3d w = mesh.points[at(c)] - piece.from;
    piece.volume += u.dot(v.cross(w));
    piece.area += (v - u).cross(w - u).norm();
    piece.isClosed = piece.isClosed && std::ranges::count(mesh.across[i], -1) == 0;
  }
  std::vector<float> radii(mesh.triangles.size());
  for (std::size_t i = 0; i < radii.size(); ++i)
  {
    const Piece& piece = pieces[at(pieceOf[i])];
    radii[i] = piece.isClosed && piece.volume < 0.0
      ? static_cast<float>(std::sqrt(piece.area / (8.0 * std::numbers::pi)))
      : 0.0F;
  }
  return radii;
}

} // namespace palp
