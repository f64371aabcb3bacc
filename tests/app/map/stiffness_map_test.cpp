#include "app/map/stiffness_map.h"

#include "app/map/map_work.h"
#include "haptics/error.h"
#include "haptics/units.h"
#include "pipeline/model/poly_data.h"
#include "tests/support/surfaces.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <vtkPolyData.h>

namespace palp
{
namespace
{

using namespace units::literals;
using Eigen::Vector3d;

constexpr auto kGoOn = [](std::size_t, std::size_t) { return true; };

Scene sceneOn(const test::Mesh& mesh)
{
  Scene scene;
  scene.surface = std::make_shared<const Surface>(test::makeSurface(mesh));
  scene.law = ForceLaw(SphereTip{ 10.0_mm }, Material{ 50.0_kPa, 0.33 });
  return scene;
}

// dF/dd of Hertz, by the paper's Eq. (2)
double hertz(double depth)
{
  return 2.0 * 50.0_kPa / (1.0 - 0.33 * 0.33) * std::sqrt(10.0_mm * depth);
}

std::string refusalOf(const std::function<void()>& work)
{
  try
  {
    work();
  }
  catch (const Error& error)
  {
    EXPECT_EQ(error.code(), ErrorCode::BadValue);
    return error.what();
  }
  return "accepted";
}

// on a ball, whose points are known: apart from each other, and none far from all
TEST(PlaceGrid, IsEvenWhateverTheTriangles)
{
  constexpr double kRadius = 60.0_mm;
  constexpr double kSpacing = 8.0_mm;
  const Surface ball = test::makeSurface(test::ball(kRadius, 24));
  const std::vector<SurfacePoint> places = placeGrid(ball, kSpacing);
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    for (std::size_t k = i + 1; k < places.size(); ++k)
    {
      EXPECT_GE((places[i].position - places[k].position).norm(), kSpacing);
    }
  }
  int covered = 0;
  constexpr int kAsked = 2000;
  for (int i = 0; i < kAsked; ++i) // a spiral, even on a ball
  {
    const double z = 1.0 - (2.0 * i + 1.0) / kAsked;
    const double turn = 2.399963 * i;
    const double across = std::sqrt(1.0 - z * z);
    const Vector3d point = kRadius * Vector3d(across * std::cos(turn), across * std::sin(turn), z);
    covered += std::ranges::any_of(places,
      [&](const SurfacePoint& place) { return (place.position - point).norm() < kSpacing; });
  }
  EXPECT_GE(covered, kAsked * 99 / 100);
  EXPECT_EQ(placeGrid(ball, kSpacing).size(), places.size()) << "the same again";
}

TEST(PlaceGrid, KeepsToItsRegion)
{
  const Surface ball = test::makeSurface(test::ball(60.0_mm, 24));
  const MapRegion region{ .center = Vector3d(0.0, 0.0, 60.0_mm), .radius = 20.0_mm };
  const std::vector<SurfacePoint> places = placeGrid(ball, 5.0_mm, region);
  EXPECT_GT(places.size(), 20U);
  for (const SurfacePoint& place : places)
  {
    EXPECT_LE((place.position - region.center).norm(), region.radius);
  }
  const MapRegion nowhere{ .center = Vector3d(0.0, 0.0, 1.0), .radius = 10.0_mm };
  EXPECT_NE(refusalOf([&] { (void)placeGrid(ball, 5.0_mm, nowhere); }).find("no surface"),
    std::string::npos);
  EXPECT_NE(refusalOf([&] { (void)placeGrid(ball, 0.5_mm); }).find("20000"), std::string::npos);
}

// both faces of a thin plate have places of their own
TEST(PlaceGrid, CoversBothSidesOfAThinBody)
{
  const Surface plate = test::makeSurface(test::block({ 0.1, 0.1, 0.002 }, 8));
  const std::vector<SurfacePoint> places = placeGrid(plate, 10.0_mm);
  const auto above =
    std::ranges::count_if(places, [](const SurfacePoint& place) { return place.normal.z() > 0.9; });
  const auto below = std::ranges::count_if(
    places, [](const SurfacePoint& place) { return place.normal.z() < -0.9; });
  EXPECT_GT(above, 40);
  EXPECT_GT(below, 40);
}

// the top of a block is a half-space to the paper's law: the same stiffness everywhere, by Hertz
TEST(StiffnessMap, IsHertzOnAFlatTop)
{
  const Scene scene = sceneOn(test::block({ 0.2, 0.2, 0.1 }, 20));
  const MapRegion top{ .center = Vector3d::Zero(), .radius = 40.0_mm };
  for (const double depth : { 1.0_mm, 4.0_mm })
  {
    const StiffnessMap map =
      pressMap(scene, { .depth = depth, .spacing = 8.0_mm, .region = top }, kGoOn);
    EXPECT_GT(map.pressed(), 40U);
    EXPECT_EQ(map.pressed(), map.places.size());
    for (const MapPlace& place : map.places)
    {
      EXPECT_NEAR(place.response.stiffness, hertz(depth), 1e-6 * hertz(depth));
      EXPECT_NEAR(place.contact.depth, depth, 1e-9);
    }
    const std::vector<double> values = stiffnessAt(map,
      std::vector<SurfacePoint>{ { Vector3d(3.0_mm, 5.0_mm, 0.0), Vector3d::UnitZ() },
        { Vector3d(3.0_mm, 5.0_mm, 0.0), -Vector3d::UnitZ() },
        { Vector3d(60.0_mm, 0.0, 0.0), Vector3d::UnitZ() } });
    EXPECT_NEAR(values[0], hertz(depth), 1e-6 * hertz(depth));
    EXPECT_TRUE(std::isnan(values[1])) << "the other side";
    EXPECT_TRUE(std::isnan(values[2])) << "not pressed";
  }
}

// a block twice as deep as asked cannot be pressed so deep from its thin sides
TEST(StiffnessMap, HasGapsWhereTheBodyIsTooThin)
{
  const Scene scene = sceneOn(test::block({ 0.1, 0.1, 0.006 }, 10));
  const StiffnessMap map = pressMap(scene, { .depth = 4.0_mm, .spacing = 10.0_mm }, kGoOn);
  std::size_t wide = 0;
  for (const MapPlace& place : map.places)
  {
    const bool isWide = std::abs(place.point.normal.z()) > 0.9;
    EXPECT_FALSE(isWide && place.isPressed) << "3 mm are half of the thickness";
    wide += isWide ? 1 : 0;
  }
  ASSERT_GT(wide, 50U);
  for (const double value :
    stiffnessAt(map, std::vector<SurfacePoint>{ { Vector3d::Zero(), Vector3d::UnitZ() } }))
  {
    EXPECT_TRUE(std::isnan(value));
  }
}

TEST(StiffnessMap, TakesAtAPlaceItsOwnValueAndBetweenTwoOneBetween)
{
  StiffnessMap map{ .asked = { .spacing = 10.0_mm }, .scene = {}, .places = {} };
  for (const double side : { -1.0, 1.0 })
  {
    map.places.push_back({ .point = { Vector3d(side * 6.0_mm, 0.0, 0.0), Vector3d::UnitZ() },
      .isPressed = true,
      .response = { .stiffness = 300.0 + 100.0 * side } });
  }
  const auto at = [&](double x)
  {
    return stiffnessAt(
      map, std::vector<SurfacePoint>{ { Vector3d(x, 0.0, 0.0), Vector3d::UnitZ() } })
      .front();
  };
  EXPECT_NEAR(at(-6.0_mm), 200.0, 1e-6);
  EXPECT_NEAR(at(6.0_mm), 400.0, 1e-6);
  EXPECT_NEAR(at(0.0), 300.0, 1e-9);
  EXPECT_GT(at(2.0_mm), 300.0);
  EXPECT_LT(at(2.0_mm), 400.0);
}

TEST(StiffnessMap, StopsWhenToldTo)
{
  const Scene scene = sceneOn(test::block({ 0.2, 0.2, 0.1 }, 10));
  const StiffnessMap map =
    pressMap(scene, {}, [](std::size_t done, std::size_t) { return done < 7; });
  EXPECT_EQ(map.places.size(), 7U);
}

TEST(StiffnessMap, HoldsForItsOwnToolAndTissueOnly)
{
  const Scene scene = sceneOn(test::block({ 0.1, 0.1, 0.05 }, 10));
  const StiffnessMap map = pressMap(scene, { .depth = 2.0_mm, .spacing = 40.0_mm }, kGoOn);
  Scene other = scene;
  other.version = 9;
  other.forceLimit = 1.0;
  EXPECT_TRUE(map.holdsIn(other)) << "neither is in the map";
  other.law = ForceLaw(SphereTip{ 10.0_mm }, Material{ 51.0_kPa, 0.33 });
  EXPECT_FALSE(map.holdsIn(other));
  other.law = ForceLaw(SphereTip{ 9.0_mm }, Material{ 50.0_kPa, 0.33 });
  EXPECT_FALSE(map.holdsIn(other));
}

TEST(MapWork, GivesUpSoonAndTellsWhatWasRefused)
{
  const test::Mesh mesh = test::block({ 0.2, 0.2, 0.1 }, 20);
  const Scene scene = sceneOn(mesh);
  const auto shown = makePolyData(scene.surface->points(), scene.surface->triangles());
  {
    const MapWork endless(scene, { .spacing = 1.5_mm }, *shown); // ends with its block
  }
  MapWork refused(scene, { .spacing = 0.5_mm }, *shown);
  EXPECT_NE(refusalOf([&] { (void)refused.take(); }).find("20000"), std::string::npos);
  MapWork work(scene, { .depth = 2.0_mm, .spacing = 30.0_mm }, *shown);
  const MapWork::Made made = work.take();
  EXPECT_EQ(made.colors.values->GetNumberOfValues(), shown->GetNumberOfPoints());
  EXPECT_NEAR(made.colors.high, units::toNewtonsPerMillimeter(hertz(2.0_mm)), 1e-3);
}

// whose inner wall no tool reaches
TEST(PlaceGrid, OfAHollowBallIsOnItsOutside)
{
  test::Mesh hollow = test::ball(40.0_mm, 12);
  const int count = static_cast<int>(hollow.first.size());
  const test::Mesh inner = test::ball(20.0_mm, 12);
  hollow.first.insert(hollow.first.end(), inner.first.begin(), inner.first.end());
  for (const auto& [a, b, c] : inner.second)
  {
    hollow.second.push_back({ c + count, b + count, a + count });
  }
  const auto places = placeGrid(test::makeSurface(hollow), 8.0_mm);
  EXPECT_GT(places.size(), 100U);
  for (const SurfacePoint& place : places)
  {
    EXPECT_GT(place.position.norm(), 38.0_mm);
  }
}

} // namespace
} // namespace palp
