#include "haptics/tip/profile.h"

#include "haptics/error.h"
#include "haptics/force/linear/contact_depth.h"
#include "haptics/force/linear/half_space.h"
#include "haptics/units.h"
#include "tests/support/process.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <numbers>

namespace palp
{
namespace
{

using namespace units::literals;

std::vector<Profile::Point> sampled(const Tip& tip, int count)
{
  std::vector<Profile::Point> points;
  for (int i = 0; i < count; ++i)
  {
    const double r = baseRadius(tip) * i / (count - 1);
    points.push_back({ r, tipHeight(tip, r) });
  }
  return points;
}

class ProfileFile : public ::testing::Test
{
protected:
  [[nodiscard]] std::string refusal(const std::string& text) const
  {
    std::ofstream(file_) << text;
    try
    {
      (void)Profile::read(file_);
    }
    catch (const Error& error)
    {
      EXPECT_EQ(error.code(), ErrorCode::BadFile);
      return std::string(error.what()).substr(file_.string().size());
    }
    return "accepted";
  }

  test::TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.path() / "profile.csv";
};

TEST_F(ProfileFile, IsReadInMillimeters)
{
  std::ofstream(file_) << "# a tip\nradius_mm,height_mm\n0,0\n2,0\r\n\n6,4\n";
  const Profile profile = Profile::read(file_);
  EXPECT_DOUBLE_EQ(profile.baseRadius(), 6.0_mm);
  EXPECT_DOUBLE_EQ(profile.flatRadius(), 2.0_mm);
  EXPECT_DOUBLE_EQ(profile.height(4.0_mm), 2.0_mm);
}

TEST_F(ProfileFile, IsRefusedWithTheLine)
{
  const std::string head = "radius_mm,height_mm\n0,0\n";
  EXPECT_EQ(refusal("r,z\n0,0\n"), ":1: 'r,z' is not the header; begin with radius_mm,height_mm");
  EXPECT_EQ(refusal(head + "1,x\n"), ":3: 'x' is not a number; give radius_mm,height_mm");
  EXPECT_EQ(refusal(head + "1\n"), ":3: 1 columns; give radius_mm,height_mm");
  EXPECT_EQ(refusal(head + "1,nan\n"), ":3: not finite; give numbers");
  EXPECT_EQ(
    refusal("radius_mm,height_mm\n1,0\n"), ":2: not the apex; begin at radius 0 and height 0");
  EXPECT_EQ(refusal(head + "2,1\n2,2\n"),
    ":4: the radius does not grow; sort the points from apex to base");
  EXPECT_EQ(refusal(head + "2,1\n3,0.5\n"), ":4: the height falls; give a convex tip, apex down");
  EXPECT_EQ(refusal(head + "2,2\n4,3\n"), ":4: the profile turns inward; give a convex tip");
  EXPECT_EQ(refusal(head + "2,2\n"), ":3: profile: 2 points; give 3 to 10000");
  EXPECT_EQ(refusal(""), ":1: profile: 0 points; give 3 to 10000");
}

TEST_F(ProfileFile, IsRefusedWhereItIsMissing)
{
  EXPECT_THROW((void)Profile::read("no/such/file.csv"), Error);
}

// a cone cut off flat, from the three points that make it
TEST(Profile, KeepsACorner)
{
  const Profile profile({ { 0.0, 0.0 }, { 2.0_mm, 0.0 }, { 10.0_mm, 8.0_mm } });
  const Tip truncated = TruncatedConeTip{ 45.0_deg, 2.0_mm, 10.0_mm };
  for (double r = 0.0; r < 10.0_mm; r += 0.7_mm)
  {
    EXPECT_NEAR(profile.height(r), tipHeight(truncated, r), 1e-15);
    EXPECT_NEAR(profile.contactDepth(r), contactDepth(truncated, r), 1e-15);
  }
}

TEST(Profile, IsSmoothWhereItsPointsAre)
{
  const Tip sphere = SphereTip{ 10.0_mm };
  const Profile profile(sampled(sphere, 201));
  for (double r = 0.03_mm; r < 8.0_mm; r += 0.17_mm)
  {
    EXPECT_NEAR(profile.height(r), tipHeight(sphere, r), 1e-6 * tipHeight(sphere, r) + 1e-11);
    EXPECT_NEAR(profile.slope(r), tipSlope(sphere, r), 5e-4);
  }
}

TEST(Profile, KeepsTheCornerAmongDensePoints)
{
  const Tip truncated = TruncatedConeTip{ 30.0_deg, 2.0_mm, 10.0_mm };
  const Profile profile(sampled(truncated, 101));
  for (double r = 0.0; r < 10.0_mm; r += 0.03_mm)
  {
    EXPECT_NEAR(profile.height(r), tipHeight(truncated, r), 1e-12) << r;
  }
}

class SampledTip : public ::testing::TestWithParam<Tip>
{
};
INSTANTIATE_TEST_SUITE_P(Profile, SampledTip,
  ::testing::Values(Tip{ SphereTip{ 10.0_mm } }, Tip{ ConeTip{ 30.0_deg, 10.0_mm } },
    Tip{ PunchTip{ 5.0_mm } }, Tip{ TruncatedConeTip{ 45.0_deg, 2.0_mm, 10.0_mm } },
    Tip{ BluntConeTip{ 60.0_deg, 4.0_mm, 10.0_mm } }, Tip{ ParaboloidTip{ 10.0_mm } }));

// the same tip as points and as a closed form
TEST_P(SampledTip, AnswersAsItsClosedForm)
{
  const auto profile = std::make_shared<const Profile>(sampled(GetParam(), 1001));
  const HalfSpace exact(GetParam());
  const HalfSpace baked(ProfileTip{ profile });
  double worst = 0.0;
  for (double depth = 0.01_mm; depth < 10.0_mm; depth *= 1.09)
  {
    const double force = exact(depth).force;
    worst = std::max(worst, std::abs(baked(depth).force / force - 1.0));
    EXPECT_NEAR(baked(depth).force, force, 1e-6 * force) << "depth " << depth;
    EXPECT_NEAR(baked(depth).radius, exact(depth).radius, 2e-4 * exact(depth).radius);
  }
  RecordProperty("worst", std::to_string(worst));
}

// Sneddon: F / E* = 2 depth^2 tan(alpha) / pi, until the contact reaches the wall
TEST(Profile, IsTheConeInFrontOfAWallHoweverSteep)
{
  double worst = 0.0;
  double worstAtWall = 0.0;
  for (const double width : { 1e-9, 1e-8, 1e-6, 1e-4 })
  {
    const HalfSpace law(ProfileTip{ std::make_shared<const Profile>(std::vector<Profile::Point>{
      { 0.0, 0.0 }, { 5.0_mm, 0.1_mm }, { 5.0_mm + width, 50.0_mm } }) });
    const double slope = 0.1 / 5.0;
    const double wall = 0.5 * std::numbers::pi * 0.1_mm; // depth at which it is reached
    for (double depth = 1e-3 * wall; depth < wall; depth *= 1.003)
    {
      const double cone = 2.0 * depth * depth / (std::numbers::pi * slope);
      const double error = std::abs(law(depth).force / cone - 1.0);
      double& largest = depth < 0.95 * wall ? worst : worstAtWall;
      largest = std::max(largest, error);
    }
  }
  EXPECT_LT(worst, 1e-6);
  EXPECT_LT(worstAtWall, 6e-5); // between two rows of the table
  RecordProperty("worst", std::to_string(worst * 1e6) + "e-6");
  RecordProperty("worst_at_wall", std::to_string(worstAtWall * 1e6) + "e-6");
}

} // namespace
} // namespace palp
