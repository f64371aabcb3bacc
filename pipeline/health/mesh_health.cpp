#include "pipeline/health/mesh_health.h"

#include "haptics/surface/area_and_volume.h"
#include "haptics/surface/crossing.h"
#include "haptics/surface/edges.h"
#include "haptics/threads/followed_work.h"
#include "pipeline/health/open_sides.h"
#include "pipeline/health/slivers.h"
#include "pipeline/model/coincident_points.h"
#include "pipeline/model/merged_mesh.h"
#include "pipeline/surface_io/surface_facing.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace palp
{
namespace
{

// what is looked at: merged, each triangle once, oriented as far as that goes
struct Subject
{
  std::vector<Eigen::Vector3d> points;
  std::vector<Triangle> triangles{};
  std::vector<int> from{}; // of each: which triangle of the file
  Facing facing{};
  Edges edges{};
};

class Findings
{
public:
  explicit Findings(std::vector<Finding>& all)
    : all_(all)
  {
  }

  // one more; the first gives the place
  void add(Fault fault, const Eigen::Vector3d& place, std::initializer_list<int> triangles = {})
  {
    if (all_.empty() || all_.back().fault != fault)
    {
      all_.push_back({ .fault = fault, .place = place });
    }
    ++all_.back().count;
    all_.back().triangles.insert(all_.back().triangles.end(), triangles);
  }

private:
  std::vector<Finding>& all_;
};

Eigen::Vector3d middleOf(std::span<const Eigen::Vector3d> points, const Triangle& t)
{
  return (points[at(t[0])] + points[at(t[1])] + points[at(t[2])]) / 3.0;
}

// of each point: how many corners of triangles it is
std::vector<int> usesOf(
  std::span<const Eigen::Vector3d> points, std::span<const Triangle> triangles)
{
  std::vector<int> uses(points.size());
  for (const Triangle& t : triangles)
  {
    for (const int corner : t)
    {
      ++uses[at(corner)];
    }
  }
  return uses;
}

void findLoosePoints(std::span<const Eigen::Vector3d> points, const std::vector<int>& uses,
  bool shared, Findings& findings)
{
  if (shared)
  {
    const std::vector<int> first = firstOfEach(points);
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      first[i] == static_cast<int>(i) ? void() : findings.add(Fault::DuplicatePoint, points[i]);
    }
  }
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    uses[i] > 0 ? void() : findings.add(Fault::UnusedPoint, points[i]);
  }
}

void findThin(const MergedMesh& mesh, std::span<const Eigen::Vector3d> points,
  std::span<const Triangle> triangles, Findings& findings)
{
  std::vector<bool> kept(triangles.size());
  for (const int i : mesh.from)
  {
    kept[at(i)] = true;
  }
  for (int i = 0; at(i) < triangles.size(); ++i)
  {
    if (const Triangle& t = triangles[at(i)]; !kept[at(i)] || unitNormal(points, t).isZero())
    {
      findings.add(Fault::Degenerate, middleOf(points, t), { i });
    }
  }
  const std::vector<bool> repeated = repeatedTriangles(mesh.triangles);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
  {
    if (repeated[i])
    {
      findings.add(
        Fault::DuplicateTriangle, middleOf(mesh.points, mesh.triangles[i]), { mesh.from[i] });
    }
  }
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
  {
    const Triangle& t = mesh.triangles[i];
    const auto& [a, b, c] = t;
    if (flatness(mesh.points[at(a)], mesh.points[at(b)], mesh.points[at(c)]) < kSliver &&
      !unitNormal(mesh.points, t).isZero())
    {
      findings.add(Fault::Sliver, middleOf(mesh.points, t), { mesh.from[i] });
    }
  }
}

