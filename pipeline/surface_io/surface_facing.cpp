#include "pipeline/surface_io/surface_facing.h"

#include "haptics/surface/tree/box_tree.h"
#include "haptics/surface/winding.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace palp
{
namespace
{

// triangles that hang together
struct Piece
{
  std::vector<int> triangles;
  double volume = 0.0; // six times that, as the file has it [m^3]
};

// whether a triangle goes along an edge from one point to another
bool goes(const Triangle& t, int from, int to)
{
  return (t[0] == from && t[1] == to) || (t[1] == from && t[2] == to) ||
    (t[2] == from && t[0] == to);
}

// six times the volume below triangles, seen from a point
double volumeSeen(
  std::span<const Eigen::Vector3d> points, const Triangle& t, const Eigen::Vector3d& from)
{
  return (points[at(t[0])] - from).dot((points[at(t[1])] - from).cross(points[at(t[2])] - from));
}

// each with its triangles turned as the first of it
std::vector<Piece> piecesOf(std::span<const Eigen::Vector3d> points,
  std::span<const Triangle> triangles, const Edges& edges, Facing& facing)
{
  std::vector<Piece> pieces;
  std::vector<bool> met(triangles.size());
  for (std::size_t start = 0; start < triangles.size(); ++start)
  {
    if (met[start])
    {
      continue;
    }
    met[start] = true;
    Piece piece{ { static_cast<int>(start) } };
    const Eigen::Vector3d& from = points[at(triangles[start][0])];
    for (std::size_t next = 0; next < piece.triangles.size(); ++next)
    {
      const std::size_t self = at(piece.triangles[next]);
      const Triangle& t = triangles[self];
      piece.volume += (facing.turn[self] ? -1.0 : 1.0) * volumeSeen(points, t, from);
      for (std::size_t k = 0; k < 3; ++k)
      {
        const int other = edges.across[self][k];
        if (other < 0)
        {
          continue;
        }
        const bool turned = facing.turn[self] != goes(triangles[at(other)], t[k], t[(k + 1) % 3]);
        facing.twisted = facing.twisted || (met[at(other)] && facing.turn[at(other)] != turned);
        if (!met[at(other)])
        {
          met[at(other)] = true;
          facing.turn[at(other)] = turned;
          piece.triangles.push_back(other);
        }
      }
    }
    pieces.push_back(std::move(piece));
  }
  return pieces;
}

void turnAll(const Piece& piece, std::vector<bool>& turn)
{
  for (const int triangle : piece.triangles)
  {
    turn[at(triangle)] = !turn[at(triangle)];
  }
}

// among how many others a point of a piece lies, less the hollows
int depthOf(const Winding& winding, const Eigen::Vector3d& point)
{
  return static_cast<int>(std::floor(winding(point))); // its own part is between 0 and 1
}

std::vector<Triangle> turned(std::span<const Triangle> triangles, const std::vector<bool>& turn)
{
  std::vector<Triangle> result(triangles.begin(), triangles.end());
  for (std::size_t i = 0; i < result.size(); ++i)
  {
    turn[i] ? std::swap(result[i][0], result[i][2]) : void();
  }
  return result;
}

bool isOutward(const Piece& piece, const std::vector<bool>& turn)
{
  return (piece.volume < 0.0) == turn[at(piece.triangles.front())];
}

// turns those back that face a hollow
void openCavities(std::span<const Eigen::Vector3d> points, std::span<const Triangle> triangles,
  std::span<const Piece> pieces, Facing& facing)
{
  const Winding winding(BoxTree(points, turned(triangles, facing.turn)));
  const auto size = [](const Piece& piece) { return std::abs(piece.volume); };
  const bool isOutermostTurned = std::ranges::max(pieces, {}, size).volume < 0.0;
  for (const Piece& piece : pieces)
  {
    const Eigen::Vector3d& on = points[at(triangles[at(piece.triangles.front())][0])];
    if ((piece.volume < 0.0) != isOutermostTurned && depthOf(winding, on) % 2 == 1)
    {
      turnAll(piece, facing.turn);
      ++facing.cavities;
    }
  }
}

// finds those that lie in the body itself
void findInner(std::span<const Eigen::Vector3d> points, std::span<const Triangle> triangles,
  std::span<const Piece> pieces, Facing& facing)
{
  const auto facesOut = [&](const Piece& piece) { return isOutward(piece, facing.turn); };
  if (std::ranges::count_if(pieces, facesOut) < 2)
  {
    return; // hollows alone, as of most organs; the rest takes as long as all else here
  }
  const Winding winding(BoxTree(points, turned(triangles, facing.turn)));
  for (const Piece& piece : pieces)
  {
    const auto isWithin = [&](int triangle)
    {
      return std::ranges::all_of(triangles[at(triangle)],
        [&](int corner) { return depthOf(winding, points[at(corner)]) > 0; });
    };
    if (isOutward(piece, facing.turn) && std::ranges::all_of(piece.triangles, isWithin))
    {
      ++facing.inner;
      for (const int triangle : piece.triangles)
      {
        facing.within[at(triangle)] = true;
      }
    }
  }
}

} // namespace

Facing facingOf(
  std::span<const Eigen::Vector3d> points, std::span<const Triangle> triangles, const Edges& edges)
{
  Facing facing{ .turn = std::vector<bool>(triangles.size()),
    .within = std::vector<bool>(triangles.size()) };
  const std::vector<Piece> pieces = piecesOf(points, triangles, edges, facing);
  if (!edges.unpaired.empty())
  {
    return facing;
  }
  for (const Piece& piece : pieces)
  {
    piece.volume < 0.0 ? turnAll(piece, facing.turn) : void();
  }
  if (pieces.size() > 1)
  {
    openCavities(points, triangles, pieces, facing);
    findInner(points, triangles, pieces, facing);
  }
  return facing;
}

} // namespace palp
