#include "haptics/force/series/compliance_field.h"

#include "haptics/units.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <random>
#include <span>
#include <vector>

namespace palp
{
namespace
{

using namespace units::literals;
using Eigen::Vector3d;

constexpr double kSpacing = 4.318_mm;

// x, y, z [mm], normal, constant, slope, bend, edge
using Row = std::array<double, 12>;

// Rims of a liver where a support ends, as an organ file has them: at distances from 0.6 to 16 mm
// in no one direction by cells of 6 mm, and from 0.4 to 6 mm by cells of 4 mm.
const std::vector<std::vector<Row>> kRims{
  {
    { -91.97, -14.24, -81.56, 0.152, 0.444, -0.883, 7.8, 0, 0, 0, 0, 0 },
    { -90.49, -25.92, -71.63, -0.498, -0.834, -0.239, -14.2, -76, -130, 714, 47977, 132 },
    { -95.98, -22.40, -71.14, -0.593, -0.766, -0.249, -14.3, -56, -114, 609, 43992, 119 },
    { -99.39, -14.55, -79.07, -0.639, -0.473, -0.606, -6.4, 0, 0, 0, 0, 0 },
    { -92.61, -20.63, -80.38, -0.523, -0.682, -0.512, 68.7, -6313, -12203, 62349, 51043, 1667 },
    { -90.16, -24.78, -75.80, -0.491, -0.815, -0.307, -4.7, -417, -599, 3260, 58708, 307 },
    { -86.19, -27.35, -74.77, -0.448, -0.853, -0.267, -7.3, -432, -332, 2325, 59811, 247 },
    { -98.18, -18.65, -75.97, -0.659, -0.663, -0.356, 6.8, -267, -1595, 6121, 34472, 484 },
    { -94.51, -24.63, -67.07, -0.547, -0.809, -0.214, -19.5, -21, -56, 264, 53496, 83 },
    { -92.67, -26.82, -62.87, -0.511, -0.840, -0.184, -17.0, -17, -34, 204, 33878, 62 },
    { -98.29, -22.41, -65.05, -0.607, -0.768, -0.206, -18.2, -8, -56, 232, 42232, 79 },
    { -104.22, -14.87, -70.25, -0.758, -0.584, -0.291, -12.3, 90, -439, 950, 41974, 176 },
    { -100.11, -19.69, -68.97, -0.664, -0.708, -0.240, -14.3, 8, -184, 609, 43136, 129 },
    { -101.53, -16.20, -73.99, -0.713, -0.601, -0.360, 8.0, 525, -3873, 9277, 48880, 609 },
    { -89.06, -28.26, -65.63, -0.463, -0.864, -0.198, -18.6, -39, -34, 240, 46360, 74 },
    { -93.94, -22.15, -76.07, -0.563, -0.749, -0.350, -2.3, -274, -746, 3524, 53496, 305 },
    { -95.34, -17.02, -81.07, -0.495, -0.209, -0.843, 0.3, 0, 0, 0, 0, 0 },
  },
  {
    { -56.21, -36.31, -72.32, -0.073, -0.938, -0.339, 2.1, -224, -540, 3204, 42702, 472 },
    { -57.42, -33.83, -76.62, 0.180, -0.558, -0.810, 69.3, -15848, -15678, 97729, 66006, 2500 },
    { -58.98, -37.39, -67.81, -0.127, -0.969, -0.213, -4.9, -270, -813, 4629, 85951, 455 },
    { -51.01, -34.91, -73.84, 0.268, -0.560, -0.784, 66.5, 18150, -19012, 91920, 69546, 2500 },
    { -61.82, -35.95, -71.63, -0.158, -0.945, -0.286, -12.1, -399, -333, 2109, 85421, 287 },
    { -50.78, -37.34, -69.82, 0.022, -0.946, -0.324, 25.6, 6860, -5502, 25974, 50825, 1404 },
    { -54.24, -30.82, -75.67, 0.386, 0.276, -0.880, 9.0, 0, 0, 0, 0, 0 },
    { -61.87, -34.31, -76.00, -0.069, -0.829, -0.554, 9.0, -3472, -2503, 15386, 116095, 2500 },
    { -54.79, -38.59, -64.79, -0.095, -0.975, -0.201, -8.0, 243, -347, 1806, 57095, 284 },
    { -50.27, -30.55, -73.24, 0.541, 0.359, -0.760, -0.2, 0, 0, 0, 0, 0 },
    { -59.57, -30.21, -77.82, 0.386, 0.276, -0.880, 9.0, 0, 0, 0, 0, 0 },
    { -63.59, -36.80, -66.63, -0.197, -0.962, -0.192, -15.0, -115, -138, 890, 70444, 171 },
    { -50.22, -38.82, -65.24, -0.003, -0.962, -0.272, 3.9, 5333, -1984, 7032, 65591, 787 },
    { -65.83, -34.77, -73.17, -0.226, -0.940, -0.254, 3.7, -2057, -1318, 8822, 92653, 561 },
  }
};

std::vector<PlacedCompliance> placesOf(const std::vector<Row>& rows)
{
  std::vector<PlacedCompliance> places;
  for (const Row& row : rows)
  {
    const auto vector = [&](std::size_t i) { return Vector3d(row[i], row[i + 1], row[i + 2]); };
    places.push_back({ .position = 1.0_mm * vector(0),
      .normal = vector(3).normalized(),
      .constant = row[6],
      .slope = vector(7),
      .bend = row[10],
      .edge = row[11] });
  }
  return places;
}

// use(field, center, normal) at places between those that face alike
template <typename Use>
void betweenPlaces(const std::vector<PlacedCompliance>& places, Use use)
{
  const ComplianceField field(places, kSpacing, 0.45);
  for (const PlacedCompliance& one : places)
  {
    for (const PlacedCompliance& other : places)
    {
      const bool isNear = (one.position - other.position).norm() < 2.0 * kSpacing;
      for (double part = 0.0; isNear && one.normal.dot(other.normal) > 0.8 && part < 1.0;
           part += 0.1)
      {
        use(field, Vector3d(one.position + part * (other.position - one.position)),
          Vector3d(one.normal + part * (other.normal - one.normal)).normalized());
      }
    }
  }
}

class ComplianceFieldAtARim : public testing::TestWithParam<std::vector<Row>>
{
};

// toward the rim it is softer, but nowhere stiffer: not where the pressure moves away from it,
// either, to where there would be no edge
TEST_P(ComplianceFieldAtARim, IsNotStifferThanItsPlaces)
{
  const std::vector<PlacedCompliance> places = placesOf(GetParam());
  double stiffest = 0.0;
  for (const PlacedCompliance& place : places)
  {
    const double byEdge = place.edge > 0.0 ? 2.0 * place.slope.norm() / place.edge : 0.0;
    stiffest = std::min(stiffest, place.constant - byEdge);
  }
  betweenPlaces(places,
    [&](const ComplianceField& field, const Vector3d& center, const Vector3d& normal)
    {
      const BodyCompliance body = field.at(center, normal).body;
      for (double aside = 0.0; aside < 6.0_mm; aside += 0.5_mm)
      {
        EXPECT_GT(body.constant - 2.0 * body.slope * aside / (1.0 + body.edge * aside),
          stiffest - 15.0) // [1/m]
          << center.transpose() << ' ' << aside;
      }
    });
}

// four places at once are told as each by itself
TEST_P(ComplianceFieldAtARim, TellsFourAsOneByOne)
{
  betweenPlaces(placesOf(GetParam()),
    [&](const ComplianceField& field, const Vector3d& center, const Vector3d& normal)
    {
      std::array<ComplianceField::Spot, 4> spots;
      for (std::size_t k = 0; k < spots.size(); ++k)
      {
        const double aside = 10.0_um * static_cast<double>(k);
        const Vector3d turned = (normal + Vector3d::Constant(0.1 * aside / kSpacing)).normalized();
        spots[k] = { center + aside * normal.unitOrthogonal(), turned, 6.0_mm + aside };
      }
      const std::array<ComplianceField::Local, 4> four = field.atFour(spots);
      for (std::size_t k = 0; k < spots.size(); ++k)
      {
        const auto [at, normalAt, height] = spots[k];
        const auto [body, doubtful] = field.at(at, normalAt, height);
        const auto expectSame = [](double here, double there)
        { EXPECT_NEAR(here, there, 1e-4 * std::abs(there) + 1e-2); };
        expectSame(four[k].body.constant, body.constant);
        expectSame(four[k].body.slope, body.slope);
        expectSame(four[k].body.bend, body.bend);
        expectSame(four[k].body.edge, body.edge);
        expectSame(four[k].doubtful, doubtful);
      }
    });
}

// Of a quarter space the constant is W/D, wherever along its edge and however its places lie: those
// next to the edge, too, which tell of a hundred times more.
TEST(ComplianceField, AlongAStraightEdgeIsTheSame)
{
  constexpr double kWedge = 0.345; // of a right angle, Poisson's ratio 0.45
  constexpr double kRest = -22.0;  // [1/m], of a base below
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> depth(0.1_mm, 20.0_mm);
  std::uniform_real_distribution<double> along(-40.0_mm, 40.0_mm);
  std::vector<PlacedCompliance> places;
  for (int i = 0; i < 20000; ++i)
  {
    const Vector3d position(depth(engine), along(engine), 0.0);
    const auto isNear = [&](const PlacedCompliance& other)
    { return (other.position - position).norm() < kSpacing; };
    if (std::ranges::none_of(places, isNear))
    {
      const double nearness = 1.0 / position.x();
      places.push_back({ .position = position,
        .constant = kRest + kWedge * nearness,
        .slope = Vector3d(-0.5 * kWedge * nearness * nearness, 0.0, 0.0),
        .bend = 8e4,
        .edge = nearness });
    }
  }
  const ComplianceField field(places, kSpacing, 0.45);
  for (const double distance : { 1.0_mm, 2.0_mm, 4.0_mm, 6.0_mm, 9.0_mm })
  {
    double least = 1e9;
    double most = 0.0;
    for (double y = -25.0_mm; y <= 25.0_mm; y += 0.5_mm)
    {
      const auto told = field.at({ distance, y, 0.0 }, Vector3d::UnitZ()).body;
      least = std::min(least, told.constant - kRest);
      most = std::max(most, told.constant - kRest);
    }
    EXPECT_LT(most, 1.03 * least) << distance;
    // a contact is as wide as it is far from an edge that is nearer than a spacing
    EXPECT_LT(most, 1.03 * kWedge / distance) << distance;
    EXPECT_GT(least, (distance > kSpacing ? 0.97 : 0.3) * kWedge / distance) << distance;
  }
}

// Where a floor meets a wall, a ball that touches both is between what the two tell, and comes from
// one to the other as gradually as its normal turns: there is no foot on one of them to go to.
TEST(ComplianceField, ChangesGraduallyFromFloorToWall)
{
  constexpr double kFloor = -27.0; // [1/m]
  constexpr double kWall = 35.0;
  const Vector3d wall = -Vector3d::UnitX();
  std::vector<PlacedCompliance> places;
  for (double y = -24.0_mm; y <= 24.0_mm; y += kSpacing)
  {
    for (double off = 0.5 * kSpacing; off < 24.0_mm; off += kSpacing)
    {
      places.push_back(
        { { -off, y, 0.0 }, Vector3d::UnitZ(), kFloor, { -150.0, 0.0, 0.0 }, 8e4, 35.0 });
      places.push_back({ { 0.0, y, off }, wall, kWall, { 0.0, 0.0, 4000.0 }, 8e4, 35.0 });
    }
  }
  const ComplianceField field(places, kSpacing, 0.45);
  for (const double height : { 6.0_mm, 7.5_mm, 9.0_mm, 15.0_mm })
  {
    const Vector3d ball(-height, 0.0, height);
    double before = kFloor;
    for (double turn = 0.0; turn <= 0.5 * std::numbers::pi; turn += 0.01)
    {
      const Vector3d normal = std::sin(turn) * wall + std::cos(turn) * Vector3d::UnitZ();
      const double told = field.at(ball - height * normal, normal, height).body.constant;
      EXPECT_NEAR(told, before, 0.04 * (kWall - kFloor)) << height << ' ' << turn;
      before = told;
    }
    EXPECT_NEAR(before, kWall, 0.1 * (kWall - kFloor)) << height;
  }
}

// one of four may be within reach of a place and the next not
TEST(ComplianceField, EndsWithoutALeapToNoNumber)
{
  const PlacedCompliance place{ .position = Vector3d::Zero(), .constant = 100.0 };
  const ComplianceField field(std::span(&place, 1), kSpacing, 0.45);
  for (double x = 2.0 * kSpacing; x < 2.5 * kSpacing; x += 1.0_um)
  {
    std::array<ComplianceField::Spot, 4> spots;
    for (std::size_t k = 0; k < spots.size(); ++k)
    {
      spots[k] = { { x + 10.0_um * static_cast<double>(k), 0.0, 0.0 }, Vector3d::UnitZ(), 5.0_mm };
    }
    const std::array<ComplianceField::Local, 4> four = field.atFour(spots);
    for (const ComplianceField::Local& one : four)
    {
      ASSERT_NEAR(one.body.constant, four[0].body.constant, 1e-3) << x;
      ASSERT_EQ(one.body.constant == 0.0, one.doubtful == 1.0) << x;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Cells, ComplianceFieldAtARim, testing::ValuesIn(kRims),
  [](const auto& rim) { return rim.index == 0 ? "Of6Mm" : "Of4Mm"; });

} // namespace
} // namespace palp
