#include "app/scene/scene_file.h"

#include "haptics/error.h"
#include "haptics/units.h"
#include "tests/support/process.h"

#include <nlohmann/json.hpp>

#include <cstdlib>
#include <gtest/gtest.h>

namespace palp
{
namespace
{

using namespace units::literals;
using nlohmann::json;

json least()
{
  return { { "palp_scene", 1 }, { "meshes", json::array({ { { "bundled", "block_30" } } }) } };
}

ScenePlan parse(const json& document)
{
  return parseScene(document.dump(), "/scenes/mine.json");
}

std::string refusal(const std::string& text)
{
  try
  {
    (void)parseScene(text, "/scenes/mine.json");
  }
  catch (const Error& error)
  {
    EXPECT_EQ(error.code(), ErrorCode::BadFile);
    return error.what();
  }
  return "accepted";
}

class SceneFile : public ::testing::Test
{
protected:
  SceneFile()
  {
    setenv("PALP_DATA", PALP_SHARE, 1);
  }
};

TEST_F(SceneFile, BuildsNothingThatIsNotNamed)
{
  json document = least();
  document["device"] = "path:press.csv";
  document["exports"] = { "samples" };
  document["dent"] = { { "surface", "none" } };
  const ScenePlan plan = parse(document);
  EXPECT_FALSE(plan.window || plan.dents() || plan.validity || plan.deformed || plan.picture);
  EXPECT_TRUE(plan.plots.empty());
  EXPECT_FALSE(plan.press.tissue.options.rated);
  EXPECT_EQ(plan.device.file, "/scenes/press.csv");
}

TEST_F(SceneFile, PlacesASurfaceByTurnsAboutFixedAxesAndAShift)
{
  json document = least();
  document["meshes"][0]["frame"] = { { "origin", { "10mm", "0mm", "-2cm" } },
    { "rotation", { "90deg", "0deg", "90deg" } } };
  const Eigen::Isometry3d frame = parse(document).meshes[0].frame();
  // y goes to z about x, and stays there about z; x goes to y about z
  EXPECT_TRUE((frame * Eigen::Vector3d::UnitY()).isApprox(Eigen::Vector3d(0.01, 0.0, 0.98), 1e-12));
  EXPECT_TRUE(
    (frame * Eigen::Vector3d::UnitX()).isApprox(Eigen::Vector3d(0.01, 1.0, -0.02), 1e-12));
}

TEST_F(SceneFile, TakesAMeasuredTissueByNameUnlessItSaysMore)
{
  json document = least();
  document["device"] = "mouse";
  document["tissue"] = { { "name", "hemangioma" } };
  TissueOptions tissue = parse(document).press.tissue;
  EXPECT_EQ(tissue.young, 13.8_kPa);
  EXPECT_EQ(tissue.poisson, 0.49);
  document["tissue"]["young"] = "9kPa";
  tissue = parse(document).press.tissue;
  EXPECT_EQ(tissue.young, 9.0_kPa);
  EXPECT_EQ(tissue.poisson, 0.49);
  document["tissue"]["name"] = "angioma";
  EXPECT_TRUE(refusal(document.dump())
                .starts_with("mine.json: /tissue/name: 'angioma' is not known; the nearest are "))
    << refusal(document.dump());
}

TEST_F(SceneFile, TakesLevelValuesOrLabelsOfAnImage)
{
  const auto with = [](const json& mesh)
  {
    json document = least();
    document["meshes"] = json::array({ mesh });
    return refusal(document.dump());
  };
  const std::string several = "mine.json: /meshes/0/label: more than one of level, values and ";
  EXPECT_TRUE(with({ { "file", "a" }, { "level", 1 }, { "label", 5 } }).starts_with(several));
  EXPECT_TRUE(with({ { "file", "a" }, { "level", 1 }, { "values", "1:2" } }).starts_with(several));
  EXPECT_TRUE(with({ { "file", "a" }, { "label", 1 }, { "values", "1:2" } }).starts_with(several));
  EXPECT_TRUE(with({ { "file", "a" }, { "values", "3:2" } })
                .starts_with("mine.json: /meshes/0/values: '3:2' is empty"));
}

TEST_F(SceneFile, NamesFileAndPathOfWhatIsWrong)
{
  const auto with = [](const char* patch)
  {
    json document = least();
    document.merge_patch(json::parse(patch));
    return refusal(document.dump());
  };
  const std::pair<const char*, const char*> cases[] = {
    { R"({"palp_scene": 2})", "mine.json: /palp_scene: must be 1" },
    { R"({"palp_scene": "1"})", "mine.json: /palp_scene: must be 1" },
    { R"({"tisue": {}})", "mine.json: /tisue: unknown key" },
    { R"({"tissue": {"youngs": "1kPa"}})", "mine.json: /tissue/youngs: unknown key" },
    { R"({"tissue": {"young": "50"}})", "mine.json: /tissue/young: " },
    { R"({"tissue": {"young": 50}})", "mine.json: /tissue/young: must be a text" },
    { R"({"tissue": {"poisson": 0.7}})", "mine.json: /tissue" },
    { R"({"tissue": {"damping": "-1N*s/m"}})", "mine.json: /tissue/damping: " },
    { R"({"tissue": {"coating": "2mm:50kPa:0.45"}})", "mine.json: /tissue/" },
    { R"({"tissue": {"coating": "2mm"}, "law": {"mode": "corrected"}})", "mine.json: /tissue/" },
    { R"({"tissue": {"relaxation": "0.5:1s"}})", "mine.json: /tissue/relaxation: the law 'paper'" },
    { R"({"tissue": {"relaxation": "0.5:1s", "friction": 1}})",
      "mine.json: /tissue/relaxation, friction: the law 'paper' knows none of these; take" },
    { R"({"tissue": {"friction": -1}})", "mine.json: /tissue/friction: '-1' is out of range" },
    { R"({"tissue": []})", "mine.json: /tissue: must be an object" },
    { R"({"tool": "hammer:1mm"})", "mine.json: /tool: " },
    { R"({"law": {"mode": "guess"}})", "mine.json: /law/mode: 'guess' is not known; give paper" },
    { R"({"law": {"validity": 1}})", "mine.json: /law/validity: must be true or false" },
    { R"({"meshes": []})", "mine.json: /meshes: give at least one" },
    { R"({"meshes": [{}]})", "mine.json: /meshes/0/file: give either" },
    { R"({"meshes": [{"file": "a.stl", "unit": "inch"}]})", "mine.json: /meshes/0/unit: " },
    { R"({"meshes": [{"file": "a.mha", "level": "high"}]})", "mine.json: /meshes/0/level: " },
    { R"({"meshes": [{"file": "a.mha", "label": "5,,7"}]})", "mine.json: /meshes/0/label: '5,,7'" },
    { R"({"meshes": [{"bundled": "liver", "frame": {"origin": ["1mm"]}}]})",
      "mine.json: /meshes/0/frame/origin: must be three" },
    { R"({"dent": {"layer": "thick"}})", "mine.json: /dent/layer: " },
    { R"({"dent": {"layer": "-5mm"}})", "mine.json: /dent/layer: '-5mm' is out of range" },
    { R"({"dent": {"threshold": "0mm"}})", "mine.json: /dent/threshold: '0mm' is out of range" },
    { R"({"meshes": [{"bundled": "liver", "frame": {"origin": ["1e300mm", "0m", "0m"]}}]})",
      "mine.json: /meshes/0/frame/origin: '1e300mm' is out of range" },
    { R"({"meshes": [{"bundled": "liver", "frame": {"rotation": ["1e9deg", "0deg", "0deg"]}}]})",
      "mine.json: /meshes/0/frame/rotation: '1e9deg' is out of range" },
    { R"({"overlays": ["halo"]})", "mine.json: /overlays: 'halo' is not known" },
    { R"({"plots": "force-time"})", "mine.json: /plots: must be a list" },
    { R"({"window": false})", "mine.json: /window: 'mouse' moves in a window only" },
    { R"({"dent": {"surface": "none"}})", "mine.json: /dent: 'none' leaves nothing to see" },
    { R"({"device": "path:a.csv"})", "mine.json: /exports: nothing would be left" },
    { R"({"exports": ["samples"]})", "mine.json: /exports: a window exports when asked" },
    { R"({"size": "10"})", "mine.json: /size: " },
  };
  for (const auto& [patch, message] : cases)
  {
    EXPECT_EQ(with(patch).substr(0, std::string(message).size()), message) << patch;
  }
  EXPECT_NE(
    refusal("{\n  \"palp_scene\": 1,\n}").find("mine.json: is no JSON, line 3"), std::string::npos);
  EXPECT_EQ(refusal(R"({"palp_scene": 1, "tool": "sphere:10mm", "tool": "sphere:3mm"})"),
    "mine.json: the key 'tool' stands twice in one object; keep one");
  const std::string huge = refusal(R"({"palp_scene": 1, "tissue": {"poisson": 1e999}})");
  EXPECT_EQ(huge.rfind("mine.json: number overflow", 0), 0U) << huge;
  EXPECT_EQ(refusal(R"({"a": {"a": 1}, "b": [{"a": 1}, {"a": 1}]})").find("twice"),
    std::string::npos); // one in each object
  EXPECT_NE(refusal("[]").find("mine.json: /: must be an object"), std::string::npos);
}

TEST_F(SceneFile, RefusesASecondHandThatCannotBe)
{
  for (const auto& [patch, message] :
    { std::pair(R"({"second_device": "mouse"})", "'mouse' follows the pointer"),
      std::pair(R"({"device": "falcon", "second_device": "falcon"})", "two hands cannot share"),
      std::pair(R"({"second_device": "path:"})", "'path:' names no file"),
      std::pair(
        R"({"device": "path:a.csv", "second_device": "falcon"})", "two hands press in a window") })
  {
    json document = least();
    document.merge_patch(json::parse(patch));
    const std::string told = refusal(document.dump());
    EXPECT_EQ(told.rfind("mine.json: /second_device: " + std::string(message), 0), 0U) << told;
  }
}

json organs()
{
  return json::parse(R"({"palp_scene": 1, "tissue": {"young": "7kPa"}, "organs": [
    {"name": "liver", "bundled": "liver", "tissue": {"poisson": 0.45}},
    {"name": "left kidney", "bundled": "sphere_30", "role": "show", "color": "#0a80ff",
     "tissue": {"name": "hcc", "damping": "2N*s/m"}},
    {"name": "skin", "file": "skin.vtp", "haptic": "less.vtp", "unit": "cm", "role": "through"}]})");
}

