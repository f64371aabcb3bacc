#include "pipeline/health/split_mesh.h"

#include "haptics/surface/crossing.h"
#include "haptics/surface/edges.h"
#include "pipeline/health/open_sides.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <random>
#include <set>

namespace palp
{
namespace
{

// a triangle at an edge that goes from a to b
struct Leaf
{
  Side side;
  double angle; // about the edge [rad]
  bool along;   // goes from a to b: the body lies where the angle is smaller
};

std::vector<Leaf> leavesAt(std::span<const Eigen::Vector3d> points,
  std::span<const Triangle> triangles, const std::vector<Side>& sides)
{
  const auto point = [&](const Side& side, std::size_t k)
  { return triangles[at(side.triangle)][(at(side.k) + k) % 3]; };
  const int a = point(sides.front(), 0);
  const Eigen::Vector3d axis = (points[at(point(sides.front(), 1))] - points[at(a)]).normalized();
  const Eigen::Vector3d x = axis.unitOrthogonal();
  const Eigen::Vector3d y = axis.cross(x);
  std::vector<Leaf> leaves;
  for (const Side& side : sides)
  {
    const Eigen::Vector3d to = points[at(point(side, 2))] - points[at(a)];
    leaves.push_back({ side, std::atan2(to.dot(y), to.dot(x)), point(side, 0) == a });
  }
  std::ranges::sort(leaves, {}, &Leaf::angle);
  return leaves;
}

// joins what bounds the same wedge of the body
void joinWedges(std::span<const Eigen::Vector3d> points, std::span<const Triangle> triangles,
  const std::vector<Side>& sides, Edges& edges)
{
  const std::vector<Leaf> leaves = leavesAt(points, triangles, sides);
  for (std::size_t i = 0; i < leaves.size(); ++i)
  {
    const Leaf& low = leaves[i];
    const Leaf& high = leaves[(i + 1) % leaves.size()];
    if (!low.along && high.along)
    {
      edges.across[at(low.side.triangle)][at(low.side.k)] = high.side.triangle;
      edges.across[at(high.side.triangle)][at(high.side.k)] = low.side.triangle;
    }
  }
}

// Without fins: what stands on a surface by one side and ends openly elsewhere, where the rest is
// whole without it. pieceOf: of each triangle; isOpen: of each piece
std::vector<Side> withoutFins(
  std::vector<Side> sides, const std::vector<int>& pieceOf, const std::vector<bool>& isOpen)
{
  const auto isFin = [&](const Side& side)
  {
    const int piece = pieceOf[at(side.triangle)];
    const auto isOfIt = [&](const Side& other) { return pieceOf[at(other.triangle)] == piece; };
    return isOpen[at(piece)] && std::ranges::count_if(sides, isOfIt) == 1;
  };
  std::vector<Side> paired;
  std::ranges::remove_copy_if(sides, std::back_inserter(paired), isFin);
  return !paired.empty() && paired.size() % 2 == 0 ? paired : sides;
}

// cuts a triangle off all others
void isolate(int triangle, Edges& edges)
{
  for (int& other : edges.across[at(triangle)])
  {
    if (other >= 0)
    {
      std::ranges::replace(edges.across[at(other)], triangle, -1);
      other = -1;
    }
  }
}

// A surface on the way to be parted.
struct Parting
{
  std::vector<Eigen::Vector3d>& points;
  std::vector<Triangle>& triangles;
  std::vector<int> origin; // of each point: which one it was
};

// gives each fan a point of its own, where the one that they had is
void partFans(Parting& parting, const Edges& edges)
{
  const auto fans = fansOf(parting.triangles, edges);
  std::vector<int> first(parting.points.size(), -1);
  std::map<int, int> pointOf; // of other fans than the first
  for (std::size_t i = 0; i < parting.triangles.size(); ++i)
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      int& corner = parting.triangles[i][k];
      int& keeps = first[at(corner)];
      keeps = keeps < 0 ? fans[i][k] : keeps;
      if (fans[i][k] != keeps)
      {
        const auto next = static_cast<int>(parting.points.size());
        const auto [added, isNew] = pointOf.try_emplace(fans[i][k], next);
        if (isNew)
        {
          const Eigen::Vector3d place = parting.points[at(corner)];
          parting.points.push_back(place);
          parting.origin.push_back(parting.origin[at(corner)]);
        }
        corner = added->second;
      }
    }
  }
}

// moves points that were one apart, into their own triangles, but those of the most triangles
class Apart
{
public:
  explicit Apart(Parting& parting)
    : parting_(parting)
    , places_(parting.points)
    , ways_(parting.points.size(), Eigen::Vector3d::Zero())
    , sharing_(parting.points.size())
    , largest_(parting.origin)
    , stays_(parting.points.size())
  {
    for (const int origin : parting.origin)
    {
      ++sharing_[at(origin)];
    }
    std::vector<int> triangles(ways_.size());
    for (const auto& [a, b, c] : parting.triangles)
    {
      const Eigen::Vector3d middle = (places_[at(a)] + places_[at(b)] + places_[at(c)]) / 3.0;
      for (const int corner : { a, b, c })
      {
        ways_[at(corner)] += middle - places_[at(corner)];
        ++triangles[at(corner)];
      }
    }
    for (std::size_t i = 0; i < ways_.size(); ++i)
    {
      int& largest = largest_[at(parting.origin[i])];
      largest = triangles[i] > triangles[at(largest)] ? static_cast<int>(i) : largest;
    }
    for (std::size_t i = 0; i < ways_.size(); ++i)
    {
      ways_[i] *= kApart / std::max(triangles[i], 1);
      moves(i) ? put(i, 1.0, 0.05) : void(); // not as even as the surface: edges may meet edges
    }
  }

