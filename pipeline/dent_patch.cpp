#include "pipeline/dent_patch.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace palp
{
namespace
{

constexpr double kEdgesOnRadius = 5.0; // [-] edges from the contact's centre to its circle
constexpr int kMaxLevel = 4;
constexpr std::size_t kMaxTriangles = 24000; // as many as a picture is quick with

Eigen::Vector3f restNormal(const PressRegion& region, std::int32_t point)
{
  const Eigen::Vector3d p = region.rest(point);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  std::int32_t before = Umbrella::kEnd;
  for (const std::int32_t next : region.umbrella().around(point))
  {
    if (before != Umbrella::kEnd && next != Umbrella::kEnd)
    {
      sum += (region.rest(before) - p).cross(region.rest(next) - p);
    }
    before = next;
  }
  return sum.normalized().cast<float>();
}

} // namespace

int DentPatch::levelFor(const Dent& dent)
{
  const PressRegion& region = dent.region();
  if (region.points().empty())
  {
    return 0;
  }
  int level = 0;
  double edge = region.edgeLength();
  std::size_t count = 2 * region.points().size();
  while (level < kMaxLevel && edge * kEdgesOnRadius > region.inner() && 4 * count <= kMaxTriangles)
  {
    ++level;
    edge *= 0.5;
    count *= 4;
  }
  return level;
}

void DentPatch::build(const Dent& dent, int level)
{
  takeCorners(dent);
  for (int i = 0; i < level; ++i)
  {
    halveEdges(dent);
  }
  displace(dent);
  turnNormals();
}

void DentPatch::takeCorners(const Dent& dent)
{
  const PressRegion& region = dent.region();
  corners_.clear();
  for (std::size_t i = 0; i < region.points().size(); ++i)
  {
    const std::int32_t point = region.points()[i];
    corners_.push_back({ region.rest(point), restNormal(region, point), region.places()[i] });
  }
  triangles = region.triangles();
}

void DentPatch::halveEdges(const Dent& dent)
{
  coarse_.swap(triangles);
  triangles.clear();
  middles_.clear();
  for (const auto& [a, b, c] : coarse_)
  {
    const int ab = middleOf(a, b, dent);
    const int bc = middleOf(b, c, dent);
    const int ca = middleOf(c, a, dent);
    triangles.insert(
      triangles.end(), { { a, ab, ca }, { ab, b, bc }, { ca, bc, c }, { ab, bc, ca } });
  }
}

int DentPatch::middleOf(int a, int b, const Dent& dent)
{
  const auto [low, high] = std::minmax(a, b);
  const std::uint64_t key =
    static_cast<std::uint64_t>(low) << 32U | static_cast<std::uint64_t>(high);
  const auto [entry, isNew] = middles_.try_emplace(key, static_cast<int>(corners_.size()));
  if (isNew)
  {
    const Corner& first = corners_[static_cast<std::size_t>(a)];
    const Corner& second = corners_[static_cast<std::size_t>(b)];
    const Eigen::Vector3d rest = 0.5 * (first.rest + second.rest);
    Place place = dent.region().placeInFront(rest);
    place.front = first.place.front && second.place.front;
    if (!place.front)
    {
      place.way = 0.5 * (first.place.way + second.place.way);
      place.distance = 0.5 * (first.place.distance + second.place.distance);
    }
    const Eigen::Vector3f normal = (first.normal + second.normal).normalized();
    corners_.push_back({ rest, normal, place });
  }
  return entry->second;
}

void DentPatch::displace(const Dent& dent)
{
  const Eigen::Vector3d normal = dent.region().normal();
  const double outer = dent.region().outer();
  points.clear();
  sink.clear();
  distance.clear();
  zone.clear();
  for (const Corner& corner : corners_)
  {
    // a neighbour of the dent stays; between two of them nothing is nearer than the circle but by
    // the height of an arc, where the ring has come to rest
    const bool rests = !corner.place.within && !(corner.place.distance < outer);
    const PressField::Sink down =
      rests ? PressField::Sink{ 0.0, Zone::Rest } : dent.sinkAt(corner.place, corner.rest);
    points.emplace_back((corner.rest - down.depth * normal).cast<float>());
    sink.push_back(static_cast<float>(down.depth));
    distance.push_back(static_cast<float>(corner.place.distance));
    zone.push_back(down.zone);
  }
}

// the change of the triangles' mean normal, on top of the smooth normal at rest
void DentPatch::turnNormals()
{
  std::vector<Eigen::Vector3f>& turned = normals;
  turned.assign(corners_.size(), Eigen::Vector3f::Zero());
  std::vector<Eigen::Vector3f> atRest(corners_.size(), Eigen::Vector3f::Zero());
  for (const Triangle& triangle : triangles)
  {
    const auto a = static_cast<std::size_t>(triangle[0]);
    const auto b = static_cast<std::size_t>(triangle[1]);
    const auto c = static_cast<std::size_t>(triangle[2]);
    const Eigen::Vector3f now = (points[b] - points[a]).cross(points[c] - points[a]);
    const Eigen::Vector3f before = (corners_[b].rest - corners_[a].rest)
                                     .cross(corners_[c].rest - corners_[a].rest)
                                     .cast<float>();
    for (const std::size_t corner : { a, b, c })
    {
      turned[corner] += now;
      atRest[corner] += before;
    }
  }
  for (std::size_t i = 0; i < turned.size(); ++i)
  {
    const Eigen::Vector3f change = turned[i].normalized() - atRest[i].normalized();
    turned[i] = (corners_[i].normal + change).normalized();
  }
}

} // namespace palp
