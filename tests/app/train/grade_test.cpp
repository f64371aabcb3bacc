#include "app/train/grade.h"

#include "data/shapes.h"
#include "haptics/contact/embed_nodules.h"
#include "haptics/error.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <random>

namespace palp
{
namespace
{

constexpr double kSide = 0.1;       // of the block that is searched from above [m]
constexpr double kHitWithin = 0.01; // [m]

Curriculum oneLevel()
{
  return { .hitWithin = kHitWithin,
    .hardForce = 6.0,
    .mostFalseMarks = 0,
    .levels = { { .name = "easy",
      .title = "",
      .nodules = 3,
      .radius = { 7e-3, 8e-3 },
      .cover = { 2.5e-3, 4e-3 },
      .ratio = { 15.0, 25.0 },
      .depth = 4e-3,
      .contrast = 0.4 } } };
}

class GradeTest : public ::testing::Test
{
protected:
  GradeTest()
  {
    const Mesh box = makeBox({ kSide, kSide, 0.05 }, 5e-3);
    scene_.surface = std::make_shared<const Surface>(box.points, box.triangles);
    LawSettings settings;
    settings.mode = LawMode::Corrected;
    scene_.law = ForceLaw(SphereTip{ 0.01 }, { 6.63e3, 0.49 }, settings);
    const std::vector<PlacedNodule> nodules{ { { -0.025, -0.02, -0.011 }, 7e-3, 20.0 },
      { { 0.02, 0.0, -0.011 }, 7e-3, 20.0 }, { { 0.0, 0.03, -0.011 }, 7e-3, 20.0 } };
    scene_.nodules = embedNodules(*scene_.surface, scene_.law, nodules);
    plan_.side = Eigen::Vector3d::UnitZ();
    plan_.marks.emplace();
  }

  // the tool at a place of the top, for a millisecond
  void touch(double x, double y, double force = 1.0, double radius = 5e-3)
  {
    Sample& sample = samples_.emplace_back();
    sample.time = 1e-3 * static_cast<double>(samples_.size());
    sample.pose.apex = { x, y, -3e-3 };
    sample.contact.depth = 3e-3;
    sample.contact.center = { x, y, 0.0 };
    sample.contact.normal = Eigen::Vector3d::UnitZ();
    sample.response = { .force = force, .contactRadius = radius, .stiffness = 0.0 };
  }

  void mark(double x, double y)
  {
    touch(x, y);
    plan_.marks->push_back(samples_.back().time);
  }

  [[nodiscard]] Grade grade() const
  {
    return gradeSearch(scene_, samples_, plan_, oneLevel());
  }

  Scene scene_;
  TrainingPlan plan_;
  std::vector<Sample> samples_;
};

TEST_F(GradeTest, CountsMarksAsFreeResponseDoes)
{
  mark(-0.022, -0.02);  // 3 mm beside the first
  mark(-0.025, -0.019); // the same once more
  mark(0.02, -0.0099);  // just near the second
  mark(0.0, 0.0199);    // just beside the third
  mark(0.04, 0.04);
  const Grade graded = grade();
  EXPECT_EQ(graded.hits, 2U);
  EXPECT_EQ(graded.repeatedMarks, 1U);
  EXPECT_EQ(graded.falseMarks, 2U);
  EXPECT_FALSE(graded.isPassed);
  EXPECT_NEAR(*graded.meanError, 0.5 * (3e-3 + 9.9e-3), 1e-9);
  EXPECT_EQ(graded.nodules[0].foundBy, 0U);
  EXPECT_EQ(graded.nodules[2].foundBy, std::nullopt);
}

TEST_F(GradeTest, TakesTheLastTouchAsThePlaceOfAMark)
{
  touch(-0.04, 0.04);
  touch(0.02, 0.0);
  plan_.marks->push_back(5.0); // long after
  EXPECT_EQ(grade().hits, 1U);
  plan_.marks->front() = 0.0;
  EXPECT_THROW((void)grade(), Error);
}

// a strip with round ends; forces and times by hand
TEST_F(GradeTest, MeasuresASlideAsGeometrySays)
{
  constexpr int kSteps = 2000;
  constexpr double kLength = 0.06;
  for (int i = 0; i <= kSteps; ++i)
  {
    touch(kLength * (static_cast<double>(i) / kSteps - 0.5), 0.01, i < kSteps / 2 ? 2.0 : 7.0);
  }
  const Grade graded = grade();
  const double strip = 2.0 * 5e-3 * kLength + std::numbers::pi * 5e-3 * 5e-3;
  const double expected = strip / (kSide * kSide);
  EXPECT_NEAR(graded.area.area, kSide * kSide, 1e-9);
  EXPECT_NEAR(
    graded.coverage, expected, 4.0 * std::sqrt(expected * (1.0 - expected) / SearchArea::kPoints));
  EXPECT_NEAR(graded.pathLength, kLength, 1e-9);
  EXPECT_NEAR(graded.time, 2.0, 1e-9);
  EXPECT_EQ(graded.peakForce, 7.0);
  EXPECT_NEAR(graded.meanForce, 4.5, 1e-9);
  EXPECT_NEAR(graded.tooHard, 0.5, 1e-9);
  EXPECT_EQ(graded.tooSoft, 0.0); // 12 mm / sqrt 7 is 4.5 mm
  for (Sample& sample : samples_)
  {
    sample.response.contactRadius = 4e-3;
  }
  EXPECT_NEAR(grade().tooSoft, 1.0, 1e-9);
}

// the part of the top that is near one of three nodules, which are far from its edges
TEST_F(GradeTest, RandomMarksFindWhatTheirAreaGives)
{
  constexpr int kMarks = 5000;
  constexpr double kNear = std::numbers::pi * kHitWithin * kHitWithin / (kSide * kSide);
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> along(-0.5 * kSide, 0.5 * kSide);
  for (int i = 0; i < kMarks; ++i)
  {
    const double x = along(engine);
    mark(x, along(engine));
  }
  const double spread = std::sqrt(kMarks * 3.0 * kNear);
  EXPECT_NEAR(static_cast<double>(kMarks - grade().falseMarks), kMarks * 3.0 * kNear, 4.0 * spread);

  plan_.marks->resize(10);
  const double expected = 3.0 * (1.0 - std::pow(1.0 - kNear, 10.0));
  EXPECT_NEAR(grade().hitsByChance, expected, 0.05 * expected);
}

TEST_F(GradeTest, FindsNothingWithoutAMarkAndIsNotPassed)
{
  touch(0.0, 0.0);
  const Grade graded = grade();
  EXPECT_EQ(graded.hits, 0U);
  EXPECT_EQ(graded.hitsByChance, 0.0);
  EXPECT_FALSE(graded.meanError);
  EXPECT_FALSE(graded.isPassed);
}

} // namespace
} // namespace palp
