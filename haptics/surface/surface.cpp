#include "haptics/surface/surface.h"

#include "haptics/error.h"
#include "haptics/surface/crossing.h"
#include "haptics/surface/edges.h"
#include "haptics/surface/facet_part.h"
#include "haptics/threads/followed_work.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <future>
#include <limits>
#include <queue>
#include <string>

namespace palp
{
namespace
{

void check(std::span<const Eigen::Vector3d> points, std::span<const Triangle> triangles)
{
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    if (!points[i].allFinite())
    {
      throw Error(ErrorCode::BadMesh,
        "surface: point " + std::to_string(i) + " is not finite; repair or export the mesh again");
    }
  }
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    for (const int point : triangles[i])
    {
      if (point < 0 || at(point) >= points.size())
      {
        throw Error(ErrorCode::BadMesh,
          "surface: triangle " + std::to_string(i) +
            " names a point that does not exist; export the mesh again");
      }
    }
  }
}

std::vector<Eigen::Vector3d> angleWeightedNormals(
  std::span<const Eigen::Vector3d> points, std::span<const Triangle> triangles)
{
  std::vector<Eigen::Vector3d> normals(points.size(), Eigen::Vector3d::Zero());
  for (const Triangle& t : triangles)
  {
    const Eigen::Vector3d normal = unitNormal(points, t);
    for (std::size_t k = 0; k < 3; ++k)
    {
      const Eigen::Vector3d u = points[at(t[(k + 1) % 3])] - points[at(t[k])];
      const Eigen::Vector3d v = points[at(t[(k + 2) % 3])] - points[at(t[k])];
      normals[at(t[k])] += std::atan2(u.cross(v).norm(), u.dot(v)) * normal;
    }
  }
  for (Eigen::Vector3d& normal : normals)
  {
    normal.normalize();
  }
  return normals;
}

double distanceToSegment(
  const Eigen::Vector3d& x, const Eigen::Vector3d& a, const Eigen::Vector3d& b) noexcept
{
  const Eigen::Vector3d along = b - a;
  const double t = std::clamp((x - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (x - a - t * along).norm();
}

} // namespace

Surface::Surface(std::vector<Eigen::Vector3d> points, std::vector<Triangle> triangles)
  : points_(std::move(points))
  , triangles_(std::move(triangles))
{
  check(points_, triangles_);
  auto tree = std::async(std::launch::async, [this] { return BoxTree(points_, triangles_); });
  normals_ = angleWeightedNormals(points_, triangles_);
  isClosed_ = linkEdges();
  tree_ = tree.get();
  tellDone(0.4); // of the time, about; as below
  if (tree_.empty())
  {
    throw Error(ErrorCode::BadMesh, "surface: no triangle with an area; choose another file");
  }
  if (!isClosed_)
  {
    spreadOpenEdges();
  }
  else
  {
    // meanwhile the shape, which holds where nothing crosses
    auto crossing = std::async(std::launch::async,
      [this]
      {
        const auto found = findCrossing(tree_, triangles_);
        return found ? found : findOverlap();
      });
    shape_ = ShapeField(tree_, { points_, triangles_, across_ }, creases_);
    crossing_ = crossing.get();
    if (crossing_)
    {
      dropWhatIsBuried();
    }
  }
  tellDone(0.7);
  firstTriangle_.assign(points_.size(), -1);
  for (int facet = static_cast<int>(tree_.facets().size()) - 1; facet >= 0; --facet)
  {
    for (const int point : triangles_[at(tree_.triangle(facet))])
    {
      firstTriangle_[at(point)] = tree_.triangle(facet);
    }
  }
  if (!isClosed_ || crossing_)
  {
    shape_ = ShapeField(tree_, { points_, triangles_, across_ }, creases_);
  }
  sums_ = FacetSums(tree_, openSides());
}

// those that have not one neighbor which goes along them the other way
std::vector<std::uint8_t> Surface::openSides() const
{
  const auto goesAlong = [this](int triangle, int from, int to)
  {
    const auto& [a, b, c] = triangles_[at(triangle)];
    return (a == from && b == to) || (b == from && c == to) || (c == from && a == to);
  };
  std::vector<std::uint8_t> open(triangles_.size(), 0);
  for (std::size_t i = 0; i < triangles_.size(); ++i)
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      const int other = across_[i][k];
      const bool isJoined =
        other >= 0 && goesAlong(other, triangles_[i][(k + 1) % 3], triangles_[i][k]);
      open[i] |= static_cast<std::uint8_t>(isJoined ? 0 : 1 << k);
    }
  }
  return open;
}

