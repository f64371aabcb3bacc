#include "calibration/organ/cubes/cube_stiffness.h"
#include "calibration/organ/cubes/cut_grid.h"
#include "calibration/organ/organ_compliance.h"
#include "calibration/organ/organ_places.h"

#include "data/shapes.h"
#include "haptics/error.h"
#include "haptics/force/linear/layer_contact.h"
#include "haptics/units.h"
#include "tests/support/csv_table.h"
#include "tests/support/series_press.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <numbers>
#include <random>

namespace palp
{
namespace
{

using namespace units::literals;
using Eigen::Vector3d;

constexpr double kYoung = 50e3;
constexpr double kPoisson = 0.45;

// strain energy of a linear displacement, by the moduli of an isotropic solid
TEST(CubeStiffness, HasTheEnergyOfALinearField)
{
  std::mt19937 random(2);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  for (const double nu : { 0.0, 0.3, 0.4999 })
  {
    const Eigen::Matrix3d gradient = Eigen::Matrix3d::NullaryExpr([&] { return number(random); });
    const double side = 4.0_mm;
    Eigen::Matrix<double, 24, 1> moved;
    for (int corner = 0; corner < kCubeCorners; ++corner)
    {
      moved.segment<3>(3 * corner) =
        gradient * side * Vector3d(corner & 1, (corner >> 1) & 1, (corner >> 2) & 1);
    }
    const Eigen::Matrix3d strain = 0.5 * (gradient + gradient.transpose());
    const double lambda = kYoung * nu / ((1.0 + nu) * (1.0 - 2.0 * nu));
    const double mu = kYoung / (2.0 * (1.0 + nu));
    const double energy =
      side * side * side * (0.5 * lambda * std::pow(strain.trace(), 2) + mu * strain.squaredNorm());
    EXPECT_NEAR(0.5 * moved.dot(cubeStiffness(side, kYoung, nu) * moved), energy, 1e-9 * energy);
    CubePoints half;
    for (std::size_t i = 0; i < half.size() / 2; ++i)
    {
      half.set(i);
    }
    EXPECT_NEAR(moved.dot(cutCubeStiffness(side, kYoung, nu, half) * moved), energy, 1e-3 * energy);
  }
}

double volumeOf(const CutGrid& grid)
{
  double cubes = 0.0;
  for (int k = 0; k < grid.size()[2]; ++k)
  {
    for (int j = 0; j < grid.size()[1]; ++j)
    {
      for (int i = 0; i < grid.size()[0]; ++i)
      {
        cubes += grid.filled({ i, j, k });
      }
    }
  }
  return cubes * std::pow(grid.side(), 3);
}

TEST(CutGrid, HoldsTheVolumeOfABody)
{
  const Mesh sphere = makeSphere(30.0_mm, 5);
  const double ball = 4.0 / 3.0 * std::numbers::pi * std::pow(30.0_mm, 3);
  EXPECT_NEAR(volumeOf(CutGrid({ sphere.points, sphere.triangles }, 4.0_mm)), ball, 0.01 * ball);
  Mesh box = makeBox({ 60.0_mm, 40.0_mm, 20.0_mm }, 5.0_mm);
  EXPECT_NEAR(volumeOf(CutGrid({ box.points, box.triangles }, 4.0_mm)), 48e-6, 1e-12);
  for (Vector3d& point : box.points)
  {
    point = Eigen::AngleAxisd(0.6, Vector3d(1.0, 2.0, 0.5).normalized()) * point;
  }
  EXPECT_NEAR(volumeOf(CutGrid({ box.points, box.triangles }, 4.0_mm)), 48e-6, 0.01 * 48e-6);
}

TEST(CutGrid, RefusesAnOpenSurface)
{
  const Mesh grid = makeGrid(5, 0.1);
  EXPECT_THROW(CutGrid({ grid.points, grid.triangles }, 4.0_mm), Error);
}

TEST(CutGrid, RefusesASurfaceThatCrossesItself)
{
  Mesh both = makeBox({ 40.0_mm, 40.0_mm, 20.0_mm }, 5.0_mm);
  const int count = static_cast<int>(both.points.size());
  const Mesh other = both;
  for (const Vector3d& point : other.points)
  {
    both.points.emplace_back(point + Vector3d(13.0_mm, 7.0_mm, 6.0_mm));
  }
  for (const auto& [a, b, c] : other.triangles)
  {
    both.triangles.push_back({ a + count, b + count, c + count });
  }
  try
  {
    CutGrid({ both.points, both.triangles }, 4.0_mm);
    FAIL();
  }
  catch (const Error& error)
  {
    EXPECT_EQ(error.code(), ErrorCode::BadMesh);
    EXPECT_NE(std::string(error.what()).find("crosses itself"), std::string::npos);
  }
}

struct Body
{
  const char* file;    // of the reference
  Vector3d size;       // [m]
  double place = 0.0;  // along x, from the middle [m]
  bool isLobe = false; // held at its end instead of its base
  double lean = 0.0;   // of the side face beside the place [rad]
  double cell = 4.0_mm;
  double limit = 0.025;
};

BodyCompliance bodyOf(const OrganCompliance& found, double modulus)
{
  return { modulus * found.constant, modulus * found.slope.norm(), modulus * found.bend };
}

class AgainstElements : public testing::TestWithParam<Body>
{
};

// forces of fine finite elements with contact, and of the exact layer
TEST_P(AgainstElements, TheForceAgrees)
{
  const Body& body = GetParam();
  Mesh mesh = makeBox(body.size, 2.5_mm);
  for (Vector3d& point : mesh.points)
  {
    point.x() += std::tan(body.lean) * point.z() * (0.5 - point.x() / body.size.x());
  }
  const Surface surface(mesh.points, mesh.triangles);
  const Support support{ [&](const Vector3d& x)
    { return body.isLobe ? x.x() > 0.4999 * body.size.x() : x.z() < -0.9999 * body.size.z(); } };
  const OrganModel model(surface, body.cell, kYoung, kPoisson, std::span(&support, 1));
  const auto found = complianceAt(model, surface, { body.place, 0.0, 0.0 }, Vector3d::UnitZ());
  ASSERT_TRUE(found);
  const test::SeriesPress press(SphereTip{ 10.0_mm });
  const test::CsvTable table =
    test::readCsv(std::string(PALP_SOURCE_DIR "/data/reference/organ_") + body.file + ".csv");
  double worst = 0.0;
  double before = 0.0; // of the half-space
  for (std::size_t i = 0; i < table["depth_m"].size(); ++i)
  {
    const double depth = table["depth_m"][i];
    const double force = table["force_N"][i];
    const double pressed = press.force(bodyOf(*found, press.modulus()), depth);
    EXPECT_NEAR(pressed, force, body.limit * force) << depth;
    worst = std::max(worst, std::abs(pressed / force - 1.0));
    before = std::max(before, std::abs(press.alone(depth).force / force - 1.0));
  }
  RecordProperty("error_percent", std::to_string(100.0 * worst));
  RecordProperty("half_space_percent", std::to_string(100.0 * before));
  EXPECT_LT(worst, before);
}

INSTANTIATE_TEST_SUITE_P(Organ, AgainstElements,
  testing::Values(
    Body{ .file = "layer_50mm", .size = { 0.2, 0.2, 0.05 }, .cell = 6.25_mm, .limit = 0.005 },
    Body{ .file = "layer_20mm", .size = { 0.1, 0.1, 0.02 }, .limit = 0.01 },
    Body{ .file = "edge90_centre", .size = { 0.1, 0.1, 0.05 }, .cell = 5.0_mm, .limit = 0.035 },
    Body{ .file = "edge90_20mm", .size = { 0.1, 0.1, 0.05 }, .place = -0.03, .cell = 5.0_mm },
    Body{ .file = "edge90_8mm", .size = { 0.1, 0.1, 0.05 }, .place = -0.042, .limit = 0.04 },
    Body{ .file = "edge90_6mm", .size = { 0.1, 0.1, 0.05 }, .place = -0.044, .limit = 0.065 },
    Body{ .file = "edge120_8mm",
      .size = { 0.1, 0.1, 0.05 },
      .place = -0.042,
      .lean = std::numbers::pi / 6.0 },
    Body{ .file = "lobe30_20mm", .size = { 0.06, 0.1, 0.03 }, .place = -0.01, .isLobe = true },
    Body{ .file = "lobe30_20mm",
      .size = { 0.06, 0.1, 0.03 },
      .place = -0.01,
      .isLobe = true,
      .cell = 6.0_mm }),
  [](const auto& body) { return std::string(body.param.file) + "_" + std::to_string(body.index); });

// a body that hardly resists is held by nothing but its support, also where cells do not divide it
TEST(OrganCompliance, OfASlenderBodyIsThatOfABeam)
{
  const Vector3d size(100.0_mm, 20.0_mm, 16.0_mm);
  constexpr double nu = 0.3;
  const double length = 90.0_mm;
  const double inertia = size.y() * std::pow(size.z(), 3) / 12.0;
  const double shear = 5.0 / 6.0 * kYoung / (2.0 * (1.0 + nu)) * size.y() * size.z(); // Timoshenko
  const double beam = std::pow(length, 3) / (3.0 * kYoung * inertia) + length / shear;
  for (const double angle : { 0.0, 0.3 })
  {
    const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(angle, Vector3d(3.0, 1.0, 2.0).normalized()).toRotationMatrix();
    Mesh mesh = makeBox(size, 4.0_mm);
    for (Vector3d& point : mesh.points)
    {
      point = turn * point;
    }
    const Surface surface(mesh.points, mesh.triangles);
    const Support end{ [&](const Vector3d& x)
      { return (turn.transpose() * x).x() < -0.49999 * size.x(); } };
    for (const double cell : { 4.0_mm, 3.0_mm, 2.5_mm })
    {
      const OrganModel model(surface, cell, kYoung, nu, std::span(&end, 1));
      const auto found = complianceAt(model, surface, turn * Vector3d(40.0_mm, 0, 0), turn.col(2));
      ASSERT_TRUE(found);
      EXPECT_NEAR(found->constant, beam, 0.08 * beam) << angle << ' ' << cell;
    }
  }
}

// a bar bends as one over its width, of which cubes of 4 mm hold 4 to 6
TEST(OrganCompliance, OfABarIsOneOverItsWidthWhateverItsCubes)
{
  const auto times = [](double width)
  {
    const Mesh mesh = makeBox({ 80.0_mm, width, 25.0_mm }, 5.0_mm);
    const Surface surface(mesh.points, mesh.triangles);
    const Support end{ [](const Vector3d& x) { return x.x() > 39.99_mm; } };
    const OrganModel model(surface, 4.0_mm, kYoung, kPoisson, std::span(&end, 1));
    const auto found =
      complianceAt(model, surface, Vector3d(-16.0_mm, 0.0, 0.0), Vector3d::UnitZ());
    return found.value().constant * width;
  };
  const double whole = times(16.0_mm);
  for (const double width : { 17.0_mm, 17.5_mm, 18.0_mm, 19.0_mm, 22.5_mm, 24.0_mm })
  {
    EXPECT_NEAR(times(width), whole, 0.03 * whole) << width;
  }
}

// the bases half in a cell, the top, neither along the cells; the exact law of a bonded layer
TEST(OrganCompliance, OfASlabIsThatOfALayerInAnyAttitude)
{
  for (const double height : { 20.0_mm, 30.0_mm })
  {
    for (const double angle : { 0.3, std::numbers::pi })
    {
      const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(angle, Vector3d(3.0, 1.0, 0.0).normalized()).toRotationMatrix();
      Mesh mesh = makeBox({ 4.0 * height, 4.0 * height, height }, 5.0_mm);
      for (Vector3d& point : mesh.points)
      {
        point = turn * point;
      }
      const Surface surface(mesh.points, mesh.triangles);
      const Support base{ [&](const Vector3d& x)
        { return (turn.transpose() * x).z() < -0.9999 * height; } };
      const OrganModel model(surface, 4.0_mm, kYoung, kPoisson, std::span(&base, 1));
      const auto found =
        complianceAt(model, surface, turn * Vector3d(1.0_mm, 0.5_mm, 0.0), turn.col(2));
      ASSERT_TRUE(found);
      const test::SeriesPress press(SphereTip{ 10.0_mm });
      const LayerContact layer(SphereTip{ 10.0_mm }, kPoisson, Base::Bonded);
      for (const double depth : { 1.0_mm, 4.0_mm, 8.0_mm })
      {
        const double exact = press.modulus() * layer(depth, height, 0.0).force;
        EXPECT_NEAR(press.force(bodyOf(*found, press.modulus()), depth), exact, 1.2e-2 * exact)
          << height << ' ' << angle << ' ' << depth;
      }
    }
  }
}

// where it was stopped it goes on from, to the same table
TEST(OrganPlaces, GoOnFromWhereTheyWereStopped)
{
  const Mesh mesh = makeBox({ 40.0_mm, 40.0_mm, 20.0_mm }, 5.0_mm);
  const Surface surface(mesh.points, mesh.triangles);
  const Support base{ [](const Vector3d& x) { return x.z() < -19.9_mm; } };
  const std::span supports(&base, 1);
  const OrganModel model(surface, 8.0_mm, kYoung, kPoisson, supports);
  const std::vector<SurfacePoint> places = organPlaces(surface, 4.0_mm);
  OrganTable whole;
  ASSERT_TRUE(addPlaces(whole, model, surface,
    { .places = places, .supports = supports, .tell = [](const OrganTable&) {} }));
  std::stop_source source;
  OrganTable part;
  EXPECT_FALSE(addPlaces(part, model, surface,
    { .places = places,
      .supports = supports,
      .tell = [&](const OrganTable&) { source.request_stop(); },
      .stop = source.get_token() }));
  EXPECT_GT(part.places.size(), 0U);
  ASSERT_LT(part.places.size(), places.size());
  ASSERT_TRUE(addPlaces(part, model, surface,
    { .places = places, .supports = supports, .tell = [](const OrganTable&) {} }));
  ASSERT_EQ(part.places.size(), whole.places.size());
  for (std::size_t i = 0; i < whole.places.size(); ++i)
  {
    EXPECT_EQ(part.places[i].constant, whole.places[i].constant);
  }
}

} // namespace
} // namespace palp
