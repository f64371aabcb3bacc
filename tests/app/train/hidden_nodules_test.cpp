#include "app/train/hidden_nodules.h"

#include "app/train/search_area.h"
#include "data/shapes.h"
#include "haptics/contact/contact_geometry_of.h"
#include "haptics/contact/embed_nodules.h"
#include "haptics/contact/find_contact.h"
#include "haptics/error.h"
#include "haptics/surface/closest_point.h"

#include <cstdlib>
#include <gtest/gtest.h>
#include <limits>

namespace palp
{
namespace
{

ForceLaw lawOf(LawMode mode, const Tip& tip = SphereTip{ 10.0e-3 },
  ConstitutiveModel constitution = ConstitutiveModel::NeoHookean)
{
  TissueOptions options{ .tip = tip, .young = 6.63e3, .poisson = 0.49, .options = {} };
  options.options.mode = mode;
  options.options.constitution = constitution;
  return options.law();
}

class HiddenNodules : public ::testing::Test
{
protected:
  HiddenNodules()
  {
    setenv("PALP_DATA", PALP_SHARE, 1);
    curriculum_ = shippedCurriculum();
  }

  [[nodiscard]] std::vector<PlacedNodule> hide(const TrainingPlan& plan) const
  {
    return hideNodules(ball_, law_, curriculum_, plan);
  }

  // of the side that is searched
  static Surface ball(double radius)
  {
    const Mesh mesh = makeSphere(radius, 5);
    return { mesh.points, mesh.triangles };
  }

  [[nodiscard]] std::string refusalOf(const Surface& surface) const
  {
    return refusalOf(surface, law_);
  }

  [[nodiscard]] std::string refusalOf(
    const Surface& surface, const ForceLaw& law, const TrainingPlan& plan = {}) const
  {
    try
    {
      (void)hideNodules(surface, law, curriculum_, plan);
    }
    catch (const Error& error)
    {
      return error.what();
    }
    return "accepted";
  }

