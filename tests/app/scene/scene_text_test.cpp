#include "app/scene/scene_text.h"

#include "app/input/coating_text.h"
#include "app/input/quantity.h"
#include "app/input/tip_text.h"
#include "app/scene/scene_file.h"
#include "haptics/error.h"
#include "haptics/units.h"

#include <cstdlib>
#include <gtest/gtest.h>
#include <random>
#include <vector>

namespace palp
{
namespace
{

using namespace units::literals;

class SceneText : public ::testing::Test
{
protected:
  SceneText()
  {
    setenv("PALP_DATA", PALP_SHARE, 1);
  }

  double between(double low, double high)
  {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  std::size_t below(std::size_t count)
  {
    return std::uniform_int_distribution<std::size_t>(0, count - 1)(random_);
  }
  Eigen::Vector3d place(double size)
  {
    return { between(-size, size), between(-size, size), between(-size, size) };
  }

  // one for each mesh, of another tissue
  std::vector<OrganPlan> organs(const PressOptions& press)
  {
    std::vector<OrganPlan> organs;
    for (const char* name : { "liver", "left kidney" })
    {
      const auto color = [this] { return static_cast<std::uint8_t>(below(256)); };
      organs.push_back({ .name = name,
        .role = static_cast<OrganRole>(below(4)),
        .color = { color(), color(), color() },
        .press = press });
      organs.back().press.tissue.young *= between(0.9, 1.1);
      organs.back().press.damping = between(0.0, 100.0);
    }
    organs[below(2)].role = OrganRole::Press;
    return organs;
  }

  // whatever a run or a window may leave, with numbers of all their digits
  ScenePlan plan()
  {
    ScenePlan plan;
    plan.name = "a \"title\" é";
    const std::vector<ImagePart> parts{ { .level = between(-1.0, 200.0) },
      { .labels = { "tumor, left", "5" } },
      { .band = { { between(-1e3, 0.0), between(0.0, 3e3) } } } };
    plan.meshes = { { .bundled = "liver" },
      { .file = "/data/liver.nii.gz",
        .part = parts[below(3)],
        .unit = LengthUnit::Centimeter,
        .origin = place(10.0),
        .rotation = place(6.2),
        .supports = { "sliding:hilum", "bonded:points:/data/rests here.csv" } } };
    const std::vector<Tip> tips{ SphereTip{ between(1e-3, 0.01) },
      ConeTip{ between(0.2, 1.4), between(2e-3, 0.01) }, PunchTip{ between(1e-3, 0.01) },
      ParaboloidTip{ between(1e-3, 0.01) } };
    TissueOptions& tissue = plan.press.tissue;
    tissue.tip = tips[below(4)];
    tissue.young = between(1e3, 1e6);
    tissue.poisson = between(0.0, 0.5);
    tissue.options.mode = LawMode::Corrected;
    tissue.options.base = static_cast<Base>(below(3));
    tissue.options.constitution = ConstitutiveModel::Linear;
    if (i_++ % 2 == 0) // nodules are known neither below coatings nor over time
    {
      plan.meshes.back().nodules = { { place(0.3), between(2e-3, 0.02), between(1.1, 40.0) } };
    }
    else
    {
      tissue.options.coatings.add(
        { between(3e-3, 5e-3), { between(0.5, 2.0) * tissue.young, 0.45 } });
      tissue.options.relaxation.add({ between(0.1, 0.4), between(1e-3, 10.0) });
      tissue.options.relaxation.add({ between(0.1, 0.4), between(1e-3, 10.0) });
      tissue.options.friction = between(0.0, 2.0);
    }
    plan.press.contact = static_cast<ContactRule>(below(2));
    plan.press.damping = between(0.0, 100.0);
    plan.organs = below(2) == 0 ? std::vector<OrganPlan>{} : organs(plan.press);
    plan.press.dent = { .surface = static_cast<DentSurface>(below(3)),
      .layer = between(0.01, 0.2),
      .threshold = between(1e-5, 1e-3) };
    plan.window = false;
    plan.presses = PlacedPresses{ .places = { { "F-1", place(0.3) }, { "", place(0.3) } },
      .depth = between(1e-5, 0.1),
      .speed = between(1e-5, 1.0) };
    if (i_ % 3 == 0)
    {
      plan.presses->toward = place(1.0);
    }
    plan.chain = below(2) == 1;
    plan.overlays = { { Overlay::ForceArrow, Overlay::Ghost } };
    plan.plots = { PlotKind::Section, PlotKind::ForceOverTime };
    plan.plotFiles = { "svg", "csv" };
    plan.allSamples = below(2) == 1;
    plan.refined = below(2) == 1;
    plan.size = { 640, 481 };
    plan.camera = CameraPlace{ place(1.0), place(1.0), place(1.0) };
    return plan;
  }

  std::mt19937 random_{ 3 };
  int i_ = 0;
};

TEST_F(SceneText, ReadsBackToTheLastBit)
{
  for (int i = 0; i < 30; ++i)
  {
    const ScenePlan before = plan();
    const std::string text = sceneText(before, "/out");
    const ScenePlan after = parseScene(text, "/out/scene.json");
    ASSERT_EQ(sceneText(after, "/out"), text);
    EXPECT_EQ(after.name, before.name);
    ASSERT_EQ(after.meshes.size(), 2U);
    EXPECT_EQ(after.meshes[0].bundled, "liver");
    EXPECT_EQ(after.meshes[1].file, before.meshes[1].file);
    EXPECT_TRUE(after.meshes[1].part == before.meshes[1].part);
    EXPECT_EQ(after.meshes[1].unit, before.meshes[1].unit);
    EXPECT_EQ(after.meshes[1].origin, before.meshes[1].origin);
    EXPECT_EQ(after.meshes[1].rotation, before.meshes[1].rotation);
    EXPECT_EQ(after.meshes[1].supports, before.meshes[1].supports);
    const TissueOptions& was = before.press.tissue;
    const TissueOptions& is = after.press.tissue;
    EXPECT_EQ(is.tip.index(), was.tip.index());
    EXPECT_EQ(baseRadius(is.tip), baseRadius(was.tip));
    EXPECT_EQ(describeTip(is.tip), describeTip(was.tip));
    EXPECT_EQ(is.young, was.young);
    EXPECT_EQ(is.poisson, was.poisson);
    ASSERT_EQ(is.options.coatings.all().size(), was.options.coatings.all().size());
    for (std::size_t k = 0; k < was.options.coatings.all().size(); ++k)
    {
      EXPECT_EQ(is.options.coatings.all()[k].thickness, was.options.coatings.all()[k].thickness);
      EXPECT_EQ(is.options.coatings.all()[k].material.youngModulus,
        was.options.coatings.all()[k].material.youngModulus);
    }
    EXPECT_EQ(is.options.friction, was.options.friction);
    ASSERT_EQ(is.options.relaxation.all().size(), was.options.relaxation.all().size());
    for (std::size_t k = 0; k < was.options.relaxation.all().size(); ++k)
    {
      EXPECT_EQ(is.options.relaxation.all()[k].fraction, was.options.relaxation.all()[k].fraction);
      EXPECT_EQ(is.options.relaxation.all()[k].time, was.options.relaxation.all()[k].time);
    }
    ASSERT_EQ(after.meshes[1].nodules.size(), before.meshes[1].nodules.size());
    for (std::size_t k = 0; k < before.meshes[1].nodules.size(); ++k)
    {
      EXPECT_EQ(after.meshes[1].nodules[k].center, before.meshes[1].nodules[k].center);
      EXPECT_EQ(after.meshes[1].nodules[k].radius, before.meshes[1].nodules[k].radius);
      EXPECT_EQ(after.meshes[1].nodules[k].ratio, before.meshes[1].nodules[k].ratio);
    }
    ASSERT_EQ(after.organs.size(), before.organs.size());
    for (std::size_t k = 0; k < before.organs.size(); ++k)
    {
      EXPECT_EQ(after.organs[k].name, before.organs[k].name);
      EXPECT_EQ(after.organs[k].role, before.organs[k].role);
      EXPECT_EQ(after.organs[k].color, before.organs[k].color);
      EXPECT_EQ(after.organs[k].press.tissue.young, before.organs[k].press.tissue.young);
      EXPECT_EQ(after.organs[k].press.damping, before.organs[k].press.damping);
    }
    EXPECT_EQ(after.press.damping, before.press.damping);
    EXPECT_EQ(after.press.dent.layer, before.press.dent.layer);
    EXPECT_EQ(after.press.dent.threshold, before.press.dent.threshold);
    EXPECT_EQ(after.presses, before.presses);
    EXPECT_EQ(after.camera, before.camera);
    EXPECT_EQ(after.chain, before.chain);
    EXPECT_EQ(after.allSamples, before.allSamples);
  }
}

TEST_F(SceneText, NamesFilesBesideItAsSuchAndOthersWhole)
{
  ScenePlan plan;
  plan.meshes = { { .file = "/data/liver.stl" } };
  plan.window = false;
  plan.recording = RecordedPress{ "/out/samples.csv", "hand", { "first", "" } };
  const std::string text = sceneText(plan, "/out");
  EXPECT_NE(text.find("\"/data/liver.stl\""), std::string::npos) << text;
  EXPECT_NE(text.find("\"samples.csv\""), std::string::npos) << text;
  const ScenePlan moved = parseScene(text, "/elsewhere/scene.json");
  EXPECT_EQ(moved.recording->file, "/elsewhere/samples.csv");
  EXPECT_EQ(moved.recording->names, plan.recording->names);
  EXPECT_EQ(moved.recording->device, "hand");
}

TEST_F(SceneText, KeepsTheDeviceOfASecondHand)
{
  ScenePlan plan;
  plan.device = parseDevice("path:/out/a.csv");
  plan.second = parseDevice("replay:/out/b.csv");
  const ScenePlan again = parseScene(sceneText(plan, "/out"), "/elsewhere/scene.json");
  ASSERT_TRUE(again.second);
  EXPECT_EQ(again.second->name, "replay:/elsewhere/b.csv");
  EXPECT_EQ(again.device.name, "path:/elsewhere/a.csv");
  plan.second.reset();
  EXPECT_EQ(sceneText(plan, "/out").find("second"), std::string::npos);
}

// a quantity is written as people would, where that loses nothing
TEST(QuantityText, IsInTheUsualUnitWhereThatIsExact)
{
  EXPECT_EQ(quantityText(0.01, Quantity::Length), "10mm");
  EXPECT_EQ(quantityText(0.0003, Quantity::Length), "0.3mm");
  EXPECT_EQ(quantityText(50e3, Quantity::Pressure), "50kPa");
  EXPECT_EQ(quantityText(45.0_deg, Quantity::Angle), "45deg");
  EXPECT_EQ(quantityText(0.025, Quantity::Speed), "25mm/s");
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> value(0.0, 1.0);
  for (int i = 0; i < 100'000; ++i)
  {
    const double x = value(random);
    for (const Quantity kind : { Quantity::Length, Quantity::Pressure, Quantity::Angle })
    {
      ASSERT_EQ(parseQuantity(quantityText(x, kind), kind, "x"), x);
    }
  }
}

TEST_F(SceneText, MapsOfStiffnessAreWrittenAsTheyAreRead)
{
  for (const std::string stiffness :
    { "labels:maps/organs.nii.gz:1=6.63kPa,liver tumor=40kPa", "image:/data/kpa.mha",
      "array:liver.vtp:E_kPa", "formula:if(r<10,40,6+0.1*z)", "random:0.3:8mm:7" })
  {
    const std::string text = R"({"palp_scene": 1, "meshes": [{"bundled": "liver", "stiffness": ")" +
      stiffness + R"("}], "law": {"mode": "corrected"}})";
    const ScenePlan plan = parseScene(text, "/home/me/scene.json");
    const StiffnessSource& source = plan.meshes.front().stiffness;
    EXPECT_TRUE(source.isGiven());
    const std::string again = sceneText(plan, "/home/me");
    EXPECT_NE(again.find("\"stiffness\": \"" + stiffness + "\""), std::string::npos) << again;
    EXPECT_EQ(sceneText(parseScene(again, "/home/me/scene.json"), "/home/me"), again);
    EXPECT_TRUE(source.file.empty() || source.file.is_absolute()) << source.file;
  }
}

