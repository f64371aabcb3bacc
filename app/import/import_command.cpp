#include "app/import/import_command.h"

#include "app/import/import_files.h"
#include "app/import/organ_look.h"
#include "app/import/organ_names.h"
#include "app/input/option_values.h"
#include "app/input/press_options.h"
#include "app/input/quantity.h"
#include "app/program/output.h"
#include "app/program/progress_line.h"
#include "calibration/figures/table.h"
#include "haptics/error.h"
#include "haptics/files/csv_text.h"
#include "haptics/files/input_text.h"
#include "haptics/files/listed.h"
#include "haptics/files/replace_file.h"
#include "haptics/units.h"
#include "pipeline/surface_io/label_names.h"
#include "pipeline/surface_io/surface_io.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <string_view>

namespace palp
{
namespace
{

using units::toMilliliters;
using units::toMillimeters;

constexpr int kDigits = 5; // that are printed

struct ImportOptions
{
  std::filesystem::path image;
  ImagePart part;
  UnitChoice unit;
  std::filesystem::path names;
  std::filesystem::path out; // empty: the labels are only listed
  bool overwrite = false;

  [[nodiscard]] std::string line(const std::string& which) const
  {
    return "palp import " + image.string() + " " + which + " --out " +
      (out.empty() ? "DIR" : out.string()) + "\n";
  }
};

void tell(const std::string& what)
{
  std::cerr << "palp: " << printable(what) << '\n';
}

std::size_t parseComponents(const std::string& text)
{
  if (text == "all" || text == "largest")
  {
    return text == "all" ? ImagePart::kAllComponents : 1;
  }
  const double count = parseNumber(text, "--components");
  constexpr double most = 1e6;
  if (!(count >= 1.0 && count <= most) || count != static_cast<double>(static_cast<int>(count)))
  {
    throw Error(ErrorCode::BadValue,
      "--components: " + inQuotes(text) + " is not in range; give largest, all, or 1 to 1000000");
  }
  return static_cast<std::size_t>(count);
}

std::string listOf(const FileOrgans& found, UnitChoice known)
{
  figures::Table table{
    .name = "labels", .caption = "Labels", .columns = { "label", "name", "voxels", "volume_ml" }
  };
  for (const FileOrgan& organ : found.organs)
  {
    const double length = known ? unitLength(*known) : 0.0;
    table.rows.push_back({ organ.label, organ.name, std::to_string(organ.voxels),
      known ? figures::Cell(toMilliliters(length * length * length * organ.voxelVolume))
            : figures::Cell(std::string()) });
  }
  return figures::csv(table, kDigits);
}

// what may be meant of a gray image, as commands
std::string proposals(const FileOrgans& found, const ImportOptions& options)
{
  // Hounsfield units go from air, -1000, to bone and metal
  if (!(found.low <= -500.0 && found.high >= 300.0))
  {
    return options.line("--level " + figures::textOf(0.5 * (found.low + found.high), 3));
  }
  return "# by Hounsfield units, where it is a CT: bone, the skin with all in it, soft tissue\n" +
    options.line("--threshold 200:3071") + options.line("--threshold -300:3071") +
    options.line("--threshold 0:100");
}

std::string tableOf(const std::vector<ImportedOrgan>& organs)
{
  figures::Table table{ .name = "import",
    .caption = "Organs",
    .columns = { "label", "name", "file", "voxels", "voxels_ml", "surface_ml",
      "smoothing_changed_percent", "points", "deviation_mm", "deviation_rms_mm", "haptic_points",
      "haptic_deviation_mm", "haptic_deviation_rms_mm" } };
  const auto add = [](std::vector<figures::Cell>& row, const OrganLevel& level)
  {
    row.insert(row.end(),
      { std::to_string(level.points), toMillimeters(level.apart.largest),
        toMillimeters(level.apart.rootMeanSquare) });
  };
  for (const ImportedOrgan& organ : organs)
  {
    constexpr double kPercent = 100.0;
    std::vector<figures::Cell> row{ organ.label, organ.name, organ.file + ".vtp",
      std::to_string(organ.voxels), toMilliliters(organ.voxelVolume), toMilliliters(organ.volume),
      kPercent * (organ.volume / organ.enclosed - 1.0) };
    add(row, organ.shown);
    if (organ.felt)
    {
      add(row, *organ.felt);
    }
    row.resize(table.columns.size(), std::string());
    table.rows.push_back(std::move(row));
  }
  return figures::csv(table, kDigits);
}

// tissues, and which organs are not felt, as the scene has them by their names
void tellLooks(const std::vector<ImportedOrgan>& organs)
{
  std::vector<std::string> names(organs.size());
  std::ranges::transform(organs, names.begin(), &ImportedOrgan::name);
  const std::vector<OrganLook> looks = looksOf(names);
  std::string tissues;
  std::string unfelt;
  for (std::size_t i = 0; i < looks.size(); ++i)
  {
    const auto& [role, color, tissue] = looks[i];
    tissue != nullptr ? addListed(tissues, names[i] + " as " + tissue) : void();
    const std::string_view how = role;
    how != "press"
      ? addListed(unfelt, names[i] + (how == "show" ? " (only shown)" : " (see-through)"))
      : void();
  }
  tell("tissues in scene.json: " + tissues + (tissues.empty() ? "" : ", by their names; ") +
    "else the default, 50 kPa");
  unfelt.empty() ? void()
                 : tell("not pressed in scene.json, by their names: " + unfelt +
                     "; \"role\": \"press\" is felt");
}

FileOrgans found(const ImportOptions& options)
{
  const ProgressLine progress("reading " + printable(options.image.filename().string()));
  FileOrgans organs = options.out.empty() ? readFileOrgans(options.image, options.part, true)
                                          : readFileOrgansAt(options.image, options.part, {});
  for (const std::string& note : organs.notes)
  {
    tell(note);
  }
  if (organs.organs.empty())
  {
    std::cout << proposals(organs, options);
    if (!options.out.empty())
    {
      throw Error(ErrorCode::BadValue,
        options.image.string() + ": an image, no label map, of values from " +
          figures::textOf(organs.low, kDigits) + " to " + figures::textOf(organs.high, kDigits) +
          "; tell what of it is the body by --threshold or --level, as in the lines above, or by "
          "--label where its values are labels");
    }
  }
  return organs;
}

// where the image gives none
void colorAs(std::vector<FileOrgan>& organs, const std::filesystem::path& names)
{
  const auto colors = names.empty() ? std::map<double, std::string>() : readLabelColors(names);
  for (FileOrgan& organ : organs)
  {
    const auto found = colors.find(csvNumber(organ.label).value_or(-1.0)); // 2+3 is none
    organ.color = organ.color.empty() && found != colors.end() ? found->second : organ.color;
  }
}

// stamps: those of the image before the organs were read
ImportSource sourceOf(
  const ImportOptions& options, const FileStamps& stamps, const FileOrgans& organs, LengthUnit unit)
{
  ImportSource source{ .file = options.image,
    .stamps = stamps,
    .image = describeFile(options.image),
    .names = options.names.filename() };
  source.image.unit = unitName(unit);
  source.image.space = organs.space;
  source.image.part = options.part;
  checkUnchanged(options.image, stamps); // the hash is of what was read
  return source;
}

std::vector<std::string> surfaceFiles(const std::vector<std::string>& organs)
{
  std::vector<std::string> files;
  for (const std::string& organ : organs)
  {
    files.push_back(organ + ".vtp");
    files.push_back(organ + kHaptic + ".vtp");
  }
  return files;
}

void runImport(const ImportOptions& options)
{
  if (options.out.empty())
  {
    const FileOrgans organs = found(options);
    std::string note;
    const UnitChoice unit = unitOfList(organs, options.unit, options.image, note);
    note.empty() ? void() : tell(note);
    std::cout << (organs.organs.empty() ? "" : listOf(organs, unit));
    return;
  }
  Outputs outputs;
  OutputFolder& output = outputs.open(
    options.out, importFiles(options.out), options.overwrite, filesBehind(options.image));
  const FileStamps stamps = stampsOf(options.image);
  FileOrgans all = found(options);
  std::vector<std::string> warnings;
  colorAs(all.organs, options.names);
  const LengthUnit unit = unitOf(all, options.unit, options.image, warnings);
  const ImportSource source = sourceOf(options, stamps, all, unit);
  std::vector<std::string> files;
  nameFiles(all.organs, files, std::filesystem::canonical(options.image).stem().stem().string());
  expectOutput(output, surfaceFiles(files));
  ProgressLine progress("organs");
  progress(0, files.size());
  std::vector<ImportedOrgan> organs = importedOrgans(std::move(all), files, source, unit,
    output.stage(), [&](std::size_t done) { progress(done, files.size()); });
  for (const ImportedOrgan& organ : organs)
  {
    for (const std::string& warning : organ.warnings)
    {
      warnings.push_back(organ.name + ": " + warning);
    }
  }
  std::erase_if(organs, [](const ImportedOrgan& organ) { return organ.shown.points == 0; });
  if (organs.empty())
  {
    throw Error(ErrorCode::BadMesh,
      printable(options.image.string()) + ": no label of it is a body; " + warnings.front());
  }
  replaceFile(output.stage() / kImportScene, importScene(source, organs));
  replaceFile(output.stage() / kImportManifest, importManifest(source, organs));
  output.publish();
  for (const std::string& warning : warnings)
  {
    tell("warning: " + warning);
  }
  tellLooks(organs);
  std::cout << tableOf(organs);
}

void addParts(CLI::App& command, ImportOptions& options)
{
  ImagePart* part = &options.part;
  addParsed(command, "--names",
    "Table of the labels' names and colors: of 3D Slicer, ITK-SNAP, or JSON as of TotalSegmentator",
    "",
    [&options](const std::string& text)
    {
      options.names = text;
      options.part.names = readLabelNames(text);
    });
  auto* label = addParsed(command, "--label",
    "Labels of a label map, by value or name with commas, each an organ of its own; 1+2 are one, "
    "named as the first",
    "all",
    [part](const std::string& text)
    {
      part->labels = text == "all" ? decltype(part->labels)()
                                   : valuesOfLabels(parseLabels(text, "--label"), part->names);
    });
  auto* band = addParsed(command, "--threshold",
    "Of any other image: all with values LOW:HIGH, of a CT in Hounsfield units", "",
    [part](const std::string& text) {
      part->band = parseBand(text, "--threshold");
    })->excludes(label);
  addParsed(command, "--level", "or what is above one value", "",
    [part](const std::string& text) { part->level = parseNumber(text, "--level"); })
    ->excludes(label)
    ->excludes(band);
  addParsed(command, "--series",
    "Which one where IN is a folder of several DICOM series: its place in the list, or its UID", "",
    [part](const std::string& text) { part->series = text; });
  addParsed(command, "--components",
    "How many pieces of each: largest, all of eight voxels or more, or a number", "largest",
    [part](const std::string& text) { part->components = parseComponents(text); });
}

} // namespace

void addImportCommand(CLI::App& app)
{
  auto options = std::make_shared<ImportOptions>();
  CLI::App* command = app.add_subcommand("import",
    "Make organs of a segmentation or a scan: smooth closed surfaces and a scene that opens them");
  command
    ->add_option("IN", options->image,
      "Image: MHA, MHD, NII, NII.GZ, NRRD, NHDR, VTI; a DICOM segmentation; a folder of DICOM "
      "images")
    ->required();
  command->add_option("--out", options->out, "Folder for it; without it the labels are listed");
  addParts(*command, *options);
  addParsed(*command, "--unit", "Unit of the coordinates: um, mm, cm, m or auto", "auto",
    [all = options.get()](const std::string& text) { all->unit = parseUnit(text); });
  addOverwrite(*command, options->overwrite);
  command->footer(
    "Writes NAME.vtp for each organ in mm (LPS where the image says so), NAME_haptic.vtp with\n"
    "fewer points where it has more than 20000, scene.json, which palp scene opens, and\n"
    "import.json: source and hash, labels, voxels, volumes, and how far each surface is from\n"
    "the contour of its voxels, which cuts their corners. Surfaces are closed, also where the\n"
    "image ends, and smoothed within half a voxel: terraces of more than some ten voxels stay.\n"
    "Hollows of less than 100 voxels are filled, which import.json tells. Organs have tissue and\n"
    "role by their names: skin, fat and body are seen through, bones and vessels only shown.\n"
    "Examples:\n"
    "  palp import abdomen.nii.gz                                list its labels\n"
    "  palp import abdomen.nii.gz --label 5,2+3 --out organs     two organs, one of two labels\n"
    "  palp import total.nii.gz --names total.json --out organs  all, by name\n"
    "  palp import ct/ --series 2 --threshold 200:3071 --components 20 --out bones\n"
    "  palp scene organs/scene.json                              press them");
  command->callback([options] { runImport(*options); });
}

} // namespace palp