  Surface ball_ = ball(0.1);
  ForceLaw law_ = lawOf(LawMode::Corrected);
  Curriculum curriculum_;
};

// by the tables that the servo reads, at the place right above, against the level's own words
TEST_F(HiddenNodules, AreAsTheLevelSaysAndAreFelt)
{
  for (const TrainingLevel& level : curriculum_.levels)
  {
    const TrainingPlan plan{ .level = level.name, .seed = 3 };
    const std::vector<PlacedNodule> hidden = hide(plan);
    ASSERT_EQ(hidden.size(), static_cast<std::size_t>(level.nodules));
    const auto field = embedNodules(ball_, law_, hidden); // refuses what overlaps
    for (std::size_t i = 0; i < hidden.size(); ++i)
    {
      const Nodule nodule = field->nodules()[i].below();
      EXPECT_GE(nodule.radius, level.radius.low);
      EXPECT_LE(nodule.radius, level.radius.high);
      EXPECT_NEAR(nodule.top, 0.5 * (level.cover.low + level.cover.high),
        0.5 * (level.cover.high - level.cover.low) + 0.2e-3);
      const Eigen::Vector3d up = hidden[i].center.normalized();
      EXPECT_GE(up.dot(plan.side.normalized()), 0.5 - 0.03); // within 60 degrees
      const ToolPose pose{ .apex = (0.1 - level.depth) * up, .axis = -up };
      const Contact contact = findContact(ball_, law_.tip(), pose, ContactRule::Exact);
      const std::vector<double> felt =
        field->contrasts(noduleContactOf(contact), law_(contactGeometryOf(contact)));
      EXPECT_GE(felt[i], 0.95 * level.contrast) << level.name;
      for (std::size_t k = 0; k < i; ++k)
      {
        EXPECT_GT((hidden[i].center - hidden[k].center).norm(), 2.0 * curriculum_.hitWithin);
      }
    }
  }
}

TEST_F(HiddenNodules, FollowFromTheSeedAlone)
{
  const auto centers = [&](const TrainingPlan& plan)
  {
    std::vector<Eigen::Vector3d> all;
    for (const PlacedNodule& nodule : hide(plan))
    {
      all.push_back(nodule.center);
    }
    return all;
  };
  const TrainingPlan plan{ .seed = 11, .nodules = 2 };
  EXPECT_EQ(centers(plan), centers(plan));
  EXPECT_EQ(centers(plan).size(), 2U);
  EXPECT_NE(centers(plan), centers({ .seed = 12, .nodules = 2 }));
  EXPECT_NE(
    centers(plan).front(), centers({ .level = "medium", .seed = 11, .nodules = 2 }).front());
}

// where the first of them leave no room for the last, they begin anew; how a ball is held, which
// the law does not know, is no hindrance
TEST_F(HiddenNodules, FindRoomInBodiesOfOrdinarySize)
{
  const Mesh mesh = makeBox({ 0.1, 0.1, 0.05 }, 5.0e-3);
  const Surface block(mesh.points, mesh.triangles);
  for (std::uint32_t seed = 1; seed <= 12; ++seed)
  {
    const TrainingPlan plan{ .level = "easy", .seed = seed };
    EXPECT_EQ(hideNodules(block, law_, curriculum_, plan).size(), 3U) << seed;
    EXPECT_EQ(hideNodules(ball(0.05), law_, curriculum_, plan).size(), 3U) << seed;
  }
}

TEST_F(HiddenNodules, AreRefusedWhereTheyHaveNoRoomOrAreNotKnown)
{
  EXPECT_NE(refusalOf(ball(0.02)).find("as at most places another nodule is nearer than 36 mm"),
    std::string::npos)
    << refusalOf(ball(0.02));
  const Mesh plate = makeBox({ 0.1, 0.1, 0.012 }, 5.0e-3);
  const std::string thin = refusalOf({ plate.points, plate.triangles });
  EXPECT_NE(thin.find("as at most places the body is too thin"), std::string::npos) << thin;
  EXPECT_NE(thin.find("; give another level or body"), std::string::npos) << thin;
  EXPECT_THROW((void)hideNodules(ball_, lawOf(LawMode::Paper), curriculum_, {}), Error);
  EXPECT_THROW((void)hide({ .level = "impossible" }), Error);
}

// large strain is known of spheres and cones, and of none deeper than its radius
TEST_F(HiddenNodules, SayWithWhatTheyWouldFindRoomUnderAPunch)
{
  const auto ends = [&](double radius, const TrainingPlan& plan, const std::string& remedy)
  {
    const std::string why = refusalOf(ball_, lawOf(LawMode::Corrected, PunchTip{ radius }), plan);
    EXPECT_TRUE(why.ends_with("; give " + remedy)) << why;
  };
  ends(5.0e-3, { .level = "easy" }, "a sphere or a cone as tool, or the material 'linear'");
  ends(4.5e-3, { .level = "medium" },
    "a sphere or a cone as tool, with a radius above 5 mm, or another level");
  EXPECT_EQ(
    refusalOf(ball_, lawOf(LawMode::Corrected, PunchTip{ 5.0e-3 }, ConstitutiveModel::Linear),
      { .level = "easy" }),
    "accepted");
}

TEST(Curriculum, IsRefusedByItsKey)
{
  const auto refusal = [](const std::string& text)
  {
    try
    {
      (void)parseCurriculum(text, "levels.json");
    }
    catch (const Error& error)
    {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::string head =
    R"({"palp_training": 1, "hit_within": "10mm", "too_hard": "6N", "most_false_marks": 1, "levels": [)";
  const auto level = [&](const std::string& cover)
  {
    return head + R"({"name": "a", "nodules": 1, "radius": ["5mm", "6mm"], "cover": )" + cover +
      R"(, "ratio": ["3", "4"], "depth": "5mm", "contrast": 0.1}]})";
  };
  EXPECT_EQ(refusal(level(R"(["2mm", "3mm"])")), "");
  EXPECT_NE(refusal(level(R"(["1mm", "3mm"])")).find("/levels/0/cover"), std::string::npos);
  EXPECT_NE(refusal(level(R"(["3mm", "2mm"])")).find("not from low to high"), std::string::npos);
  EXPECT_NE(refusal(level(R"("3mm")")).find("cover"), std::string::npos);
  EXPECT_NE(refusal(head + "]}").find("at least one"), std::string::npos);
}

} // namespace
} // namespace palp