TEST_F(SceneFile, OrgansHaveEachARoleAColorAndATissue)
{
  const ScenePlan plan = parse(organs());
  ASSERT_EQ(plan.organs.size(), 3U);
  ASSERT_EQ(plan.meshes.size(), 3U);
  EXPECT_EQ(plan.meshes[2].file, "/scenes/skin.vtp");
  EXPECT_EQ(plan.meshes[2].haptic, "/scenes/less.vtp");
  EXPECT_EQ(plan.meshes[2].unit, LengthUnit::Centimeter);
  EXPECT_EQ(plan.organs[0].role, OrganRole::Press);
  EXPECT_EQ(plan.organs[0].press.tissue.young, 7.0_kPa) << "the scene's";
  EXPECT_EQ(plan.organs[0].press.tissue.poisson, 0.45);
  EXPECT_EQ(plan.organs[1].role, OrganRole::Show);
  EXPECT_EQ(plan.organs[1].color, (OrganColor{ 10, 128, 255 }));
  EXPECT_EQ(plan.organs[1].press.damping, 2.0);
  json alone = least();
  alone["tissue"] = { { "name", "hcc" } };
  EXPECT_EQ(plan.organs[1].press.tissue.young, parse(alone).press.tissue.young);
  EXPECT_EQ(plan.organs[2].role, OrganRole::Through);
  EXPECT_EQ(feltOrgans(plan.organs), std::vector<std::size_t>{ 0 });
}

