#include "app/folder/export_folder.h"

#include "app/input/json_object.h"
#include "app/input/tip_text.h"
#include "app/press/recording.h"
#include "app/program/data_files.h"
#include "app/scene/scene_file.h"
#include "app/scene/scene_text.h"
#include "app/supports/support_text.h"
#include "app/train/curriculum.h"
#include "app/train/score_sheet.h"
#include "haptics/error.h"
#include "haptics/files/input_text.h"
#include "haptics/files/replace_file.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <system_error>

namespace palp
{
namespace
{

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kScene = "scene.json";
constexpr const char* kPath = "path.csv";
constexpr const char* kProvenance = "provenance.json";
constexpr const char* kServo = "servo.csv"; // of the live thread, which nothing repeats
constexpr const char* kBeside = "beside";   // files that palp run does not repeat

// what is pressed, as it was felt, and what else the plan reads from outside of the folder
std::vector<MeshFile> inputsOf(const ScenePlan& plan, const Recording& recording)
{
  std::vector<MeshFile> inputs = recording.files;
  if (!plan.press.dent.table.empty())
  {
    inputs.push_back(describeFile(plan.press.dent.table));
  }
  if (const fs::path profile = fileOf(plan.press.tissue.tip); !profile.empty())
  {
    inputs.push_back(describeFile(profile));
  }
  for (const fs::path& reference : plan.referenceFiles)
  {
    inputs.push_back(describeFile(reference));
  }
  for (const MeshSource& mesh : plan.meshes)
  {
    if (!mesh.stiffness.file.empty())
    {
      inputs.push_back(describeFile(mesh.stiffness.file));
    }
    if (!mesh.organ.empty())
    {
      inputs.push_back(describeFile(mesh.organ));
    }
    for (const std::string& support : mesh.supports)
    {
      const fs::path points = pointsOfSupport(support);
      points.empty() ? void() : inputs.push_back(describeFile(points));
    }
  }
  if (plan.training)
  {
    inputs.push_back(describeFile(dataFile(kCurriculumFile)));
  }
  return inputs;
}

// made on request, by a program that may differ
bool isMovie(const std::string& name)
{
  return name.ends_with(".mp4") || name.ends_with(".ogv");
}

std::vector<MeshFile> outputsIn(const fs::path& stage)
{
  std::vector<MeshFile> outputs;
  for (const auto& entry : fs::directory_iterator(stage))
  {
    const std::string name = entry.path().filename().string();
    if (entry.is_regular_file() && name != kProvenance && name != kServo && !isMovie(name))
    {
      outputs.push_back(describeFile(entry.path()));
    }
  }
  std::ranges::sort(outputs, {}, &MeshFile::name);
  return outputs;
}

Json listOf(const std::vector<MeshFile>& files)
{
  Json list = Json::array();
  for (const MeshFile& file : files)
  {
    list.push_back({ { "name", file.name }, { "sha256", file.sha256 } });
  }
  return list;
}

std::vector<MeshFile> readList(JsonObject& object, const char* key)
{
  std::vector<MeshFile> files;
  for (JsonObject& entry : object.objects(key))
  {
    MeshFile& file = files.emplace_back();
    file.name = entry.text("name", "");
    file.sha256 = entry.text("sha256", "");
    entry.finish();
  }
  return files;
}

} // namespace

std::vector<std::string> exportFiles()
{
  std::vector<std::string> names{ kScene, kPath, kProvenance, kServo, "samples.csv", "presses.csv",
    "deformed.vtp", "stiffness_map.csv", "stiffness_map.vtp", "press.png", "force_time.png",
    "force_depth.png" };
  names.insert(names.end(), kScoreFiles.begin(), kScoreFiles.end());
  for (const std::string& movie : kMovieNames)
  {
    names.insert(names.end(), { movie + ".mp4", movie + ".ogv" });
  }
  for (const std::string plot : { "section", "comparison", "extent" })
  {
    for (const std::string& ending : kPlotEndings)
    {
      names.push_back(std::string(plot).append(".").append(ending));
    }
  }
  return names;
}

bool isExport(const fs::path& folder)
{
  std::error_code none;
  return fs::is_directory(folder, none) && fs::exists(folder / kScene, none);
}

bool isWholeExport(const fs::path& folder)
{
  if (isExport(folder))
  {
    return true;
  }
  std::error_code none;
  const std::vector<std::string> names = exportFiles();
  const auto isThere = [&](const std::string& name) { return fs::exists(folder / name, none); };
  if (fs::is_directory(folder, none) &&
    (fs::is_empty(folder, none) || std::ranges::any_of(names, isThere)))
  {
    throw Error(ErrorCode::BadFile,
      folder.string() +
        ": has no scene.json, by which an exported folder is repeated; bring it back, or give "
        "another folder");
  }
  return false;
}

ExportFolder readExport(const fs::path& folder)
{
  if (!isExport(folder))
  {
    throw Error(ErrorCode::BadFile,
      folder.string() + ": is no exported folder; choose one that has a scene.json");
  }
  ExportFolder made{ .folder = folder, .plan = readScene((folder / kScene).string()) };
  const nlohmann::json document =
    parseJson(readText(folder / kProvenance, "the provenance.json of an export"), kProvenance);
  JsonObject object(document, kProvenance);
  made.version = object.text("palp", "");
  made.command = object.text("command", "");
  made.device = object.text("device", "");
  made.inputs = readList(object, "inputs");
  made.outputs = readList(object, "outputs");
  made.beside = readList(object, kBeside);
  object.finish();
  return made;
}

fs::path earlierTake(const fs::path& folder, std::size_t take)
{
  return folder / ("earlier-" + std::to_string(take));
}

std::vector<fs::path> takesIn(const fs::path& folder)
{
  std::vector<fs::path> takes;
  while (isExport(earlierTake(folder, takes.size() + 1)))
  {
    takes.push_back(earlierTake(folder, takes.size() + 1));
  }
  if (takes.empty() || isExport(folder))
  {
    takes.push_back(folder);
  }
  return takes;
}

void writeScene(const fs::path& stage, ScenePlan plan, const std::string& path)
{
  const std::string& name = plan.device.name;
  if (plan.device.isScript() && !plan.presses && !plan.recording)
  {
    replaceFile(stage / kPath, path);
    plan.device = parseDevice(name.substr(0, name.find(':') + 1) + (stage / kPath).string());
  }
  else if (plan.recording)
  {
    plan.recording->file = stage / "samples.csv";
  }
  replaceFile(stage / kScene, sceneText(plan, stage));
}

void writeProvenance(const fs::path& stage, const ScenePlan& plan, const Recording& recording)
{
  const Json provenance{ { "palp", PALP_VERSION }, { "command", recording.command },
    { "device", recording.device }, { "inputs", listOf(inputsOf(plan, recording)) },
    { "outputs", listOf(outputsIn(stage)) } };
  replaceFile(
    stage / kProvenance, provenance.dump(2, ' ', false, Json::error_handler_t::replace) + '\n');
}

void addToProvenance(const fs::path& folder, const std::vector<std::string>& names)
{
  std::vector<MeshFile> files;
  files.reserve(names.size());
  for (const std::string& name : names)
  {
    files.push_back(describeFile(folder / name));
  }
  Json provenance = Json::parse(readText(folder / kProvenance, "the provenance.json of an export"));
  provenance[kBeside] = listOf(files);
  replaceFile(
    folder / kProvenance, provenance.dump(2, ' ', false, Json::error_handler_t::replace) + '\n');
}

void checkInputs(const ExportFolder& made, const ScenePlan& plan, const Recording& recording)
{
  const std::vector<MeshFile> now = inputsOf(plan, recording);
  for (std::size_t i = 0; i < std::min(now.size(), made.inputs.size()); ++i)
  {
    if (now[i].sha256 != made.inputs[i].sha256)
    {
      throw Error(ErrorCode::BadFile,
        made.folder.string() + ": " + printable(now[i].name) +
          " is another file than the one it was made from, SHA-256 " +
          printable(made.inputs[i].sha256.substr(0, 8)) +
          "...; bring that one back, or press anew without the folder");
    }
  }
}

std::vector<std::string> differences(const ExportFolder& made, const fs::path& stage)
{
  const std::vector<MeshFile> now = outputsIn(stage);
  std::vector<std::string> names;
  for (const MeshFile& before : made.outputs)
  {
    const auto same = [&](const MeshFile& file)
    { return file.name == before.name && file.sha256 == before.sha256; };
    if (std::ranges::none_of(now, same))
    {
      names.push_back(printable(before.name));
    }
  }
  return names;
}

} // namespace palp
