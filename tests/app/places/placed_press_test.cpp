#include "app/places/placed_press.h"

#include "app/press/playback.h"
#include "app/press/presses.h"
#include "haptics/error.h"
#include "haptics/units.h"
#include "tests/support/surfaces.h"

#include <cmath>
#include <gtest/gtest.h>

namespace palp
{
namespace
{

using namespace units::literals;
using Eigen::Vector3d;

Scene sceneOn(const test::Mesh& mesh, const Tip& tip = SphereTip{ 10.0_mm })
{
  Scene scene;
  scene.surface = std::make_shared<const Surface>(test::makeSurface(mesh));
  scene.law = ForceLaw(tip, Material{ 50.0_kPa, 0.33 });
  scene.forceLimit = std::numeric_limits<double>::infinity();
  return scene;
}

std::vector<Sample> pressed(const PlacedPresses& presses, const Scene& scene)
{
  return playEach(pathsOf(presses, scene), scene);
}

std::string refusalOf(const PlacedPresses& presses, const Scene& scene)
{
  try
  {
    (void)pathsOf(presses, scene);
  }
  catch (const Error& error)
  {
    EXPECT_EQ(error.code(), ErrorCode::BadValue);
    return error.what();
  }
  return "accepted";
}

// a foot of 30 mm about which a wall of 20 mm stands
test::Mesh basin()
{
  return test::cubeMap(20,
    [](const Vector3d& p)
    {
      const double outward = p.head<2>().cwiseAbs().maxCoeff();
      const double top = outward > 0.55 ? 20.0_mm : 0.0;
      return Vector3d(
        60.0_mm * p.x(), 60.0_mm * p.y(), p.z() > 0.0 ? p.z() * top : 40.0_mm * p.z());
    });
}

// it would be pressed somewhere else, with another force
TEST(PlacedPress, RefusesAPlaceBesideWhatTheToolTouchesFirst)
{
  const PlacedPresses presses{ .places = { { "", Vector3d(20.0_mm, 0.0, 0.0) } }, .depth = 2.0_mm };
  EXPECT_NE(
    refusalOf(presses, sceneOn(basin(), SphereTip{ 60.0_mm })).find("beside it, and not there"),
    std::string::npos);
  const auto samples = pressed(presses, sceneOn(basin(), SphereTip{ 8.0_mm }));
  const Sample* deepest = deepestOf(samples);
  ASSERT_NE(deepest, nullptr);
  EXPECT_NEAR(deepest->contact.center.x(), 20.0_mm, 0.1_mm);
}

// where a ball is pressed the normal is known: each press is straight and as deep as asked
TEST(PlacedPress, IsAsDeepAsAskedAlongTheNormalOfTheNearestPoint)
{
  const Scene scene = sceneOn(test::ball(60.0_mm, 40));
  const Vector3d outward = Vector3d(1.0, -2.0, 2.0) / 3.0;
  for (const double offset : { -3.0_mm, 0.0, 4.0_mm }) // below, on and above the surface
  {
    const auto samples =
      pressed({ .places = { { "", (60.0_mm + offset) * outward } }, .depth = 5.0_mm }, scene);
    const Sample* deepest = deepestOf(samples);
    ASSERT_NE(deepest, nullptr);
    EXPECT_NEAR(deepest->contact.depth, 5.0_mm, 1e-12);
    EXPECT_LT((deepest->pose.axis + outward).norm(), 0.01); // of a mesh of 3 mm edges
    EXPECT_LT((deepest->contact.center - 60.0_mm * outward).norm(), 0.3_mm);
    EXPECT_FALSE(samples.front().contact.touching());
    EXPECT_FALSE(samples.back().contact.touching());
  }
}

// a flat top is pressed straight down where it was asked for, however few triangles it has
TEST(PlacedPress, OnABoxOfTwelveTrianglesIsStraight)
{
  const Scene scene = sceneOn(test::block({ 0.1, 0.1, 0.05 }, 1));
  for (const Vector3d& place : { Vector3d(10.0_mm, 20.0_mm, 0.0), Vector3d(5.0_mm, 5.0_mm, 0.0),
         Vector3d(-22.0_mm, 13.0_mm, 2.0_mm), Vector3d(30.0_mm, -30.0_mm, 0.0) })
  {
    const auto samples = pressed({ .places = { { "", place } }, .depth = 2.0_mm }, scene);
    const Sample* deepest = deepestOf(samples);
    ASSERT_NE(deepest, nullptr);
    EXPECT_NEAR(deepest->contact.depth, 2.0_mm, 1e-9);
    EXPECT_LT((deepest->pose.axis + Vector3d::UnitZ()).norm(), 1e-6) << place.transpose();
    EXPECT_LT((deepest->contact.center - Vector3d(place.x(), place.y(), 0.0)).norm(), 1e-6);
  }
}

// the depth rises to 5.3 mm above the middle, where the tool turns to the other side, and falls
TEST(PlacedPress, GetsAsDeepAsAThinBodyAllows)
{
  const Scene scene = sceneOn(test::block({ 0.08, 0.08, 0.012 }, 16), ConeTip{ 60.0_deg, 10.0_mm });
  for (const double depth : { 2.0_mm, 4.9_mm, 5.0_mm, 5.2_mm })
  {
    const auto samples = pressed({ .places = { {} }, .depth = depth }, scene);
    const Sample* deepest = deepestOf(samples);
    ASSERT_NE(deepest, nullptr);
    EXPECT_NEAR(deepest->contact.depth, depth, 1e-9);
  }
}

TEST(PlacedPress, GoesDownAtTheSpeedThatWasGiven)
{
  const Scene scene = sceneOn(test::block({ 0.2, 0.2, 0.1 }, 20));
  for (const double speed : { 5.0_mm, 40.0_mm }) // per second
  {
    const auto presses = findPresses(Recording{ .scene = scene,
      .samples = pressed(
        { .places = { { "", Vector3d::Zero() } }, .depth = 4.0_mm, .speed = speed }, scene) });
    ASSERT_EQ(presses.size(), 1U);
    EXPECT_NEAR(presses[0].end - presses[0].begin, 2.0 * 4.0_mm / speed + 0.1, 0.003);
  }
}

// several places in one recording: none of them changes another
TEST(PlacedPress, EachIsAsIfItWereAlone)
{
  const Scene scene = sceneOn(test::block({ 0.2, 0.2, 0.1 }, 20));
  const std::vector<PressPlace> places{ { "a", { 0.0, 0.0, 0.0 } }, { "b", { 0.05, 0.02, 1e-3 } },
    { "c", { 0.0, 0.03, -0.1 } } }; // the last from below
  const auto together = findPresses({ .names = { "a", "b", "c" },
    .scene = scene,
    .samples = pressed({ .places = places }, scene) });
  ASSERT_EQ(together.size(), 3U);
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    const auto alone =
      findPresses({ .scene = scene, .samples = pressed({ .places = { places[i] } }, scene) });
    ASSERT_EQ(alone.size(), 1U);
    EXPECT_EQ(together[i].name, places[i].name);
    EXPECT_NEAR(together[i].force, alone[0].force, 1e-12);
    EXPECT_NEAR(together[i].deepest.depth, 5.0_mm, 1e-12);
    EXPECT_LT((together[i].deepest.center - alone[0].deepest.center).norm(), 1e-9);
  }
  EXPECT_GT(together[2].deepest.normal.dot(-Vector3d::UnitZ()), 0.99);
}

// a line onto the upper face, or aslant onto a side
TEST(PlacedPress, FollowsALineToTheSurface)
{
  const Scene scene = sceneOn(test::block({ 0.1, 0.1, 0.06 }, 10));
  for (const auto& [from, toward, onto] :
    { std::tuple(Vector3d(0.01, -0.02, 0.3), Vector3d(0.0, 0.0, -2.0), Vector3d(0.01, -0.02, 0.0)),
      { { 0.25, 0.01, -0.03 }, { -1.0, 0.1, 0.0 }, { 0.05, 0.03, -0.03 } } })
  {
    const auto samples = pressed({ .places = { { "", from } }, .toward = toward }, scene);
    const Sample* deepest = deepestOf(samples);
    ASSERT_NE(deepest, nullptr);
    EXPECT_NEAR(deepest->contact.depth, 5.0_mm, 1e-12);
    EXPECT_LT((deepest->contact.center - onto).norm(), 1e-6);
  }
}

TEST(PlacedPress, RefusesInOneSentence)
{
  const Scene scene = sceneOn(test::block({ 0.1, 0.1, 0.02 }, 10));
  const std::string far = refusalOf({ .places = { { "far", { 1e-3, 2e-3, 0.01 } } } }, scene);
  EXPECT_TRUE(
    far.starts_with("the place far, 1,2,10 mm: 10 mm off the surface, whose nearest point is 1,2,"))
    << far;
  const std::string deep = refusalOf({ .places = { {} }, .depth = 11.0_mm }, scene);
  EXPECT_NE(deep.find("a depth of 11mm is more than half of the 20 mm"), std::string::npos) << deep;
  const std::string past =
    refusalOf({ .places = { { "", { 0.0, 0.0, 0.1 } } }, .toward = Vector3d::UnitX() }, scene);
  EXPECT_NE(past.find("does not meet the surface"), std::string::npos) << past;
}

TEST(PressPlaceText, IsReadHoweverItsNumbersAreApart)
{
  const Eigen::Vector3d place(-0.05, -0.02, 0.0605);
  for (const char* text : { "-50,-20,60.5", " -50, -20, 60.5 ", "-50 -20 60.5", "-50\t-20\t60.5",
         "  -50   -20 \t 60.5  ", "\u221250, \u221220, 60.5", "\u221250 -20 60.5" })
  {
    EXPECT_LT((parsePlace(text).position - place).norm(), 1e-12) << text;
  }
  for (const char* text :
    { "-50 -20", "-50 -20 60 5", "-50,-20 60", "-50 -20 6o", "", "- 50 -20 60" })
  {
    EXPECT_THROW((void)parsePlace(text), Error) << text;
  }
}

} // namespace
} // namespace palp