TEST_F(SceneFile, NamesTheOrganThatIsWrong)
{
  const std::pair<const char*, const char*> cases[] = {
    { R"([{"op": "replace", "path": "/organs/0/role", "value": "show"}])",
      "mine.json: /organs: none is pressed" },
    { R"([{"op": "replace", "path": "/organs/1/name", "value": "liver"}])",
      "mine.json: /organs/1/name: 'liver' stands twice" },
    { R"([{"op": "remove", "path": "/organs/1/name"}])", "mine.json: /organs/1/name: must be" },
    { R"([{"op": "replace", "path": "/organs/1/name", "value": "a,b"}])",
      "mine.json: /organs/1/name: must be" },
    { R"([{"op": "replace", "path": "/organs/1/color", "value": "red"}])",
      "mine.json: /organs/1/color: 'red' is no color" },
    { R"([{"op": "replace", "path": "/organs/1/color", "value": "#12345"}])",
      "mine.json: /organs/1/color: '#12345' is no color" },
    { R"([{"op": "replace", "path": "/organs/1/color", "value": "#12345g"}])",
      "mine.json: /organs/1/color: '#12345g' is no color" },
    { R"([{"op": "replace", "path": "/organs/1/color", "value": "#+1-2 3"}])",
      "mine.json: /organs/1/color: '#+1-2 3' is no color" },
    { R"([{"op": "replace", "path": "/organs/1/role", "value": "felt"}])",
      "mine.json: /organs/1/role: 'felt' is not known" },
    { R"([{"op": "replace", "path": "/organs/1/tissue/name", "value": "angioma"}])",
      "mine.json: /organs/1/tissue/name: 'angioma' is not known" },
    { R"([{"op": "add", "path": "/organs/1/tissue/friction", "value": 0.2}])",
      "mine.json: /organs/1/tissue/friction: " },
    { R"([{"op": "remove", "path": "/organs/2/file"}])", "mine.json: /organs/2/file: give either" },
    { R"([{"op": "add", "path": "/organs/2/rôle", "value": "show"}])",
      "mine.json: /organs/2/rôle: unknown key" },
    { R"([{"op": "add", "path": "/meshes", "value": [{"bundled": "liver"}]}])",
      "mine.json: /organs: stands in place of meshes" },
    { R"([{"op": "replace", "path": "/organs", "value": []}])", "mine.json: /meshes: give" },
    { R"([{"op": "add", "path": "/organs/1/nodules", "value":
        [{"center": ["0mm", "0mm", "0mm"], "radius": "5mm", "ratio": 5}]}])",
      "mine.json: /organs/1: nodules take the law" },
    { R"([{"op": "add", "path": "/organs/1/nodules", "value": [{"radius": "5mm", "ratio": 5}]}])",
      "mine.json: /organs/1/nodules/0/center: is missing" },
    { R"([{"op": "add", "path": "/organs/1/nodules", "value":
        [{"center": ["0mm", "0mm", "0mm"], "ratio": 5}]}])",
      "mine.json: /organs/1/nodules/0/radius: is missing" },
    { R"([{"op": "add", "path": "/organs/1/nodules", "value":
        [{"center": ["0mm", "0mm", "0mm"], "radius": "5mm"}]}])",
      "mine.json: /organs/1/nodules/0/ratio: is missing" },
  };
  json document = organs();
  document["organs"][0]["role"] = "press";
  ASSERT_EQ(refusal(document.dump()), "accepted");
  for (const auto& [patch, expected] : cases)
  {
    const std::string message = refusal(document.patch(json::parse(patch)).dump());
    EXPECT_TRUE(message.starts_with(expected)) << message << "\n  where " << expected;
  }
}