  // the points of triangles that pass through others since
  [[nodiscard]] std::set<int> crossing(const std::vector<bool>& crossed) const
  {
    std::set<int> origins;
    const BoxTree tree(parting_.points, parting_.triangles);
    for (const auto& [one, other] : crossingPairs(tree, parting_.triangles))
    {
      for (const int triangle : { one, other })
      {
        for (const int corner : parting_.triangles[at(triangle)])
        {
          !(crossed[at(one)] && crossed[at(other)]) && isParted(at(corner))
            ? void(origins.insert(parting_.origin[at(corner)]))
            : void();
        }
      }
    }
    return origins;
  }

  // elsewhere, but as near, and now more aside, now more along: one may not find room
  void move(const std::set<int>& origins)
  {
    for (std::size_t i = 0; i < places_.size(); ++i)
    {
      origins.contains(parting_.origin[i]) && moves(i)
        ? put(i, std::abs(any_(random_)), 0.5 * std::abs(any_(random_)))
        : void();
    }
  }

  // where they were
  void leave(const std::set<int>& origins)
  {
    for (std::size_t i = 0; i < places_.size(); ++i)
    {
      if (origins.contains(parting_.origin[i]))
      {
        parting_.points[i] = places_[i];
        stays_[at(parting_.origin[i])] = true;
      }
    }
  }

  [[nodiscard]] SplitPoints count() const
  {
    SplitPoints result;
    for (std::size_t i = 0; i < places_.size(); ++i)
    {
      const bool isAdded = parting_.origin[i] != static_cast<int>(i);
      result.added += isAdded && isParted(i) ? 1U : 0U;
      result.left += stays_[i] ? 1U : 0U;
    }
    return result;
  }

private:
  static constexpr double kApart = 1e-3; // of the way to the triangles' middles

  // so much of its way, and so much of that anywhere; in single precision, as files have it
  void put(std::size_t point, double along, double aside)
  {
    const Eigen::Vector3d anywhere(any_(random_), any_(random_), any_(random_));
    const Eigen::Vector3d off = along * ways_[point] + aside * ways_[point].norm() * anywhere;
    parting_.points[point] = (places_[point] + off).cast<float>().cast<double>();
  }

  [[nodiscard]] bool isParted(std::size_t point) const
  {
    const int origin = parting_.origin[point];
    return sharing_[at(origin)] > 1 && !stays_[at(origin)];
  }

  [[nodiscard]] bool moves(std::size_t point) const
  {
    return isParted(point) && at(largest_[at(parting_.origin[point])]) != point;
  }

  Parting& parting_;
  std::vector<Eigen::Vector3d> places_;
  std::vector<Eigen::Vector3d> ways_;
  std::vector<int> sharing_; // of each that was
  std::vector<int> largest_; // of these: the one that stays
  std::vector<bool> stays_;  // likewise
  std::mt19937 random_;
  std::uniform_real_distribution<double> any_{ -1.0, 1.0 };
};

} // namespace

SplitPoints splitNonManifold(std::vector<Eigen::Vector3d>& points, std::vector<Triangle>& triangles)
{
  constexpr int kTries = 30;
  const std::vector<Triangle> before = triangles;
  const std::size_t given = points.size();
  Parting parting{ points, triangles, std::vector<int>(given) };
  std::iota(parting.origin.begin(), parting.origin.end(), 0);
  Edges edges = edgesOf(given, triangles);
  const std::vector<std::vector<Side>> unpaired = unpairedSides(triangles, edges);
  const std::vector<int> pieceOf = piecesOf(edges.across);
  std::vector<bool> isOpen(triangles.size()); // of each piece, which are no more
  for (const std::vector<Side>& sides : unpaired)
  {
    sides.size() == 1 ? void(isOpen[at(pieceOf[at(sides.front().triangle)])] = true) : void();
  }
  for (const std::vector<Side>& sides : unpaired)
  {
    if (sides.size() > 1)
    {
      joinWedges(points, triangles, withoutFins(sides, pieceOf, isOpen), edges);
    }
  }
  partFans(parting, edges);
  // what hangs together around both ends of such an edge can only be torn
  edges = edgesOf(points.size(), triangles);
  for (const std::vector<Side>& sides : unpairedSides(triangles, edges))
  {
    for (std::size_t i = 1; i < sides.size(); ++i)
    {
      isolate(sides[i].triangle, edges);
    }
  }
  edges.crowded > 0 ? partFans(parting, edges) : void();
  if (points.size() == given)
  {
    return {};
  }
  std::vector<bool> crossed(triangles.size());
  for (const int triangle :
    crossingTriangles(BoxTree(std::span(points).first(given), before), before))
  {
    crossed[at(triangle)] = true;
  }
  Apart apart(parting);
  int tries = 0;
  for (std::set<int> bad = apart.crossing(crossed); !bad.empty(); bad = apart.crossing(crossed))
  {
    ++tries <= kTries ? apart.move(bad) : apart.leave(bad);
  }
  return apart.count();
}

} // namespace palp
