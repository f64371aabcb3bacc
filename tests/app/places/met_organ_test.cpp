#include "app/places/met_organ.h"

#include "app/folder/played_plan.h"
#include "app/places/placed_press.h"
#include "app/press/playback.h"
#include "haptics/error.h"
#include "haptics/units.h"
#include "tests/support/surfaces.h"

#include <gtest/gtest.h>

namespace palp
{
namespace
{

using namespace units::literals;
using Eigen::Vector3d;

// a low block of 100 x 100 mm, its top at 0, beside a higher one of which the wall stands at x = 50
Recording stepOf(double height, double lid = 0.0)
{
  const auto block = [](const Vector3d& size, const Vector3d& top)
  {
    test::Mesh mesh = test::block(size, 10);
    for (Vector3d& point : mesh.first)
    {
      point += top;
    }
    Scene scene;
    scene.surface = std::make_shared<const Surface>(test::makeSurface(mesh));
    scene.law = ForceLaw(SphereTip{ 10.0_mm }, Material{ 50.0_kPa, 0.33 });
    return scene;
  };
  Recording recording{ .organs = { { .name = "low" }, { .name = "high" } },
    .scene = block({ 0.1, 0.1, 0.05 }, Vector3d::Zero()) };
  recording.scene.others.push_back(
    block({ 0.1, 0.1, 0.05 + height }, { 0.1 + 1e-6 - lid, 0.0, height }));
  return recording;
}

// of the press that is played anyway
std::string noteAt(double x, Recording recording)
{
  ScenePlan plan;
  plan.presses = PlacedPresses{ .places = { { "P", { x, 0.0, 0.0 } } }, .depth = 2.0_mm };
  const std::vector<std::string> notes = playInto(recording, plan, nullptr);
  EXPECT_LE(notes.size(), 1u);
  return notes.empty() ? "" : notes.front();
}

// a ball of R = 10 mm whose center is at 10 - 2 = 8 mm is as wide there as its radius
TEST(MetOrgan, IsToldWhereItIsNotThatOfThePlace)
{
  const Recording step = stepOf(8.0_mm);
  EXPECT_EQ(noteAt(20.0_mm, step), "");
  EXPECT_EQ(noteAt(39.0_mm, step), "");
  const std::string near = noteAt(45.0_mm, step);
  EXPECT_TRUE(near.starts_with("the place P, 45,0,0 mm is on low, but the tool meets high first"))
    << near;
  Recording one = step;
  one.scene.others.clear();
  EXPECT_EQ(noteAt(45.0_mm, one), "");
}

// what a live session keeps of it tells the same
TEST(MetOrgan, IsToldOnceByTheKeptPress)
{
  Recording step = stepOf(8.0_mm);
  PressLog log;
  const PlacedPresses presses{ .places = { { "P", { 45.0_mm, 0.0, 0.0 } } }, .depth = 2.0_mm };
  AwaitedPress awaited;
  awaited.begin(presses, step, log);
  step.samples = playEach(pathsOf(presses, step.scene), step.scene);
  ASSERT_EQ(log.keepAll(step), 1u);
  EXPECT_EQ(awaited.end(log), noteAt(45.0_mm, stepOf(8.0_mm)));
  EXPECT_EQ(awaited.end(log), "");
  awaited.begin(presses, step, log);
  EXPECT_EQ(awaited.end(log), "") << "that was the one before";
}

TEST(MetOrgan, RefusesAPlaceWithinAnother)
{
  const Recording covered = stepOf(30.0_mm, 60.0_mm); // the high one stands over the low one
  try
  {
    (void)noteAt(20.0_mm, covered);
    ADD_FAILURE() << "accepted";
  }
  catch (const Error& error)
  {
    EXPECT_EQ(error.code(), ErrorCode::BadValue);
    EXPECT_STREQ(error.what(),
      "the place P, 20,0,0 mm is on low, but a tool comes to it through high only; give a place on "
      "high, or give that a role other than press");
  }
}

} // namespace
} // namespace palp
