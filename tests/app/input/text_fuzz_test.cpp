#include "app/curves/force_curve.h"
#include "app/input/tip_text.h"
#include "app/places/fiducial_file.h"
#include "app/press/force_history.h"
#include "app/scene/scene_file.h"
#include "app/sweep/sweep_file.h"
#include "calibration/tables/extent_table.h"
#include "calibration/tables/surface_table.h"
#include "haptics/devices/simulated/scripted_path.h"
#include "haptics/error.h"
#include "haptics/force/force_law.h"
#include "haptics/force/large_strain.h"
#include "pipeline/deform/fitted_surfaces.h"
#include "tests/support/fuzz.h"
#include "tests/support/process.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <iterator>
#include <stdexcept>

namespace palp::test
{
namespace
{

void expectFinite(double value)
{
  if (!std::isfinite(value))
  {
    throw std::runtime_error("a number that is not finite came through");
  }
}

void takePath(const std::string& file)
{
  const ScriptedPath path = readPath(file);
  for (int i = 0; i <= 20; ++i)
  {
    const ToolPose pose =
      path.poseAt(path.startTime() + 0.05 * i * path.duration(), -Eigen::Vector3d::UnitZ());
    expectFinite(pose.apex.norm() + pose.axis.norm());
  }
}

void takeHistory(const std::string& file)
{
  const auto linear = [](double depth) { return ElasticForce{ 1e3 * depth, 1e3 }; };
  for (const double force : forcesOver(linear, {}, readForceHistory(file)))
  {
    expectFinite(force);
  }
}

void takeProfile(const std::string& file)
{
  const ForceLaw law(parseTip("profile:" + file), { 50e3, 0.33 }, { .mode = LawMode::Exact });
  for (int i = 1; i <= 20; ++i)
  {
    expectFinite(law({ .depth = 0.0005 * i }).force);
  }
}

void takeCurve(const std::string& file)
{
  const ReferenceCurve curve = readForceCurve(file);
  for (std::size_t i = 0; i < curve.x.size(); ++i)
  {
    expectFinite(curve.x[i] + curve.y[i]);
  }
}

void takeExtents(const std::string& file)
{
  const ExtentTable table = ExtentTable::read(file);
  for (int i = 0; i <= 20; ++i)
  {
    expectFinite(table.extentRadius(0.001 * i));
  }
}

void takeSurfaces(const std::string& file)
{
  (void)FittedSurfaces::read(file);
}

void takeScene(const std::string& file)
{
  (void)readScene(file);
}

void takeSweep(const std::string& file)
{
  (void)readSweepFile(file);
}

void takePoints(const std::string& file)
{
  for (const PressPlace& place : readFiducials(file).places)
  {
    expectFinite(place.position.norm());
  }
}

const std::string kData = PALP_SOURCE_DIR "/data/";
const std::string kNumber = "not a number|not numbers|not finite|finite number";

std::vector<Fault> tableFaults()
{
  const std::string columns = "columns|column";
  const std::string header = "header|column|not a number";
  return { replaced("word", "(\n)[0-9.]+(,)", "$01one$2", kNumber),
    replaced("NaN", "(\n[0-9.]+,)[-0-9.e]+", "$01nan", kNumber),
    replaced("infinite", "(\n[0-9.]+,)[-0-9.e]+", "$01inf", kNumber),
    replaced("row too short", "(\n[-0-9.e]+),[-0-9.e]+", "$1", columns + "|" + header),
    replaced("row too long", "(\n[-0-9.e]+)(,[-0-9.e]+)", "$1$2$2", columns),
    foreign("solid corner\nfacet normal 0 0 1\n", "header|not a number|column") };
}

std::vector<Fuzzed> fuzzedTables()
{
  const std::vector<Fault> ofTables = tableFaults();
  std::vector<Fault> ofCurves = ofTables; // columns that nobody asks for may hold anything
  ofCurves[0] = replaced("word", ",[0-9.]+\n", ",one\n", kNumber);
  ofCurves[1] = replaced("NaN", ",[0-9.]+\n", ",nan\n", kNumber);
  ofCurves[2] = replaced("infinite", ",[0-9.]+\n", ",inf\n", kNumber);
  const auto with = [&](Fault fault)
  {
    std::vector<Fault> faults = ofTables;
    faults.push_back(std::move(fault));
    return faults;
  };
  const std::string recording =
    "# palp\ntime_s,tool_x_mm,tool_y_mm,tool_z_mm,axis_x,axis_y,axis_z,depth_mm,force_N\n"
    "0,0,0,2,0,0,-1,0,0\n0.5,0,0,0,0,0,-1,1,0.5\n1,0,0,-2,0,0,-1,2,1.4\n";
  const Fault order =
    replaced("order", "\n(0\\.5|1|1\\.0|2\\.4),", "\n-3,", "increase|order|ascend");
  const std::string profile = "radius_mm,height_mm\n0,0\n1,0.05\n2,0.21\n3,0.5\n4,0.9\n5,1.5\n";
  std::vector<Fault> ofHistories = ofCurves; // the time is the first column
  ofHistories[0] = replaced("word", "\n0\\.5,", "\none,", kNumber);
  ofHistories[1] = replaced("NaN", "\n0\\.5,", "\nnan,", kNumber);
  ofHistories[2] = replaced("infinite", "\n0\\.5,", "\ninf,", kNumber);
  ofHistories.push_back(replaced("order", "\n1,", "\n0.25,", "increase"));
  ofHistories.push_back(replaced("before", "\n0\\.5,", "\n-3,", "times of 0 or more"));
  return { { .file = "path.csv",
             .whole = { readAll(kData + "paths/block_press.csv"), "0,0,0,2\n1,0,0,-1\n2,0,0,1\n" },
             .faults = with(order),
             .read = {},
             .take = takePath },
    { .file = "samples.csv",
      .whole = { recording },
      .faults = with(order),
      .read = {},
      .take = takePath },
    { .file = "history.csv",
      .whole = { recording, "time_s,depth_mm\n0,-1\n0.5,1\n1,2\n2.4,0\n" },
      .faults = ofHistories,
      .read = {},
      .take = takeHistory },
    { .file = "curve.csv",
      .whole = { recording, "depth_mm,force_N\n0,0\n1,0.5\n2,1.4\n" },
      .faults = ofCurves,
      .read = {},
      .take = takeCurve },
    { .file = "profile.csv",
      .whole = { profile },
      .faults = with(replaced("order", "\n2,", "\n9,", "increase|order|turns inward")),
      .read = {},
      .take = takeProfile },
    { .file = "extents.csv",
      .whole = { readAll(kData + "tables/sphere_r10_h50.csv") },
      .faults = ofTables,
      .read = {},
      .take = takeExtents },
    { .file = "surface.csv",
      .whole = { readAll(kData + "tables/sphere_r10_h50_surface.csv") },
      .faults = ofTables,
      .read = {},
      .take = takeSurfaces } };
}

// of presses at places, and of several organs, beside what any scene may have
Fuzzed fuzzedPresses(std::vector<Fault> faults)
{
  const std::string presses = R"({"palp_scene": 1, "meshes": [{"bundled": "liver"}],
    "tissue": {"young": "20kPa"}, "tool": "sphere:6mm", "presses": {"places":
    [{"name": "back", "at": ["-48.5mm", "38.4mm", "39.5mm"]}, {"at": ["-14.8mm", "-3.6mm",
    "77.5mm"]}], "depth": "3mm", "speed": "20mm/s", "toward": "0,0,-1"}, "exports": ["samples"]})";
  faults.push_back(replaced("place", "\"(-48.5|77.5)mm\"", "\"$1\"", "/presses/places/"));
  faults.push_back(replaced("no place", "\"at\"", "\"xat\"", "/at: missing"));
  faults.push_back(replaced("depth", "\"3mm\"", "\"3mn\"", "/presses/depth"));
  faults.push_back(replaced("speed", "\"20mm/s\"", "\"-20mm/s\"", "/presses/speed"));
  faults.push_back(replaced("direction", "\"0,0,-1\"", "\"0,0,0\"", "/presses/toward"));
  faults.push_back(replaced("two", "\"exports\"", "\"device\": \"hand\", \"exports\"", "/device"));
  return { .file = "presses.json",
    .whole = { presses },
    .faults = std::move(faults),
    .read = {},
    .take = takeScene };
}

