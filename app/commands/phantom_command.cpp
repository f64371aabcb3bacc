#include "app/commands/commands.h"
#include "app/input/coating_text.h"
#include "app/input/option_values.h"
#include "app/input/quantity.h"
#include "app/input/scene_plan.h"
#include "app/program/output.h"
#include "app/scene/scene_text.h"
#include "calibration/figures/table.h"
#include "data/phantoms.h"
#include "haptics/error.h"
#include "haptics/files/csv_text.h"
#include "haptics/files/input_text.h"
#include "haptics/files/replace_file.h"
#include "haptics/surface/area_and_volume.h"
#include "haptics/units.h"
#include "pipeline/model/poly_data.h"
#include "pipeline/surface_io/surface_io.h"

#include <CLI/CLI.hpp>

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <vtkPolyData.h>

namespace palp
{
namespace
{

using namespace units::literals;

const Words kPhantoms{ "block", "slab", "sphere", "liver" };

struct PhantomOptions
{
  std::size_t which = 0; // of kPhantoms
  std::filesystem::path out;
  double voxel = 1.0_mm;
  double seed = 1.0;
  bool overwrite = false;
};

Phantom phantomOf(const PhantomOptions& options)
{
  switch (options.which)
  {
    case 0:
      return blockPhantom();
    case 1:
      return slabPhantom();
    case 2:
      return spherePhantom();
    default:
      return liverPhantom(static_cast<unsigned>(options.seed));
  }
}

const std::string& labelOf(const PhantomPart& part)
{
  return part.label.empty() ? part.name : part.label;
}

// a label map, voxel by voxel
struct LabelMap
{
  std::array<std::size_t, 3> size{};
  Eigen::Vector3d origin = Eigen::Vector3d::Zero(); // middle of the first voxel [m]
  std::string voxels;                               // a byte each, x fastest
  std::vector<std::size_t> counts;                  // of each label from 1
};

LabelMap labelMapOf(const Phantom& phantom, double voxel)
{
  LabelMap map;
  std::size_t all = 1;
  constexpr std::size_t most = 1ULL << 30U;
  for (std::size_t k = 0; k < 3; ++k)
  {
    const auto axis = static_cast<Eigen::Index>(k);
    map.size[k] =
      static_cast<std::size_t>(std::ceil((phantom.high[axis] - phantom.low[axis]) / voxel));
    all *= map.size[k];
  }
  if (all > most)
  {
    throw Error(ErrorCode::BadValue,
      "--voxel: " + std::to_string(all >> 20U) + " million voxels are too many; give larger ones");
  }
  map.origin = phantom.low + Eigen::Vector3d::Constant(0.5 * voxel);
  map.voxels.reserve(all);
  map.counts.resize(phantom.parts.size());
  for (std::size_t i = 0; i < all; ++i)
  {
    const std::size_t row = i / map.size[0];
    const std::size_t slice = row / map.size[1];
    // a middle that lies in a face belongs to one side of a body, not to both or none
    constexpr double kAside = 1e-6;
    const Eigen::Vector3d at = map.origin +
      voxel *
        Eigen::Vector3d(static_cast<double>(i % map.size[0]) + kAside,
          static_cast<double>(row % map.size[1]) + kAside, static_cast<double>(slice) + kAside);
    std::size_t label = 0;
    for (std::size_t part = 0; part < phantom.parts.size(); ++part)
    {
      label = phantom.parts[part].distance(at) < 0.0 ? part + 1 : label;
    }
    map.voxels.push_back(static_cast<char>(label));
    label > 0 ? void(++map.counts[label - 1]) : void();
  }
  return map;
}

// MetaImage in the patient's axes, which are those of the phantom
std::string imageOf(const LabelMap& map, double voxel)
{
  const auto triple = [](auto x, auto y, auto z)
  {
    const auto text = [](auto value) { return shortest(static_cast<double>(value)); };
    return text(x) + " " + text(y) + " " + text(z) + "\n";
  };
  const double side = units::toMillimeters(voxel);
  const Eigen::Vector3d origin = map.origin / 1.0_mm;
  return "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\n"
         "CompressedData = False\nTransformMatrix = 1 0 0 0 1 0 0 0 1\nOffset = " +
    triple(origin.x(), origin.y(), origin.z()) +
    "CenterOfRotation = 0 0 0\nAnatomicalOrientation = RAI\nDistanceUnits = mm\nElementSpacing = " +
    triple(side, side, side) + "DimSize = " + triple(map.size[0], map.size[1], map.size[2]) +
    "ElementType = MET_UCHAR\nElementDataFile = LOCAL\n" + map.voxels;
}

// as 3D Slicer reads names and colors
std::string colorsOf(const Phantom& phantom)
{
  constexpr std::array colors{ "221 130 101", "180 60 60", "145 30 0" };
  std::string text = "# number name red green blue alpha\n0 background 0 0 0 0\n";
  for (std::size_t i = 0; i < phantom.parts.size(); ++i)
  {
    text += std::to_string(i + 1) + " " + labelOf(phantom.parts[i]) + " " +
      colors[i % colors.size()] + " 255\n";
  }
  return text;
}

// presses the first part by mouse, with what lies in it
ScenePlan planOf(const Phantom& phantom, const std::filesystem::path& folder)
{
  ScenePlan plan{ .name = "Phantom: " + phantom.parts.front().name };
  MeshSource& mesh = plan.meshes.front();
  mesh.bundled.clear();
  mesh.file = folder / (phantom.parts.front().name + ".vtp");
  for (const PhantomNodule& nodule : phantom.nodules)
  {
    constexpr double ratio = 7.7; // of a hepatocellular carcinoma to healthy liver
    mesh.nodules.push_back({ nodule.center, nodule.radius, ratio });
  }
  plan.press.tissue.young = 6.5_kPa;
  const bool isLayered = phantom.parts.front().name == "slab";
  if (isLayered)
  {
    plan.press.tissue.options.coatings = parseCoatings("2mm:20kPa:0.45,10mm:5kPa:0.48");
  }
  const bool isPlain = phantom.nodules.empty() && !isLayered;
  plan.press.tissue.options.mode = isPlain ? LawMode::Paper : LawMode::Corrected;
  return plan;
}

// a part's surface has the others in it, its label has not
std::string tableOf(const Phantom& phantom, const LabelMap& map, double voxel)
{
  figures::Table table{ .name = "phantom",
    .caption = "Parts",
    .columns = { "label", "name", "voxels", "label_ml", "file", "surface_ml" } };
  for (std::size_t i = 0; i < phantom.parts.size(); ++i)
  {
    const PhantomPart& part = phantom.parts[i];
    const double labeled = static_cast<double>(map.counts[i]) * voxel * voxel * voxel;
    const double enclosed = enclosedVolume(part.surface.points, part.surface.triangles);
    table.rows.push_back({ std::to_string(i + 1), labelOf(part), std::to_string(map.counts[i]),
      units::toMilliliters(labeled), part.name + ".vtp", units::toMilliliters(enclosed) });
  }
  constexpr int digits = 5;
  return figures::csv(table, digits);
}

// of parts that lie within the first, as all phantoms here
void warnOfCoarseVoxels(const Phantom& phantom, const LabelMap& map, double voxel)
{
  for (std::size_t i = 0; i < phantom.parts.size(); ++i)
  {
    const auto volumeOf = [](const Mesh& mesh)
    { return enclosedVolume(mesh.points, mesh.triangles); };
    double exact = volumeOf(phantom.parts[i].surface);
    for (std::size_t k = 1; k < phantom.parts.size() && i == 0; ++k)
    {
      exact -= volumeOf(phantom.parts[k].surface);
    }
    constexpr double kMost = 0.05;
    const double labeled = static_cast<double>(map.counts[i]) * voxel * voxel * voxel;
    if (std::abs(labeled - exact) > kMost * exact)
    {
      std::cerr << "palp: warning: at this size of voxels " << labelOf(phantom.parts[i]) << " has "
                << figures::textOf(labeled / exact, 2)
                << " of its volume; its surface is exact, or take finer ones\n";
    }
  }
}

void runPhantom(const PhantomOptions& options)
{
  const Phantom phantom = phantomOf(options);
  const std::string image = kPhantoms[options.which] + ".mha";
  const std::string colors = kPhantoms[options.which] + ".ctbl";
  std::vector<std::string> own{ image, colors, "scene.json" };
  for (const PhantomPart& part : phantom.parts)
  {
    own.push_back(part.name + ".vtp");
  }
  Outputs outputs;
  OutputFolder& output = outputs.open(options.out, own, options.overwrite);
  const LabelMap map = labelMapOf(phantom, options.voxel);
  for (const PhantomPart& part : phantom.parts)
  {
    writeSurface(output.stage() / (part.name + ".vtp"),
      *makePolyData(part.surface.points, part.surface.triangles), "LPS");
  }
  replaceFile(output.stage() / image, imageOf(map, options.voxel));
  replaceFile(output.stage() / colors, colorsOf(phantom));
  replaceFile(
    output.stage() / "scene.json", sceneText(planOf(phantom, output.stage()), output.stage()));
  output.publish();
  warnOfCoarseVoxels(phantom, map, options.voxel);
  std::cout << tableOf(phantom, map, options.voxel);
}

} // namespace

void addPhantomCommand(CLI::App& app)
{
  auto options = std::make_shared<PhantomOptions>();
  PhantomOptions* all = options.get();
  CLI::App* command = app.add_subcommand("phantom",
    "Make a body that is known exactly, as surfaces, label map and scene, to teach and to test");
  addWord(*command, "NAME", "block, slab, sphere or liver", kPhantoms, 0,
    [all](std::size_t which) { all->which = which; })
    ->required();
  command->add_option("--out", options->out, "Folder for it")->required();
  addParsed(*command, "--voxel", "Side of the label map's voxels", "1mm",
    [all](const std::string& text)
    {
      all->voxel =
        parseWithin(text, Quantity::Length, { 0.2_mm, 20.0_mm, "0.2mm to 20mm" }, "--voxel");
    });
  addParsed(*command, "--seed", "Of the nodules' places in liver, 0 to 4294967295", "1",
    [all](const std::string& text)
    {
      all->seed = parseNumber(text, "--seed");
      if (!(all->seed >= 0.0 && all->seed < 4294967296.0) || all->seed != std::floor(all->seed))
      {
        throw Error(ErrorCode::BadValue,
          "--seed: " + inQuotes(text) +
            " is out of range; give a whole number from 0 to 4294967295");
      }
    });
  addOverwrite(*command, options->overwrite);
  command->footer(
    "block: the paper's, 100 x 100 x 50 mm; slab: liver under 10 mm of fat under 2 mm of skin;\n"
    "sphere: of 30 mm; liver: the bundled one with vessels and five nodules.\n"
    "Writes NAME.mha (label map, LPS), NAME.ctbl (the labels' names, as 3D Slicer reads them), a\n"
    "surface for each label, and scene.json, which palp scene opens.\n"
    "Examples:\n"
    "  palp phantom liver --out phantom && palp scene phantom/scene.json\n"
    "  palp phantom slab --voxel 0.5mm --out slab\n"
    "  palp run phantom/liver.mha --label 1,2,3 --at -48.5,38.4,39.5 --out pressed");
  command->callback([options] { runPhantom(*options); });
}

} // namespace palp
