#include "haptics/force/series/compliance_field.h"

#include "haptics/units.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <gtest/gtest.h>
#include <vector>

namespace palp
{
namespace
{

using namespace units::literals;
using Eigen::Vector3d;

constexpr double kSpacing = 4.318_mm;

// of a liver by cells of 6 mm, where a support ends at a blunt rim: distances to it from 0.6 to
// 16 mm, in no one direction
const std::array kRim{ PlacedCompliance{ .position = { -91.97_mm, -14.24_mm, -81.56_mm },
                         .normal = { 0.152, 0.444, -0.883 },
                         .constant = 7.8,
                         .slope = { 0, 0, 0 },
                         .bend = 0,
                         .edge = 0 },
  PlacedCompliance{ .position = { -90.49_mm, -25.92_mm, -71.63_mm },
    .normal = { -0.498, -0.834, -0.239 },
    .constant = -14.2,
    .slope = { -76, -130, 714 },
    .bend = 47977,
    .edge = 132 },
  PlacedCompliance{ .position = { -95.98_mm, -22.40_mm, -71.14_mm },
    .normal = { -0.593, -0.766, -0.249 },
    .constant = -14.3,
    .slope = { -56, -114, 609 },
    .bend = 43992,
    .edge = 119 },
  PlacedCompliance{ .position = { -99.39_mm, -14.55_mm, -79.07_mm },
    .normal = { -0.639, -0.473, -0.606 },
    .constant = -6.4,
    .slope = { 0, 0, 0 },
    .bend = 0,
    .edge = 0 },
  PlacedCompliance{ .position = { -92.61_mm, -20.63_mm, -80.38_mm },
    .normal = { -0.523, -0.682, -0.512 },
    .constant = 68.7,
    .slope = { -6313, -12203, 62349 },
    .bend = 51043,
    .edge = 1667 },
  PlacedCompliance{ .position = { -90.16_mm, -24.78_mm, -75.80_mm },
    .normal = { -0.491, -0.815, -0.307 },
    .constant = -4.7,
    .slope = { -417, -599, 3260 },
    .bend = 58708,
    .edge = 307 },
  PlacedCompliance{ .position = { -86.19_mm, -27.35_mm, -74.77_mm },
    .normal = { -0.448, -0.853, -0.267 },
    .constant = -7.3,
    .slope = { -432, -332, 2325 },
    .bend = 59811,
    .edge = 247 },
  PlacedCompliance{ .position = { -98.18_mm, -18.65_mm, -75.97_mm },
    .normal = { -0.659, -0.663, -0.356 },
    .constant = 6.8,
    .slope = { -267, -1595, 6121 },
    .bend = 34472,
    .edge = 484 },
  PlacedCompliance{ .position = { -94.51_mm, -24.63_mm, -67.07_mm },
    .normal = { -0.547, -0.809, -0.214 },
    .constant = -19.5,
    .slope = { -21, -56, 264 },
    .bend = 53496,
    .edge = 83 },
  PlacedCompliance{ .position = { -92.67_mm, -26.82_mm, -62.87_mm },
    .normal = { -0.511, -0.840, -0.184 },
    .constant = -17.0,
    .slope = { -17, -34, 204 },
    .bend = 33878,
    .edge = 62 },
  PlacedCompliance{ .position = { -98.29_mm, -22.41_mm, -65.05_mm },
    .normal = { -0.607, -0.768, -0.206 },
    .constant = -18.2,
    .slope = { -8, -56, 232 },
    .bend = 42232,
    .edge = 79 },
  PlacedCompliance{ .position = { -104.22_mm, -14.87_mm, -70.25_mm },
    .normal = { -0.758, -0.584, -0.291 },
    .constant = -12.3,
    .slope = { 90, -439, 950 },
    .bend = 41974,
    .edge = 176 },
  PlacedCompliance{ .position = { -100.11_mm, -19.69_mm, -68.97_mm },
    .normal = { -0.664, -0.708, -0.240 },
    .constant = -14.3,
    .slope = { 8, -184, 609 },
    .bend = 43136,
    .edge = 129 },
  PlacedCompliance{ .position = { -101.53_mm, -16.20_mm, -73.99_mm },
    .normal = { -0.713, -0.601, -0.360 },
    .constant = 8.0,
    .slope = { 525, -3873, 9277 },
    .bend = 48880,
    .edge = 609 },
  PlacedCompliance{ .position = { -89.06_mm, -28.26_mm, -65.63_mm },
    .normal = { -0.463, -0.864, -0.198 },
    .constant = -18.6,
    .slope = { -39, -34, 240 },
    .bend = 46360,
    .edge = 74 },
  PlacedCompliance{ .position = { -93.94_mm, -22.15_mm, -76.07_mm },
    .normal = { -0.563, -0.749, -0.350 },
    .constant = -2.3,
    .slope = { -274, -746, 3524 },
    .bend = 53496,
    .edge = 305 },
  PlacedCompliance{ .position = { -95.34_mm, -17.02_mm, -81.07_mm },
    .normal = { -0.495, -0.209, -0.843 },
    .constant = 0.3,
    .slope = { 0, 0, 0 },
    .bend = 0,
    .edge = 0 } };

ComplianceField rim()
{
  std::vector<PlacedCompliance> places(kRim.begin(), kRim.end());
  for (PlacedCompliance& place : places)
  {
    place.normal.normalize();
  }
  return { places, kSpacing, 0.45 };
}

// use(center, normal) at places between those that face alike
template <typename Use>
void betweenPlaces(Use use)
{
  for (const PlacedCompliance& one : kRim)
  {
    for (const PlacedCompliance& other : kRim)
    {
      const bool isNear = (one.position - other.position).norm() < 2.0 * kSpacing;
      for (double part = 0.0; isNear && one.normal.dot(other.normal) > 0.8 && part < 1.0;
           part += 0.1)
      {
        use(Vector3d(one.position + part * (other.position - one.position)),
          Vector3d(one.normal + part * (other.normal - one.normal)).normalized());
      }
    }
  }
}

// toward the rim it is softer, but nowhere stiffer: not where the pressure moves away from it,
// either
TEST(ComplianceField, BetweenPlacesIsNotStifferThanThey)
{
  const double stiffest = std::ranges::min(kRim, {}, &PlacedCompliance::constant).constant;
  const ComplianceField field = rim();
  betweenPlaces(
    [&](const Vector3d& center, const Vector3d& normal)
    {
      const BodyCompliance body = field.at(center, normal).body;
      EXPECT_GT(body.constant, stiffest - 15.0) << center.transpose(); // [1/m]
      const double aside = 2.5_mm;
      EXPECT_GT(
        body.constant - 2.0 * body.slope * aside / (1.0 + body.edge * aside), stiffest - 75.0)
        << center.transpose();
    });
}

TEST(ComplianceField, TellsHowItChanges)
{
  const ComplianceField field = rim();
  betweenPlaces(
    [&](const Vector3d& center, const Vector3d& normal)
    {
      const ComplianceField::Local here = field.at(center, normal);
      for (const Vector3d& way : { normal.unitOrthogonal(), normal.cross(normal.unitOrthogonal()) })
      {
        constexpr double kStep = 20e-6; // [m]
        const BodyCompliance more = field.at(center + kStep * way, normal).body;
        const BodyCompliance less = field.at(center - kStep * way, normal).body;
        const auto expectSlope = [&](double high, double low, const Vector3d& told, double most)
        { EXPECT_NEAR((high - low) / (2.0 * kStep), told.dot(way), 0.02 * told.norm() + most); };
        expectSlope(more.constant, less.constant, here.constant, 300.0);
        expectSlope(more.bend, less.bend, here.bend, 1e-2 * here.body.bend / kSpacing);
        expectSlope(more.edge, less.edge, here.edge, 1e-2 * here.body.edge / kSpacing);
      }
    });
}

} // namespace
} // namespace palp