Fuzzed fuzzedOrgans(std::vector<Fault> faults)
{
  const std::string organs = R"({"palp_scene": 1, "tissue": {"young": "7kPa"}, "tool": "sphere:6mm",
    "organs": [{"name": "liver", "bundled": "liver", "tissue": {"poisson": 0.45}},
    {"name": "kidney", "bundled": "sphere_30", "role": "show", "color": "#0a80ff",
    "tissue": {"name": "hcc", "damping": "2N*s/m"}},
    {"name": "skin", "file": "skin.vtp", "haptic": "less.vtp", "unit": "cm", "role": "through"}]})";
  faults.push_back(replaced("role", "\"(show|through)\"", "\"$1s\"", "/role"));
  faults.push_back(replaced("color", "#0a80ff", "#0a80fg", "/organs/1/color"));
  faults.push_back(replaced("twice", "\"(kidney|skin)\"", "\"liver\"", "stands twice"));
  faults.push_back(replaced("name", "\"(kidney|skin)\"", "\"a,b\"", "/name: must be"));
  faults.push_back(replaced("two", "\"organs\"",
    "\"meshes\": [{\"bundled\": \"liver\"}], \"organs\"", "stands in place of meshes"));
  return { .file = "organs.json",
    .whole = { organs },
    .faults = std::move(faults),
    .read = {},
    .take = takeScene };
}