// every key that the schema describes is one that the reader knows, at every level
void expectKnown(const json& properties, const json& base, const json::json_pointer& position)
{
  for (const auto& [key, schema] : properties.items())
  {
    json document = base;
    document[position / key] = json::array({ 7 }); // never right
    EXPECT_EQ(refusal(document.dump()).find("unknown key"), std::string::npos) << position / key;
    if (schema.contains("properties"))
    {
      json within = base;
      within[position / key] = json::object();
      expectKnown(schema["properties"], within, position / key);
    }
  }
}

TEST_F(SceneFile, ReaderKnowsWhatTheSchemaDescribes)
{
  const json schema = json::parse(test::readAll(PALP_SHARE "/scenes/scene.schema.json"));
  expectKnown(schema["properties"], least(), json::json_pointer());
  json mesh = least();
  expectKnown(
    schema["properties"]["meshes"]["items"]["properties"], mesh, json::json_pointer("/meshes/0"));
  expectKnown(schema["properties"]["organs"]["items"]["properties"], organs(),
    json::json_pointer("/organs/0"));
}

TEST_F(SceneFile, EveryShippedSceneIsWhole)
{
  for (const char* name : { "block_force", "paper_block", "paper_spheres", "liver_mouse",
         "liver_device", "liver_coated", "thin_lobe" })
  {
    const ScenePlan plan = readScene(name);
    EXPECT_FALSE(plan.name.empty());
    if (plan.device.isScript())
    {
      EXPECT_TRUE(std::filesystem::exists(plan.device.file)) << plan.device.name;
    }
  }
}

TEST_F(SceneFile, AMissingSceneNamesTheShippedOnes)
{
  try
  {
    (void)readScene("nowhere");
    FAIL();
  }
  catch (const Error& error)
  {
    EXPECT_NE(std::string(error.what()).find("liver_mouse"), std::string::npos) << error.what();
  }
}

} // namespace
} // namespace palp