Subject subjectOf(const MergedMesh& mesh)
{
  Subject subject{ .points = mesh.points };
  const std::vector<bool> repeated = repeatedTriangles(mesh.triangles);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
  {
    if (!repeated[i])
    {
      subject.triangles.push_back(mesh.triangles[i]);
      subject.from.push_back(mesh.from[i]);
    }
  }
  subject.facing =
    facingOf(subject.points, subject.triangles, edgesOf(subject.points.size(), subject.triangles));
  for (std::size_t i = 0; i < subject.triangles.size(); ++i)
  {
    Triangle& t = subject.triangles[i];
    subject.facing.turn[i] ? std::swap(t[0], t[2]) : void();
  }
  subject.edges = edgesOf(subject.points.size(), subject.triangles);
  return subject;
}

void findTurned(const Subject& subject, Findings& findings)
{
  for (std::size_t i = 0; i < subject.triangles.size(); ++i)
  {
    if (subject.facing.turn[i])
    {
      findings.add(
        Fault::Flipped, middleOf(subject.points, subject.triangles[i]), { subject.from[i] });
    }
  }
}

void findNonManifold(const Subject& subject, Findings& findings, std::vector<Finding>& all)
{
  std::set<int> onEdges;
  for (const std::vector<Side>& sides : unpairedSides(subject.triangles, subject.edges))
  {
    const auto [triangle, k] = sides.front();
    const int a = subject.triangles[at(triangle)][at(k)];
    const int b = subject.triangles[at(triangle)][(at(k) + 1) % 3];
    if (sides.size() < 2)
    {
      continue;
    }
    onEdges.insert({ a, b });
    findings.add(Fault::NonManifoldEdge, 0.5 * (subject.points[at(a)] + subject.points[at(b)]));
    for (const Side& side : sides)
    {
      all.back().triangles.push_back(subject.from[at(side.triangle)]);
    }
  }
  const auto fans = fansOf(subject.triangles, subject.edges);
  std::vector<std::set<int>> ofPoint(subject.points.size());
  for (std::size_t i = 0; i < subject.triangles.size(); ++i)
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      ofPoint[at(subject.triangles[i][k])].insert(fans[i][k]);
    }
  }
  for (std::size_t i = 0; i < subject.points.size(); ++i)
  {
    if (ofPoint[i].size() > 1 && !onEdges.contains(static_cast<int>(i)))
    {
      findings.add(Fault::NonManifoldPoint, subject.points[i]);
      for (const int corner : ofPoint[i])
      {
        all.back().triangles.push_back(subject.from[at(corner / 3)]);
      }
    }
  }
}

void findHoles(const Subject& subject, Findings& findings, std::vector<Finding>& all)
{
  for (const std::vector<Side>& border : borders(subject.points, subject.triangles, subject.edges))
  {
    double length = 0.0;
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const auto& [triangle, k] : border)
    {
      const Triangle& t = subject.triangles[at(triangle)];
      const Eigen::Vector3d& a = subject.points[at(t[at(k)])];
      length += (subject.points[at(t[(at(k) + 1) % 3])] - a).norm();
      middle += a / static_cast<double>(border.size());
    }
    findings.add(Fault::Hole, middle);
    Finding& holes = all.back();
    if (length > holes.size)
    {
      holes.size = length;
      holes.place = middle;
    }
    for (const Side& side : border)
    {
      holes.triangles.push_back(subject.from[at(side.triangle)]);
    }
  }
}

// where it passes through itself, or its pieces overlap from wall to wall
void findInside(const Subject& subject, Findings& findings)
{
  const BoxTree tree(subject.points, subject.triangles);
  std::vector<int> triangles = crossingTriangles(tree, subject.triangles);
  if (triangles.empty() && subject.edges.unbalanced == 0 && subject.facing.inner == 0)
  {
    triangles = buriedTriangles(tree, piecesOf(subject.edges.across));
  }
  for (const int triangle : triangles)
  {
    findings.add(Fault::SelfIntersection, middleOf(subject.points, subject.triangles[at(triangle)]),
      { subject.from[at(triangle)] });
  }
}