std::vector<Fuzzed> fuzzedJson()
{
  const std::string scene = readAll(kData + "scenes/liver_coated.json");
  const std::vector<Fault> ofJson{ cutOff("line [0-9]+, column|parse|not a list", 2),
    replaced("comma", "\",(\\s)", "\";$1", "line [0-9]+, column|not a list"),
    foreign("time_s,x_mm\n0,1\n", "line [0-9]+, column|not a list") };
  std::vector<Fault> ofScenes = ofJson;
  ofScenes.push_back(replaced(
    "key", "\"(tool|law|dent|device|meshes|tissue)\"", "\"x$1\"", "unknown key|at least one"));
  ofScenes.push_back(replaced("type", "(\"tool\": )\"[^\"]*\"", "$1[1]", "must be a text"));
  ofScenes.push_back(replaced("version", "(\"palp_scene\": )1", "$012", "palp_scene"));
  ofScenes.push_back(replaced("unit", "kPa\"", "kPq\"", "/tissue"));
  ofScenes.push_back(replaced("tool", "\"sphere:", "\"spore:", "/tool"));
  std::vector<Fault> ofSweeps = ofJson;
  ofSweeps.push_back(
    replaced("key", "\"(fixed|grid|plots|from|title)\"", "\"x$1\"", "unknown key|no number"));
  ofSweeps.push_back(replaced("version", "(\"palp_sweep\": )1", "$012", "palp_sweep"));
  ofSweeps.push_back(replaced("kind", "\"(calibrate|run)\"", "\"$1s\"", "/kind"));
  ofSweeps.push_back(replaced("type", "(\"grid\": )", "$1[1], \"other\": ", "must be an object"));
  return { { .file = "scene.json",
             .whole = { scene, readAll(kData + "scenes/thin_lobe.json") },
             .faults = ofScenes,
             .read = {},
             .take = takeScene },
    fuzzedPresses(ofScenes), fuzzedOrgans(ofScenes),
    { .file = "sweep.json",
      .whole = { readAll(kData + "sweeps/extent.json"),
        readAll(kData + "sweeps/stiffness_map.json") },
      .faults = ofSweeps,
      .read = {},
      .take = takeSweep } };
}

// lists of points as 3D Slicer writes them
std::vector<Fuzzed> fuzzedPoints()
{
  const std::string table = "# Markups fiducial file version = 4.11\n# CoordinateSystem = LPS\n"
                            "# columns = id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc\n"
                            "a,-45.5,12.25,30,0,0,0,1,1,1,0,F-1,\nb,1,-2,3,0,0,0,1,1,1,0,F-2,\n";
  const std::string markups = R"({"markups": [{"type": "Fiducial", "coordinateSystem": "LPS",
    "coordinateUnits": "mm", "controlPoints": [
    {"id": "1", "label": "F-1", "position": [-45.5, 12.25, 30.0], "positionStatus": "defined"},
    {"id": "2", "label": "F-2", "position": [1.0, -2.0, 3.0]}]}]})";
  const Fault axes = replaced("axes", "LPS", "LPX", "the axes are");
  return { { .file = "points.fcsv",
             .whole = { table },
             .faults = { axes, replaced("word", "(\n[ab],)[-0-9.]+", "$1one", kNumber),
               replaced("NaN", "(\n[ab],)[-0-9.]+", "$1nan", kNumber),
               replaced("far", "(\n[ab],)[-0-9.]+", "$0199999", "farther"),
               foreign("solid corner\nfacet normal 0 0 1\n", "axes") },
             .read = {},
             .take = takePoints },
    { .file = "points.mrk.json",
      .whole = { markups },
      .faults = { axes, replaced("unit", "\"mm\"", "\"m\"", "the unit is"),
        replaced("key", "\"(markups|controlPoints)\"", "\"x$1\"", "no list"),
        replaced("type", "(\"position\": )\\[[^\\]]*\\]", "$1[1, 2]", "three numbers"),
        cutOff("line [0-9]+, column|parse", 2) },
      .read = {},
      .take = takePoints } };
}

// every kind of text that the program reads itself
const std::vector<Fuzzed>& fuzzedTexts()
{
  static const std::vector<Fuzzed> all = []
  {
    std::vector<Fuzzed> every = fuzzedTables();
    std::ranges::move(fuzzedJson(), std::back_inserter(every));
    std::ranges::move(fuzzedPoints(), std::back_inserter(every));
    return every;
  }();
  return all;
}

constexpr std::size_t kFuzzedTexts = 13;

class Fuzz : public testing::TestWithParam<std::size_t>
{
};
INSTANTIATE_TEST_SUITE_P(Texts, Fuzz, testing::Range<std::size_t>(0, kFuzzedTexts),
  [](const auto& which) { return nameOf(fuzzedTexts()[which.param].file); });

TEST_P(Fuzz, EndsAsNumbersOrATrueSentence)
{
  const Fuzzed& kind = fuzzedTexts()[GetParam()];
  constexpr std::size_t memory = 1U << 30;
  constexpr double time = 5.0; // [s]
  expectGoodFates(kind, fuzz(kind, fuzzCount(4000), memory, time));
}

} // namespace
} // namespace palp::test
