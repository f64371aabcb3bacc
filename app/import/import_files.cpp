#include "app/import/import_files.h"

#include "app/import/organ_look.h"
#include "haptics/units.h"
#include "pipeline/surface_io/surface_io.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <atomic>
#include <fstream>
#include <future>
#include <memory>
#include <numeric>
#include <semaphore>
#include <thread>

namespace palp
{
namespace
{

using Json = nlohmann::ordered_json;

// names may be in a code of characters that is not UTF-8
std::string textOf(const Json& json)
{
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Json partOf(const ImagePart& part)
{
  Json json;
  for (const std::string& label : part.labels)
  {
    json["labels"].push_back(label);
  }
  if (part.band)
  {
    json["threshold"] = *part.band;
  }
  if (part.level)
  {
    json["level"] = *part.level;
  }
  if (!part.series.empty())
  {
    json["series"] = part.series;
  }
  const bool isAll = part.components == ImagePart::kAllComponents;
  json["components"] = isAll ? Json("all") : Json(part.components);
  json["smoothing"] = part.level ? "windowed sinc" : "least bending within half a voxel";
  return json;
}

Json levelOf(const OrganLevel& level)
{
  return { { "points", level.points }, { "triangles", level.triangles },
    { "deviation_mm", units::toMillimeters(level.apart.largest) },
    { "deviation_rms_mm", units::toMillimeters(level.apart.rootMeanSquare) } };
}

Json organOf(const ImportedOrgan& organ)
{
  Json json{ { "name", organ.name }, { "file", organ.file + ".vtp" } };
  if (!organ.label.empty())
  {
    json["label"] = organ.label;
  }
  json["voxels"] = organ.voxels;
  json["voxels_ml"] = units::toMilliliters(organ.voxelVolume);
  json["taken_ml"] = units::toMilliliters(organ.enclosed);
  json["surface_ml"] = units::toMilliliters(organ.volume);
  json["notes"] = organ.notes;
  json["shown"] = levelOf(organ.shown);
  if (organ.felt)
  {
    json["haptic_file"] = organ.file + kHaptic + ".vtp";
    json["haptic"] = levelOf(*organ.felt);
  }
  return json;
}

// Places of organs that one process reads, a few for each processor, as each reads the image anew.
// The largest first: at the end it would keep one processor busy and the others waiting.
std::vector<std::vector<std::size_t>> sharesOf(
  const std::vector<FileOrgan>& organs, std::size_t processors)
{
  constexpr std::size_t kOnEach = 4;
  std::vector<std::size_t> order(organs.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, std::greater(), [&](std::size_t i) { return organs[i].voxels; });
  std::uint64_t all = 0;
  std::ranges::for_each(organs, [&](const FileOrgan& organ) { all += organ.voxels; });
  const std::uint64_t enough = all / (kOnEach * processors);
  std::vector<std::vector<std::size_t>> shares;
  std::uint64_t voxels = enough; // of the last one
  for (const std::size_t i : order)
  {
    if (voxels >= enough)
    {
      shares.emplace_back();
      voxels = 0;
    }
    shares.back().push_back(i);
    voxels += organs[i].voxels;
  }
  return shares;
}

// of those of a share that have none yet; they keep what they are called
void readSurfaces(std::vector<FileOrgan>& organs, const std::vector<std::size_t>& share,
  const ImportSource& source, std::counting_semaphore<>& readers)
{
  if (!organs[share.front()].surface.points.empty())
  {
    return; // it was the only one
  }
  readers.acquire();
  const auto leave = [&readers](void*) { readers.release(); };
  const std::unique_ptr<void, decltype(leave)> turn(&readers, leave);
  FileOrgans read = readFileOrgansAt(source.file, source.image.part, share);
  checkUnchanged(source.file, source.stamps);
  for (const std::size_t i : share)
  {
    FileOrgan& organ = read.organs.at(i);
    organ.name = std::move(organs[i].name);
    organ.color = std::move(organs[i].color);
    organs[i] = std::move(organ);
  }
}

} // namespace

std::vector<std::string> importFiles(const std::filesystem::path& folder)
{
  std::vector<std::string> files{ kImportScene, kImportManifest };
  std::ifstream in(folder / kImportManifest);
  const auto earlier = in ? nlohmann::json::parse(in, nullptr, false) : nlohmann::json();
  if (!earlier.is_object() || !earlier.contains("organs") || !earlier["organs"].is_array())
  {
    return files;
  }
  for (const auto& organ : earlier["organs"])
  {
    for (const char* key : { "file", "haptic_file" })
    {
      if (organ.is_object() && organ.contains(key) && organ[key].is_string())
      {
        files.push_back(std::filesystem::path(organ[key].get<std::string>()).filename());
      }
    }
  }
  return files;
}

std::vector<ImportedOrgan> importedOrgans(FileOrgans all, const std::vector<std::string>& files,
  const ImportSource& source, LengthUnit unit, const std::filesystem::path& folder,
  const std::function<void(std::size_t)>& tell)
{
  const std::size_t processors = std::max(1U, std::thread::hardware_concurrency());
  const std::vector<std::vector<std::size_t>> shares = sharesOf(all.organs, processors);
  std::vector<ImportedOrgan> made(all.organs.size());
  std::counting_semaphore<> readers(2); // each holds the whole image
  std::atomic<std::size_t> begun{ 0 };
  std::atomic<std::size_t> done{ 0 };
  const auto work = [&]
  {
    for (std::size_t next = begun++; next < shares.size(); next = begun++)
    {
      readSurfaces(all.organs, shares[next], source, readers);
      for (const std::size_t i : shares[next])
      {
        const auto save = [&](const std::string& behind, vtkPolyData& mesh)
        { writeSurface(folder / (files[i] + behind + ".vtp"), mesh, all.space); };
        made[i] = importedOrgan(std::move(all.organs[i]), source.file, unit, save);
        made[i].file = files[i];
        tell(++done);
      }
    }
  };
  std::vector<std::future<void>> workers(std::min(processors, shares.size()));
  std::ranges::generate(workers, [&] { return std::async(std::launch::async, work); });
  for (std::future<void>& worker : workers)
  {
    try
    {
      worker.get();
    }
    catch (...)
    {
      begun = shares.size(); // what the others would make of the rest is of no use
      throw;
    }
  }
  return made;
}

std::string importScene(const ImportSource& source, const std::vector<ImportedOrgan>& organs)
{
  Json scene{ { "palp_scene", 1 }, { "title", "Imported from " + source.image.name } };
  std::vector<std::string> names(organs.size());
  std::ranges::transform(organs, names.begin(), &ImportedOrgan::name);
  const std::vector<OrganLook> looks = looksOf(names);
  for (std::size_t i = 0; i < organs.size(); ++i)
  {
    const ImportedOrgan& organ = organs[i];
    const OrganLook& look = looks[i];
    Json json{ { "name", organ.name }, { "file", organ.file + ".vtp" }, { "role", look.role },
      { "color", organ.color.empty() ? look.color : organ.color } };
    if (organ.felt)
    {
      json["haptic"] = organ.file + kHaptic + ".vtp";
    }
    if (look.tissue != nullptr)
    {
      json["tissue"] = { { "name", look.tissue } };
    }
    scene["organs"].push_back(std::move(json));
  }
  scene["plots"] = { "force-time", "force-depth" };
  return textOf(scene);
}

std::string importManifest(const ImportSource& source, const std::vector<ImportedOrgan>& organs)
{
  Json manifest{ { "palp_import", 1 }, { "version", PALP_VERSION },
    { "source", { { "file", source.image.name }, { "sha256", source.image.sha256 } } },
    { "unit", source.image.unit },
    { "frame", source.image.space.empty() ? "of the file" : source.image.space },
    { "unit_of_files", "mm" }, { "parameters", partOf(source.image.part) } };
  if (!source.names.empty())
  {
    manifest["source"]["names"] = source.names;
  }
  for (const ImportedOrgan& organ : organs)
  {
    manifest["organs"].push_back(organOf(organ));
  }
  return textOf(manifest);
}

} // namespace palp
