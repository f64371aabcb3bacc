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

constexpr double kCrease = 0.8; // [rad] between triangles that are no part of one smooth surface

} // namespace

std::array<Eigen::Matrix3d, 3> bendsOf(
  const LinkedTriangles& mesh, const Facet& facet, int triangle)
{
  std::array<Eigen::Matrix3d, 3> result;
  for (std::size_t k = 0; k < 3; ++k)
  {
    result[k].setZero();
    const int other = mesh.across[static_cast<std::size_t>(triangle)][k];
    if (other < 0)
    {
      continue;
    }
    const Eigen::Vector3d beyond =
      unitNormal(mesh.points, mesh.triangles[static_cast<std::size_t>(other)]);
    const Eigen::Vector3d along = (facet.corners[(k + 1) % 3] - facet.corners[k]).normalized();
    const Eigen::Vector3d across = along.cross(facet.normal + beyond).normalized();
    const double turn = std::atan2(facet.normal.cross(beyond).dot(along), facet.normal.dot(beyond));
    result[k] = 0.5 * turn * across * across.transpose();
  }
  return result;
}

std::vector<FacetBend> evenBends(const BoxTree& tree, const LinkedTriangles& mesh, double longest)
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
    const std::array<double, 3> sides{ (p[1] - p[0]).norm(), (p[2] - p[1]).norm(),
      (p[0] - p[2]).norm() };
    const auto turns = bendsOf(mesh, facets[i], tree.triangle(static_cast<int>(i)));
    bool creased = false;
    for (std::size_t k = 0; k < 3; ++k)
    {
      const double turn = turns[k].trace();
      result[i].turns[k] = static_cast<float>(turn);
      creased = creased || std::abs(turn) > 0.5 * kCrease;
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