// whether they are closed
bool Surface::linkEdges()
{
  Edges edges = edgesOf(points_.size(), triangles_);
  across_ = std::move(edges.across);
  openEdges_ = std::move(edges.unpaired);
  double sum = 0.0;
  for (const auto& [a, b] : edges.all)
  {
    sum += (points_[at(a)] - points_[at(b)]).squaredNorm();
  }
  edgeLength_ = std::sqrt(sum / static_cast<double>(edges.all.size()));
  creases_ = creasesOf({ points_, triangles_, across_ });

  firstNeighbor_.assign(points_.size() + 1, 0);
  for (const auto& [a, b] : edges.all)
  {
    ++firstNeighbor_[at(a) + 1];
    ++firstNeighbor_[at(b) + 1];
  }
  for (std::size_t i = 0; i < points_.size(); ++i)
  {
    firstNeighbor_[i + 1] += firstNeighbor_[i];
  }
  neighbors_.resize(2 * edges.all.size());
  std::vector<int> next = firstNeighbor_;
  for (const auto& [a, b] : edges.all)
  {
    neighbors_[at(next[at(a)]++)] = b;
    neighbors_[at(next[at(b)]++)] = a;
  }
  return edges.unbalanced == 0;
}

// of pieces whose walls meet without passing through each other
std::optional<Eigen::Vector3d> Surface::findOverlap() const
{
  const std::vector<int> buried = buriedTriangles(tree_, piecesOf(across_));
  if (buried.empty())
  {
    return std::nullopt;
  }
  const Triangle& first = triangles_[at(buried.front())];
  return (points_[at(first[0])] + points_[at(first[1])] + points_[at(first[2])]) / 3.0;
}

// what is felt is the boundary of all that is inside
void Surface::dropWhatIsBuried()
{
  Winding winding(tree_);
  const double aside = asideOf(tree_);
  std::vector<Triangle> triangles = triangles_;
  for (int i = 0; at(i) < tree_.facets().size(); ++i)
  {
    if (isBuried(winding, tree_.facets()[at(i)], aside))
    {
      Triangle& triangle = triangles[at(tree_.triangle(i))];
      triangle.fill(triangle[0]);
    }
  }
  BoxTree boundary(points_, triangles);
  if (boundary.empty()) // it encloses nothing: the nearest triangle tells what it can
  {
    crossing_.reset();
    return;
  }
  winding_ = std::move(winding);
  triangles_ = std::move(triangles);
  tree_ = std::move(boundary);
  linkEdges(); // of what is left
}

// each point takes over the nearest open edge that one of its neighbors knows, nearest first
void Surface::spreadOpenEdges()
{
  struct Offer
  {
    double distance;
    int point;
    int edge;
    bool operator<(const Offer& other) const
    {
      return distance > other.distance;
    }
  };
  nearestOpenEdge_.assign(points_.size(), -1);
  std::priority_queue<Offer> offers;
  for (std::size_t edge = 0; edge < openEdges_.size(); ++edge)
  {
    for (const int point : openEdges_[edge])
    {
      offers.push({ 0.0, point, static_cast<int>(edge) });
    }
  }
  while (!offers.empty())
  {
    const Offer offer = offers.top();
    offers.pop();
    if (nearestOpenEdge_[at(offer.point)] >= 0)
    {
      continue;
    }
    nearestOpenEdge_[at(offer.point)] = offer.edge;
    const auto& [a, b] = openEdges_[at(offer.edge)];
    for (const int neighbor : neighbors(offer.point))
    {
      const double distance =
        distanceToSegment(points_[at(neighbor)], points_[at(a)], points_[at(b)]);
      offers.push({ distance, neighbor, offer.edge });
    }
  }
}

std::span<const int> Surface::neighbors(int point) const noexcept
{
  const int first = firstNeighbor_[at(point)];
  return { neighbors_.data() + first, at(firstNeighbor_[at(point) + 1] - first) };
}

bool Surface::onOpenEdge(int point) const noexcept
{
  if (closed() || nearestOpenEdge_[at(point)] < 0)
  {
    return false;
  }
  const auto& [a, b] = openEdges_[at(nearestOpenEdge_[at(point)])];
  return a == point || b == point;
}

double Surface::edgeDistance(const Eigen::Vector3d& position, int triangle) const noexcept
{
  double nearest = std::numeric_limits<double>::infinity();
  for (const int point : triangles_[at(triangle)])
  {
    if (!closed() && nearestOpenEdge_[at(point)] >= 0)
    {
      const auto& [a, b] = openEdges_[at(nearestOpenEdge_[at(point)])];
      nearest = std::min(nearest, distanceToSegment(position, points_[at(a)], points_[at(b)]));
    }
  }
  return nearest;
}

} // namespace palp
