#include "app/import/organ_level.h"

#include "haptics/error.h"
#include "haptics/files/input_text.h"
#include "haptics/surface/area_and_volume.h"
#include "haptics/surface/closest_point.h"
#include "haptics/surface/crossing.h"
#include "haptics/surface/decimation/decimate.h"
#include "haptics/units.h"
#include "pipeline/model/poly_data.h"
#include "pipeline/surface_io/surface_io.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <functional>
#include <future>
#include <utility>
#include <vtkPolyData.h>

namespace palp
{
namespace
{

constexpr std::size_t kHapticPoints = 10'000; // four times those of the bundled liver

// the surface between the voxels, before anything was smoothed
struct Boundary
{
  std::vector<Eigen::Vector3d> points; // [m]
  std::span<const Triangle> triangles;
  BoxTree tree;
  std::vector<Eigen::Vector3d> asked; // few of them, the first to be far off where any is [m]
};

struct Shown
{
  BoxTree tree;
  Deviation apart; // from the boundary
};

Shown shownOf(std::span<const Eigen::Vector3d> points, std::span<const Triangle> triangles,
  const std::shared_future<Boundary>& between)
{
  const Boundary& boundary = between.get();
  const bool isSame = std::ranges::equal(boundary.triangles, triangles); // none was repaired
  Shown shown{ .tree = isSame ? boundary.tree.moved(points, triangles) : BoxTree(points, triangles),
    .apart = {} };
  shown.apart = deviation(points, shown.tree, boundary.points, boundary.tree,
    { .paired = true, .threads = std::launch::deferred }); // beside a decimation
  return shown;
}

// one of sixteen that smoothing moved the most, and one of sixteen of all
std::vector<Eigen::Vector3d> askedOf(const FileOrgan& organ, double length)
{
  constexpr std::size_t kOneOf = 16;
  std::vector<std::pair<double, std::size_t>> moved(organ.from.size());
  for (std::size_t i = 0; i < moved.size(); ++i)
  {
    moved[i] = { (organ.from[i] - organ.surface.points[i]).squaredNorm(), i };
  }
  const std::size_t count = moved.size() / kOneOf;
  std::ranges::nth_element(
    moved, moved.begin() + static_cast<std::ptrdiff_t>(count), std::greater());
  std::vector<Eigen::Vector3d> asked;
  for (std::size_t i = 0; i < count; ++i)
  {
    asked.emplace_back(length * organ.from[moved[i].second]);
    asked.emplace_back(length * organ.from[kOneOf * i]);
  }
  return asked;
}

Boundary boundaryOf(const FileOrgan& organ, double length)
{
  Boundary boundary{ .points = organ.from,
    .triangles = organ.surface.triangles,
    .tree = {},
    .asked = askedOf(organ, length) };
  for (Eigen::Vector3d& point : boundary.points)
  {
    point *= length;
  }
  boundary.tree = BoxTree(boundary.points, boundary.triangles);
  return boundary;
}

// a coarser surface
struct Coarse
{
  TriangleMesh mesh;
  BoxTree tree{};    // once it was asked whether it is near
  Deviation apart{}; // once that is known
};

// by points that it shall be near
bool isNearTo(std::span<const Eigen::Vector3d> points, Coarse& level, double most)
{
  level.tree = BoxTree(level.mesh.points, level.mesh.triangles);
  return std::ranges::all_of(points,
    [&](const Eigen::Vector3d& point)
    { return distanceTo(level.tree, point, 2.0 * most, most) <= most; });
}

OrganLevel levelOf(std::span<const Eigen::Vector3d> points, std::span<const Triangle> triangles,
  const Deviation& apart)
{
  return { .points = points.size(), .triangles = triangles.size(), .apart = apart };
}

// Of as few points as stay within what the voxels tell.
std::optional<Coarse> feltLevel(std::span<const Eigen::Vector3d> points,
  std::span<const Triangle> triangles, double voxel, const std::shared_future<Shown>& shown,
  const std::shared_future<Boundary>& between)
{
  std::vector<std::size_t> counts;
  for (std::size_t count = kHapticPoints; 2 * count < points.size(); count *= 2)
  {
    counts.insert(counts.begin(), count);
  }
  if (counts.empty())
  {
    return std::nullopt; // it is felt as it is
  }
  counts.insert(counts.begin(), points.size() / 2);
  const auto most = [&] { return std::max(voxel, shown.get().apart.largest); };
  std::deque<Coarse> levels;
  std::future<bool> isNear; // the last of them; else no coarser one is
  decimateTo(counts, points, triangles, 0.5 * voxel,
    [&](TriangleMesh felt)
    {
      if (isNear.valid() && !isNear.get())
      {
        levels.pop_back();
        return false;
      }
      levels.push_back({ .mesh = std::move(felt) });
      isNear = std::async(std::launch::async, // while the next one is made
        [&, &last = levels.back()] { return isNearTo(between.get().asked, last, most()); });
      return true;
    });
  isNear.valid() && !isNear.get() ? levels.pop_back() : void();
  for (; !levels.empty(); levels.pop_back())
  {
    Coarse& felt = levels.back();
    const Boundary& boundary = between.get();
    felt.apart =
      deviation(felt.mesh.points, felt.tree, boundary.points, boundary.tree, { .most = most() });
    if (felt.apart.largest <= most())
    {
      return std::move(felt);
    }
  }
  return std::nullopt;
}

void addWarnings(const std::vector<std::string>& notes, std::vector<std::string>& warnings)
{
  constexpr std::string_view kWarning = "warning: ";
  for (const std::string& note : notes)
  {
    note.starts_with(kWarning) ? warnings.push_back(note.substr(kWarning.size())) : void();
  }
}

void warnOf(const Deviation& apart, const std::string& noneFelt, std::size_t crossing, double voxel,
  std::vector<std::string>& warnings)
{
  if (constexpr double kFar = 2.0; apart.largest > kFar * voxel)
  {
    warnings.push_back("pieces of a few voxels are smoothed away, up to " +
      units::inMillimeters(apart.largest) + " from what is left");
  }
  noneFelt.empty() ? void() : warnings.push_back(noneFelt);
  if (crossing > 0)
  {
    warnings.push_back("its surface passes through itself, by " + counted(crossing, "triangle") +
      ", where the image is noisy or the organ as thin as a voxel; smooth the image there");
  }
}

} // namespace

ImportedOrgan importedOrgan(
  FileOrgan organ, const std::filesystem::path& image, LengthUnit unit, const SaveSurface& save)
{
  const double length = unitLength(unit);
  ImportedOrgan result{ .name = organ.name,
    .file = {},
    .label = organ.label,
    .color = organ.color,
    .voxels = organ.voxels,
    .voxelVolume = std::pow(length, 3) * organ.voxelVolume,
    .enclosed = std::pow(length, 3) * organ.enclosed,
    .shown = {} };
  addWarnings(organ.surface.notes, result.warnings);
  result.notes = std::exchange(organ.surface.notes, {}); // told once
  if (organ.surface.points.empty())
  {
    return result;
  }
  const std::shared_future<Boundary> between =
    std::async(std::launch::async, boundaryOf, std::cref(organ), length);
  const LoadedSurface loaded = madeReady(organ.surface, image, unit);
  addWarnings(loaded.notes, result.warnings);
  const std::vector<Eigen::Vector3d> points = pointsOf(*loaded.mesh);
  const std::vector<Triangle> triangles = trianglesOf(*loaded.mesh);
  const std::shared_future<Shown> shown =
    std::async(std::launch::async, [&] { return shownOf(points, triangles, between); });
  auto crossing = std::async(std::launch::async,
    [&]
    {
      const Shown& known = shown.get();
      save("", *loaded.mesh);
      return crossingTriangles(known.tree, triangles).size();
    });
  std::optional<Coarse> felt;
  std::string noneFelt; // why
  try
  {
    felt = feltLevel(points, triangles, length * organ.voxel, shown, between);
    noneFelt = felt || points.size() < 2 * kHapticPoints
      ? ""
      : "no coarser level: none of half as many points stays within a voxel of it";
  }
  catch (const Error&) // an edge of three triangles
  {
    noneFelt = "no coarser level, so what is shown is felt, which takes longer: "
               "parts of it meet only in edges or points; smooth the image there";
  }
  if (felt)
  {
    save(kHaptic, *makePolyData(felt->mesh.points, felt->mesh.triangles));
    result.felt = levelOf(felt->mesh.points, felt->mesh.triangles, felt->apart);
  }
  result.volume = enclosedVolume(points, triangles);
  result.shown = levelOf(points, triangles, shown.get().apart);
  warnOf(result.shown.apart, noneFelt, crossing.get(), length * organ.voxel, result.warnings);
  return result;
}

LengthUnit unitOf(const FileOrgans& organs, UnitChoice asked, const std::filesystem::path& image,
  std::vector<std::string>& warnings)
{
  const UnitChoice named = unitNamed(organs.unit);
  if (asked)
  {
    if (named && *named != *asked)
    {
      warnings.push_back(std::string("taken in ") + unitName(*asked) +
        ", as asked, though its header says " + unitName(*named));
    }
    return *asked;
  }
  Eigen::AlignedBox3d box;
  for (const FileOrgan& organ : organs.organs)
  {
    box.extend(organ.corners[0]).extend(organ.corners[1]);
  }
  const double size = box.sizes().maxCoeff();
  if (named)
  {
    constexpr double kLeast = 1e-3; // [m] of an organ
    constexpr double kMost = 3.0;   // of a patient
    const double length = size * unitLength(*named);
    if (length < kLeast || length > kMost)
    {
      warnings.push_back("by the " + organs.unit + " of its header it is " +
        units::inMillimeters(length) + " long; if that is wrong, give the unit by --unit");
    }
    return *named;
  }
  const LengthUnit guess = guessUnit(size, image.string(), organs.organs.front().surface.field);
  warnings.push_back(std::string("the file names no unit; ") + unitName(guess) +
    " is the only one that gives the size of organs; --unit " + unitName(guess) + " confirms it");
  return guess;
}

UnitChoice unitOfList(
  const FileOrgans& organs, UnitChoice asked, const std::filesystem::path& image, std::string& note)
{
  const UnitChoice known = asked ? asked : unitNamed(organs.unit);
  if (known || organs.organs.empty())
  {
    return known;
  }
  const double volume = std::ranges::max(organs.organs, {}, &FileOrgan::voxelVolume).voxelVolume;
  try
  {
    const LengthUnit guess =
      guessUnit(std::cbrt(volume), image.string(), organs.organs.front().surface.field);
    note = std::string("the file names no unit; volumes are by ") + unitName(guess) +
      ", which alone gives the size of organs";
    return guess;
  }
  catch (const Error&)
  {
    note = "the file names no unit; give --unit mm for volumes";
    return std::nullopt;
  }
}

} // namespace palp