void findInner(const Subject& subject, std::vector<Finding>& all)
{
  if (subject.facing.inner == 0)
  {
    return;
  }
  Finding inner{ .fault = Fault::InnerPiece, .count = subject.facing.inner };
  for (std::size_t i = 0; i < subject.triangles.size(); ++i)
  {
    subject.facing.within[i] ? inner.triangles.push_back(subject.from[i]) : void();
  }
  const auto first = std::ranges::find(subject.facing.within, true) - subject.facing.within.begin();
  inner.place = middleOf(subject.points, subject.triangles[static_cast<std::size_t>(first)]);
  all.push_back(std::move(inner));
}

std::vector<MeshPiece> measuredPieces(const Subject& subject)
{
  const std::vector<int> pieceOf = piecesOf(subject.edges.across);
  std::vector<MeshPiece> pieces;
  std::vector<Eigen::Vector3d> from;
  for (std::size_t i = 0; i < subject.triangles.size(); ++i)
  {
    const Triangle& t = subject.triangles[i];
    const std::size_t k = at(pieceOf[i]);
    if (k == pieces.size())
    {
      pieces.emplace_back();
      from.push_back(subject.points[at(t[0])]);
    }
    ++pieces[k].triangles;
    pieces[k].volume +=
      (subject.points[at(t[0])] - from[k])
        .dot((subject.points[at(t[1])] - from[k]).cross(subject.points[at(t[2])] - from[k])) /
      6.0;
    pieces[k].closed &= std::ranges::count(subject.edges.across[i], -1) == 0;
  }
  std::ranges::sort(pieces, std::greater(), &MeshPiece::triangles);
  return pieces;
}

} // namespace

std::string_view nameOf(Fault fault) noexcept
{
  constexpr std::array<std::string_view, 11> names{ "duplicate point", "unused point",
    "degenerate triangle", "duplicate triangle", "sliver", "flipped triangle", "non-manifold edge",
    "non-manifold point", "hole", "self-intersecting triangle", "inner piece" };
  return names[static_cast<std::size_t>(fault)];
}

const Finding* MeshHealth::find(Fault fault) const noexcept
{
  const auto found = std::ranges::find(findings, fault, &Finding::fault);
  return found == findings.end() ? nullptr : &*found;
}

MeshHealth healthOf(std::span<const Eigen::Vector3d> points, std::span<const Triangle> triangles)
{
  const MergedMesh mesh = mergedMesh(points, triangles);
  const std::vector<int> uses = usesOf(points, triangles);
  // a file like STL, where each triangle has corners of its own, cannot say which are the same
  const bool shared = std::ranges::any_of(uses, [](int n) { return n != 1; });
  MeshHealth health{ .points = shared ? points.size() : mesh.points.size(),
    .triangles = triangles.size() };
  Findings findings(health.findings);
  findLoosePoints(points, uses, shared, findings);
  tellDone(0.3); // of the time, about; as below
  findThin(mesh, points, triangles, findings);
  const Subject subject = subjectOf(mesh);
  findTurned(subject, findings);
  findNonManifold(subject, findings, health.findings);
  findHoles(subject, findings, health.findings);
  tellDone(0.6);
  findInside(subject, findings);
  findInner(subject, health.findings);
  tellDone(0.9);
  health.pieces = measuredPieces(subject);
  for (const auto& [a, b] : subject.edges.all)
  {
    health.edgeLengths.push_back((subject.points[at(a)] - subject.points[at(b)]).norm());
  }
  std::ranges::sort(health.edgeLengths);
  if (!subject.points.empty())
  {
    health.low = health.high = subject.points.front();
  }
  for (const Eigen::Vector3d& point : subject.points)
  {
    health.low = health.low.cwiseMin(point);
    health.high = health.high.cwiseMax(point);
  }
  return health;
}

} // namespace palp
