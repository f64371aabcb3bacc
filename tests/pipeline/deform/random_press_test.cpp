#include "pipeline/deform/dent.h"

#include "haptics/contact/find_contact.h"
#include "haptics/force/force_law.h"
#include "pipeline/deform/dent_patch.h"
#include "tests/pipeline/deform/press_cases.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <random>
#include <tuple>

namespace palp
{
namespace
{

using namespace test;
using namespace units::literals;

Surface hapticOf(const DentedSurface& surface)
{
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i < surface.count(); ++i)
  {
    points.push_back(DentedSurface::at(surface.rest, i));
  }
  return { points, surface.triangles };
}

#ifdef PALP_SLOW
constexpr unsigned kSeeds[]{ 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12 };
#else
constexpr unsigned kSeeds[]{ 2024 };
#endif

class RandomPress : public ::testing::TestWithParam<std::tuple<Case, unsigned>>
{
protected:
  Case with = std::get<Case>(GetParam());
  DentedSurface surface = with.make();
  Surface haptic = hapticOf(with.haptic ? bundled(with.haptic) : surface);
  std::vector<float> restNormals = surface.normals;
  std::mt19937 random{ std::get<unsigned>(GetParam()) };

  // a press at a random point: the tool tilted a little, at most 40 % of the local thickness deep
  Press next(int i)
  {
    const std::array<Tip, 4> tips{ SphereTip{ 10.0_mm }, SphereTip{ 3.0_mm },
      ConeTip{ 45.0_deg, 10.0_mm }, ConeTip{ 60.0_deg, 6.0_mm } };
    std::uniform_int_distribution<std::size_t> vertex(0, surface.count() - 1);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (;;)
    {
      const std::size_t at = vertex(random);
      const Tip& tip = tips[static_cast<std::size_t>(i) % tips.size()];
      const Eigen::Vector3d normal = DentedSurface::at(restNormals, at);
      const double wanted = (0.1 + 0.5 * unit(random)) * baseRadius(tip);
      const Eigen::AngleAxisd tilt(0.25 * unit(random), normal.unitOrthogonal());
      const ToolPose pose{ .apex = DentedSurface::at(surface.rest, at) - wanted * normal,
        .axis = -(tilt * normal) };
      const Contact contact = findContact(haptic, tip, pose, ContactRule::Exact);
      if (!contact.touching() || contact.depth > 0.4 * contact.thickness ||
        contact.depth > 0.8 * baseRadius(tip) || contact.tilt > 30.0_deg)
      {
        continue;
      }
      const ForceLaw law(tip, { .youngModulus = 50.0_kPa, .poissonRatio = 0.33 });
      const double r = law({ .depth = contact.depth }).contactRadius;
      return { .contact = contact,
        .pose = pose,
        .tip = tip,
        .contactRadius = r,
        .extentRadius = 3.7 * contact.depth };
    }
  }
};
INSTANTIATE_TEST_SUITE_P(Dent, RandomPress,
  ::testing::Combine(::testing::ValuesIn(cases()), ::testing::ValuesIn(kSeeds)),
  [](const auto& with)
  { return std::get<0>(with.param).name + '_' + std::to_string(std::get<1>(with.param)); });

TEST_P(RandomPress, LeavesNoPointInsideTheToolAndTurnsNoTriangleOver)
{
  DentPatch patch;
  int presses = 0;
  double deepest = -1.0;
  std::size_t turned = 0;
  for (int i = 0; i < 200; ++i)
  {
    const Press press = next(i);
    surface.press(press);
    const PressRegion& region = surface.dent.region();
    ASSERT_FALSE(region.points().empty()) << "press " << i;
    ++presses;
    const ToolBody body(press.tip, press.pose);
    for (std::size_t k = 0; k < region.points().size(); ++k)
    {
      const auto at = static_cast<std::size_t>(region.points()[k]);
      deepest = std::max(deepest, body.inside(DentedSurface::at(surface.points, at)));
    }
    patch.build(surface.dent, DentPatch::levelFor(surface.dent));
    const auto isFinite = [](float x) { return std::isfinite(x); };
    ASSERT_TRUE(std::all_of(surface.points.begin(), surface.points.end(), isFinite));
    ASSERT_TRUE(std::all_of(surface.normals.begin(), surface.normals.end(), isFinite));
    ASSERT_TRUE(std::all_of(patch.points.begin(), patch.points.end(),
      [](const Eigen::Vector3f& point) { return point.allFinite(); }));
    for (const Eigen::Vector3f& point : patch.points)
    {
      deepest = std::max(deepest, body.inside(point.cast<double>()));
    }
    region.forEachTriangle(
      [&](const Triangle& triangle)
      {
        const auto area = [&](const std::vector<float>& of)
        {
          const auto corner = [&](int k)
          {
            return DentedSurface::at(
              of, static_cast<std::size_t>(region.points()[static_cast<std::size_t>(k)]));
          };
          const auto& [a, b, c] = triangle;
          return Eigen::Vector3d((corner(b) - corner(a)).cross(corner(c) - corner(a)));
        };
        // what faces the tool is kept facing it, a side is kept from turning over, if it does not
        // hang from a point at rest
        const bool isSide = area(surface.rest).dot(region.normal()) <= 0.0;
        const bool hangs = !std::all_of(triangle.begin(), triangle.end(),
          [&](int k) { return region.geodesics()[static_cast<std::size_t>(k)].within; });
        const bool isTurned = isSide ? area(surface.points).dot(area(surface.rest)) <= 0.0
                                     : area(surface.points).dot(region.normal()) <= 0.0;
        turned += isTurned && !(isSide && hangs) ? 1 : 0;
      });
  }
  RecordProperty("deepest_um", std::to_string(deepest / 1.0_um));
  EXPECT_EQ(presses, 200);
  EXPECT_LE(deepest, 1.0_um);
  EXPECT_EQ(turned, 0U);
}

// the displacement field itself, on the surface that was fitted around the contact
TEST_P(RandomPress, IsSmoothAtTheContact)
{
  double kink = 0.0;
  for (int i = 0; i < 200; ++i)
  {
    const Press press = next(i);
    surface.press(press);
    const PressRegion& region = surface.dent.region();
    const PressField& field = surface.dent.field();
    for (int k = 0; k < PressField::kDirections; ++k)
    {
      const auto [p0, p1, p2] = field.controlPoints(k, region);
      const Eigen::Vector3d center = region.toSurface(Eigen::Vector3d::Zero());
      const Eigen::Vector3d across = p2 - center;
      const Eigen::Vector3d outwards =
        (across - across.dot(region.normal()) * region.normal()).normalized();
      const double inner =
        (p0 - center - (p0 - center).dot(region.normal()) * region.normal()).norm();
      const auto sinkAt = [&](double radius)
      {
        const Eigen::Vector3d foot = region.geodesicInFront(center + radius * outwards).local;
        const Eigen::Vector3d point =
          region.toSurface({ foot.x(), foot.y(), field.surface().height(foot.x(), foot.y()) });
        const GeodesicCoordinates position = region.geodesicInFront(point);
        return position.distance < region.outer() ? surface.dent.sinkAt(position, point).depth
                                                  : 0.0;
      };
      const auto turnWithin = [&](double h)
      {
        const double inside = (sinkAt(inner - h) - sinkAt(inner - 2.0 * h)) / h;
        const double outside = (sinkAt(inner + 2.0 * h) - sinkAt(inner + h)) / h;
        return std::abs(std::atan(inside) - std::atan(outside));
      };
      // the ring turns sharply where P1 is close to P0, and less within less; a kink stays
      kink = std::max(kink, std::min(turnWithin(3e-5 * inner), turnWithin(1e-5 * inner)));
    }
  }
  RecordProperty("kink_deg", std::to_string(units::toDegrees(kink)));
  EXPECT_LE(kink, 2.0_deg);
}

struct Step
{
  double size; ///< of the displacement [m]
  double at;   ///< fraction of the edge where it begins
  double width;
};

// the largest of a function of the fraction of an edge, over a nanometer of its length
template <typename Function>
Step largestStep(const Function& sinkAt, double length)
{
  constexpr int kParts = 8;
  Step step{ .size = 0.0, .at = 0.0, .width = 1.0 };
  while (step.width * length > 1e-9)
  {
    step.size = -1.0;
    step.width /= kParts;
    const double from = step.at;
    for (int k = 0; k < kParts; ++k)
    {
      const double fraction = from + k * step.width;
      if (const double change = std::abs(sinkAt(fraction + step.width) - sinkAt(fraction));
          change > step.size)
      {
        step.size = change;
        step.at = fraction;
      }
    }
  }
  return step;
}

// where a tool is sunk beyond its base its shaft cuts a wall; where it leans over what lies beside
// it, its own flank does, from where that is met from above to where it is from below
bool isWall(const ToolBody& body, const Eigen::Vector3d& a, const Eigen::Vector3d& b)
{
  const auto isOn = [&](const Eigen::Vector3d& point)
  { return std::abs(body.inside(point)) < 1.0_um; };
  const auto isOnShaft = [&](const Eigen::Vector3d& point)
  { return std::abs(body.fromAxis(point) - body.base()) < 1.0_um; };
  return isOnShaft(a) || isOnShaft(b) || (isOn(a) && isOn(b) && body.inside(0.5 * (a + b)) > 0.0);
}

struct AlongEdge
{
  double step;   ///< the largest over a nanometer
  bool isRim;    ///< that at R_d
  double inside; ///< of the tool, the deepest at its ends and between
};

AlongEdge lookAlong(
  const Dent& dent, const Press& press, const GeodesicCoordinates& a, const GeodesicCoordinates& b)
{
  const PressRegion& region = dent.region();
  const ToolBody body(press.tip, press.pose);
  const Eigen::Vector3d start = region.toSurface(a.local);
  const Eigen::Vector3d edge = region.toSurface(b.local) - start;
  const auto geodesicAt = [&](double fraction)
  { return region.geodesicBetween(a, b, fraction, start + fraction * edge); };
  const auto sinkAt = [&](double fraction)
  { return dent.sinkAt(geodesicAt(fraction), start + fraction * edge).depth; };
  const auto sunkAt = [&](double fraction)
  { return Eigen::Vector3d(start + fraction * edge - sinkAt(fraction) * region.normal()); };
  const auto [size, low, width] = largestStep(sinkAt, edge.norm());
  const bool isRim = geodesicAt(low).distance > 0.99 * region.outer();
  AlongEdge along{ .step = size, .isRim = isRim, .inside = -1.0 };
  for (const double fraction : { low, low + width, 0.0, 0.3, 0.6, 1.0 })
  {
    along.inside = std::max(along.inside, body.inside(sunkAt(fraction)));
  }
  if (isWall(body, sunkAt(low), sunkAt(low + width)))
  {
    along.step = 0.0;
  }
  return along;
}

// the displacement along every edge of the pressed mesh, sides and ridges included
TEST_P(RandomPress, IsContinuousAlongEveryEdge)
{
  double step = 0.0;
  double stepAtRd = 0.0;
  double inside = -1.0;
  for (int i = 0; i < 200; ++i)
  {
    const Press press = next(i);
    surface.press(press);
    const PressRegion& region = surface.dent.region();
    const auto geodesicOf = [&](int corner)
    { return region.geodesics()[static_cast<std::size_t>(corner)]; };
    region.forEachTriangle(
      [&](const Triangle& triangle)
      {
        for (std::size_t k = 0; k < 3; ++k)
        {
          const AlongEdge found = lookAlong(
            surface.dent, press, geodesicOf(triangle[k]), geodesicOf(triangle[(k + 1) % 3]));
          step = std::max(step, found.step);
          stepAtRd = std::max(stepAtRd, found.isRim ? found.step : 0.0);
          inside = std::max(inside, found.inside);
        }
      });
  }
  RecordProperty("step_um", std::to_string(step / 1.0_um));
  RecordProperty("inside_um", std::to_string(inside / 1.0_um));
  RecordProperty("step_at_rd_um", std::to_string(stepAtRd / 1.0_um));
  EXPECT_LE(inside, 1.0_um);
  EXPECT_LE(stepAtRd, 1.0_um);
  // between two of the ring's directions it begins where both do, and the tool is near there only
  EXPECT_LE(step, 8.0_um);
}

} // namespace
} // namespace palp
