#include "pipeline/deform/dent_patch.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

namespace palp
{
namespace
{

constexpr double kEdgesOnRadius = 5.0; // [-] edges from the contact's center to its circle
constexpr int kMaxLevel = 6;
constexpr int kFurther = 7;               // beside a rim, of edges as long as the tool is wide
constexpr double kNear = 0.65;            // [-] of the tolerance
constexpr double kMaxTriangles = 24000.0; // as many as a picture is quick with

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
  // equilateral triangles in and around the dent
  const auto countFor = [&](double length)
  {
    const double width = region.outer() / length + 1.0;
    return 4.0 * std::numbers::pi / std::numbers::sqrt3 * width * width;
  };
  while (level < kMaxLevel && edge * kEdgesOnRadius > region.inner() &&
    countFor(0.5 * edge) <= kMaxTriangles)
  {
    ++level;
    edge *= 0.5;
  }
  return level;
}

void DentPatch::build(const Dent& dent, int level, double tolerance)
{
  takeCorners(dent);
  for (int i = 0; i < level; ++i)
  {
    halveEdges(dent, 0.0);
  }
  displace(dent);
  for (int i = 0; i < kFurther && tolerance > 0.0; ++i)
  {
    halveEdges(dent, tolerance);
    displace(dent);
  }
  turnNormals();
}

void DentPatch::takeCorners(const Dent& dent)
{
  const PressRegion& region = dent.region();
  corners_.clear();
  for (std::size_t i = 0; i < region.points().size(); ++i)
  {
    const std::int32_t point = region.points()[i];
    const Eigen::Vector3f normal = region.areaAround(point).normalized().cast<float>();
    corners_.push_back({ region.rest(point), normal, region.geodesics()[i], {} });
  }
  triangles.clear();
  region.forEachTriangle([&](const Triangle& triangle) { triangles.push_back(triangle); });
}

// all edges of a triangle or none, so that it keeps its shape, and those of its neighbors with them
void DentPatch::halveEdges(const Dent& dent, double tolerance)
{
  coarse_.swap(triangles);
  triangles.clear();
  middles_.assign(
    std::bit_ceil(4 * coarse_.size() + 1), Middle{}); // there are fewer edges than that
  for (const Triangle& corners : coarse_)
  {
    for (std::size_t k = 0; k < 3 && (tolerance == 0.0 || isFar(corners, dent, tolerance)); ++k)
    {
      addMiddle(corners[k], corners[(k + 1) % 3], dent);
    }
  }
  for (const Triangle& corners : coarse_)
  {
    std::array<int, 3> middle{}; // of the edge after each corner
    for (std::size_t k = 0; k < 3; ++k)
    {
      middle[k] = middleOf(corners[k], corners[(k + 1) % 3]).corner;
    }
    const auto whole = std::find(middle.begin(), middle.end(), kWhole) - middle.begin();
    if (whole == 3)
    {
      const auto& [a, b, c] = corners;
      const auto& [ab, bc, ca] = middle;
      triangles.insert(
        triangles.end(), { { a, ab, ca }, { ab, b, bc }, { ca, bc, c }, { ab, bc, ca } });
      continue;
    }
    // from the first whole edge on
    const auto first = static_cast<std::size_t>(whole);
    const int a = corners[first];
    const int b = corners[(first + 1) % 3];
    const int c = corners[(first + 2) % 3];
    const int bc = middle[(first + 1) % 3];
    const int ca = middle[(first + 2) % 3];
    if (bc == kWhole && ca == kWhole)
    {
      triangles.push_back(corners);
    }
    else if (bc == kWhole || ca == kWhole)
    {
      const bool atB = ca == kWhole;
      triangles.insert(triangles.end(),
        { atB ? Triangle{ a, b, bc } : Triangle{ a, b, ca },
          atB ? Triangle{ a, bc, c } : Triangle{ b, c, ca } });
    }
    else
    {
      triangles.insert(triangles.end(), { { a, b, bc }, { a, bc, ca }, { ca, bc, c } });
    }
  }
}

// an edge at rest stays whole: the surface beside the patch has it whole
void DentPatch::addMiddle(int a, int b, const Dent& dent)
{
  Middle& middle = middleOf(a, b);
  if (middle.corner == kWhole && !restsBetween(a, b, dent))
  {
    const Corner& first = corners_[static_cast<std::size_t>(a)];
    const Corner& second = corners_[static_cast<std::size_t>(b)];
    const Eigen::Vector3d rest = 0.5 * (first.rest + second.rest);
    const Eigen::Vector3f normal = (first.normal + second.normal).normalized();
    middle = { std::min(a, b), std::max(a, b), static_cast<int>(corners_.size()) };
    corners_.push_back({ rest, normal, geodesicBetween(a, b, 0.5, rest, dent),
      { static_cast<std::size_t>(a), static_cast<std::size_t>(b) } });
  }
}

GeodesicCoordinates DentPatch::geodesicBetween(
  int a, int b, double fraction, const Eigen::Vector3d& rest, const Dent& dent) const noexcept
{
  GeodesicCoordinates geodesic =
    dent.region().geodesicBetween(geodesicOf(a), geodesicOf(b), fraction, rest);
  geodesic.within = dent.isInsideTool(rest);
  return geodesic;
}

// whether an edge between two displaced corners spans the contact, or comes near to being farther
// from the displaced surface, at one of its quarters: within a triangle that a rim crosses it is
// half as far again
bool DentPatch::isFar(const Triangle& corners, const Dent& dent, double tolerance) const noexcept
{
  for (std::size_t k = 0; k < 3; ++k)
  {
    const auto a = static_cast<std::size_t>(corners[k]);
    const auto b = static_cast<std::size_t>(corners[(k + 1) % 3]);
    if (dent.region().spansContact(corners_[a].geodesic, corners_[b].geodesic))
    {
      return true;
    }
    for (const double part : { 0.25, 0.5, 0.75 })
    {
      const Eigen::Vector3d rest = corners_[a].rest + part * (corners_[b].rest - corners_[a].rest);
      const auto geodesic = geodesicBetween(corners[k], corners[(k + 1) % 3], part, rest, dent);
      const double straight = sink[a] + part * (sink[b] - sink[a]);
      if (std::abs(dent.sinkAt(geodesic, rest).depth - straight) > kNear * tolerance)
      {
        return true;
      }
    }
  }
  return false;
}

// where that of an edge is, or is to be put
DentPatch::Middle& DentPatch::middleOf(int a, int b)
{
  constexpr std::size_t kScatter = 0x9E3779B97F4A7C15U; // 2^64 over the golden ratio
  const auto [low, high] = std::minmax(a, b);
  const std::size_t mask = middles_.size() - 1;
  const std::size_t key = static_cast<std::size_t>(low) << 32U | static_cast<std::size_t>(high);
  std::size_t at = (key * kScatter) >> 40U & mask;
  while (middles_[at].corner != kWhole && (middles_[at].low != low || middles_[at].high != high))
  {
    at = (at + 1) & mask;
  }
  return middles_[at];
}

bool DentPatch::rests(int corner, const Dent& dent) const noexcept
{
  const GeodesicCoordinates& geodesic = geodesicOf(corner);
  return !geodesic.within && !(geodesic.distance < dent.region().outer()) && !geodesic.isBetween();
}

bool DentPatch::restsBetween(int a, int b, const Dent& dent) const noexcept
{
  return rests(a, dent) && rests(b, dent) && !dent.region().crosses(geodesicOf(a), geodesicOf(b));
}

void DentPatch::displace(const Dent& dent)
{
  points.clear();
  displacement.clear();
  sink.clear();
  distance.clear();
  zone.clear();
  for (std::size_t i = 0; i < corners_.size(); ++i)
  {
    const Corner& corner = corners_[i];
    const PressField::Sink down = rests(static_cast<int>(i), dent)
      ? PressField::Sink{ 0.0, Zone::Rest }
      : dent.sinkAt(corner.geodesic, corner.rest);
    const Eigen::Vector3d moved = down.zone == Zone::Rest
      ? Eigen::Vector3d::Zero().eval()
      : dent.displacement(corner.geodesic, down.depth);
    displacement.push_back(moved.cast<float>());
    points.emplace_back((corner.rest + moved).cast<float>());
    sink.push_back(static_cast<float>(down.depth));
    distance.push_back(static_cast<float>(corner.geodesic.distance));
    zone.push_back(down.zone);
  }
}

// the change of the triangles' mean normal, on top of the smooth normal at rest
void DentPatch::turnNormals()
{
  std::vector<Eigen::Vector3f>& turned = normals;
  turned.assign(corners_.size(), Eigen::Vector3f::Zero());
  normalsAtRest_.assign(corners_.size(), Eigen::Vector3f::Zero());
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
      normalsAtRest_[corner] += before;
    }
  }
  for (std::size_t i = 0; i < turned.size(); ++i)
  {
    const Eigen::Vector3f change = turned[i].normalized() - normalsAtRest_[i].normalized();
    turned[i] = (corners_[i].normal + change).normalized();
  }
}

} // namespace palp