TEST_F(SceneText, AMapThatCannotBeFeltIsRefused)
{
  const auto refusal = [](const std::string& mesh, const std::string& rest) -> std::string
  {
    try
    {
      (void)parseScene(
        R"({"palp_scene": 1, "meshes": [{"bundled": "liver", )" + mesh + "}], " + rest + "}",
        "/home/me/scene.json");
    }
    catch (const Error& error)
    {
      return error.what();
    }
    return "";
  };
  const std::string map = R"("stiffness": "random:0.3:8mm:7")";
  const std::string corrected = R"("law": {"mode": "corrected"})";
  EXPECT_EQ(refusal(map, corrected), "");
  EXPECT_NE(refusal(map, R"("law": {"mode": "paper"})").find("stiffness: a map takes the law"),
    std::string::npos);
  EXPECT_EQ(refusal(map, corrected + R"(, "tissue": {"friction": 0.3})"), "");
  const std::string both =
    map + R"(, "nodules": [{"center": ["0mm", "0mm", "0mm"], "radius": "5mm", "ratio": 5}])";
  EXPECT_NE(refusal(both, corrected).find("nodules in a body with a map"), std::string::npos);
  EXPECT_NE(refusal(R"("stiffness": "elastic:3")", corrected).find("stiffness"), std::string::npos);
}

} // namespace
} // namespace palp
