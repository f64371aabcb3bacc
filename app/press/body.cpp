#include "app/press/body.h"

#include "app/program/progress_line.h"
#include "app/stiffness/placed_map.h"
#include "app/stiffness/stiffness_text.h"
#include "app/supports/organ_seal.h"
#include "app/supports/support_text.h"
#include "app/train/hidden_nodules.h"
#include "calibration/tables/organ_table.h"
#include "haptics/contact/embed_nodules.h"
#include "haptics/contact/embed_stiffness.h"
#include "haptics/error.h"
#include "haptics/files/input_text.h"
#include "haptics/surface/area_and_volume.h"
#include "haptics/surface/sampling/deviation.h"
#include "haptics/units.h"
#include "pipeline/model/poly_data.h"
#include "pipeline/surface_io/surface_io.h"

#include <Eigen/Geometry>
#include <vtkPolyData.h>

#include <algorithm>
#include <future>
#include <iomanip>
#include <optional>
#include <sstream>
#include <utility>

namespace palp
{
namespace
{

// points and triangles of all surfaces so far
struct Union
{
  std::vector<Eigen::Vector3d> points;
  std::vector<Triangle> triangles;

  void add(vtkPolyData& mesh, const Eigen::Isometry3d& frame)
  {
    const int first = static_cast<int>(points.size());
    for (const Eigen::Vector3d& point : pointsOf(mesh))
    {
      points.push_back(frame * point);
    }
    for (const Triangle& triangle : trianglesOf(mesh))
    {
      triangles.push_back({ triangle[0] + first, triangle[1] + first, triangle[2] + first });
    }
  }
};

std::string describeCrossing(const Eigen::Vector3d& place)
{
  std::ostringstream note;
  note << "the surface crosses, overlaps or touches itself, at " << std::setprecision(4)
       << units::toMillimeters(place.x()) << ", " << units::toMillimeters(place.y()) << ", "
       << units::toMillimeters(place.z()) << " mm for one; what is inside is told from all of it, "
       << "but forces near such folds are doubtful: repair the mesh";
  return note.str();
}

std::string describe(const Deviation& apart, std::size_t points, bool isOther)
{
  std::ostringstream note;
  note << (isOther ? "warning: the surface to feel is no level of the one shown; " : "")
       << "the force comes from " << points << " points, at most " << std::setprecision(2)
       << units::toMillimeters(apart.largest) << " mm (RMS "
       << units::toMillimeters(apart.rootMeanSquare) << " mm) from the surface shown";
  return note.str();
}

// in the scene, of the only surface of a body; null: it has none
std::shared_ptr<const ComplianceField> placedCompliance(
  const std::vector<MeshSource>& meshes, const MeshFile& felt)
{
  const MeshSource& source = meshes.front();
  if (std::ranges::all_of(meshes, [](const MeshSource& mesh) { return mesh.organ.empty(); }))
  {
    return nullptr;
  }
  if (meshes.size() > 1)
  {
    throw Error(ErrorCode::BadValue,
      "organ: an organ file is of one surface, these are several in one body; join them in one "
      "file, or leave it out");
  }
  checkSeal(source.organ);
  OrganTable table = readOrganOf(source.organ, identityOf(felt));
  checkSupports(source.supports, source.organ, table.supports);
  checkStiffness(source.stiffness, source.organ, table.stiffness);
  table.place(source.frame());
  return std::make_shared<const ComplianceField>(std::move(table.places), table.spacing,
    table.poisson,
    table.motion.places.empty() ? nullptr : std::make_shared<const OrganMotion>(table.motion),
    table.young);
}

// how far what is felt is from what is shown; else only if they are of two bodies
void noteDeviation(const Union& display, bool shown, SceneBody& body)
{
  const BoxTree fine(display.points, display.triangles);
  const Surface& felt = *body.haptic;
  const Deviation apart = deviation(display.points, fine, felt.points(), felt.tree());
  constexpr double kAlike = 0.02; // of the size; what levels of one surface have is a tenth of it
  const bool isOther = apart.rootMeanSquare > kAlike * boxAbout(display.points).diagonal().norm();
  shown || isOther ? body.notes.push_back(describe(apart, felt.points().size(), isOther)) : void();
}

// surface: of the only mesh, where it is read already
SceneBody loadParts(
  const std::vector<MeshSource>& meshes, bool shown, const FileSurface* surface = nullptr)
{
  SceneBody body;
  body.sources = meshes;
  Union display;
  Union haptic;
  std::vector<MappedPart> mapped;
  // with what is felt: levels that the user names may be of two bodies
  const bool isCompared = shown ||
    std::ranges::any_of(meshes, [](const MeshSource& mesh) { return !mesh.haptic.empty(); });
  bool coarser = false;
  std::optional<ProgressLine> progress;
  for (const MeshSource& source : meshes)
  {
    const std::filesystem::path file = source.shownFile();
    body.name.append(body.name.empty() ? "" : " + ").append(file.filename().string());
    const std::filesystem::path felt = source.feltFile();
    const FileStamps before = stampsOf(felt);
    progress.emplace("reading " + printable(file.filename().string()));
    auto hashed = std::async(std::launch::async, describeFile, felt); // meanwhile
    const LoadedSurface loaded = surface != nullptr ? madeReady(*surface, file, source.unit)
                                                    : readUnchanged(file, source.unit, source.part);
    body.unit = unitName(loaded.unit);
    body.notes.insert(body.notes.end(), loaded.notes.begin(), loaded.notes.end());
    coarser = coarser || (isCompared && felt != file);
    isCompared ? display.add(*loaded.mesh, source.frame()) : void();
    haptic.add(
      felt != file ? *readUnchanged(felt, source.unit, {}).mesh : *loaded.mesh, source.frame());
    MeshFile& origin = body.files.emplace_back(hashed.get());
    checkUnchanged(felt, before);
    origin.unit = body.unit;
    origin.space = loaded.space;
    origin.part = source.part;
    for (PlacedNodule nodule : source.nodules)
    {
      nodule.center = source.frame() * nodule.center;
      body.nodules.push_back(nodule);
    }
    source.stiffness.isGiven() ? mapped.push_back({ &source, pointsOf(*loaded.mesh) }) : void();
    origin.moved = !source.frame().isApprox(Eigen::Isometry3d::Identity());
    body.compliance = placedCompliance(meshes, origin);
    noteAxes(source.supports, spaceOf({ origin }), body.notes);
    noteSupports(source.supports, source.organ, body.notes);
  }
  progress.emplace("preparing " + printable(body.name));
  body.haptic = std::make_shared<const Surface>(haptic.points, haptic.triangles);
  body.stiffness = placedMap(mapped, *body.haptic);
  if (body.haptic->crossing())
  {
    body.notes.push_back(describeCrossing(*body.haptic->crossing()));
  }
  if (shown)
  {
    body.display = makePolyData(display.points, display.triangles);
  }
  coarser ? noteDeviation(display, shown, body) : void();
  return body;
}

// where they are labels of one image, all of them at once; else none
std::vector<FileOrgan> readLabels(const std::vector<MeshSource>& meshes)
{
  ImagePart part = meshes.front().part;
  part.labels.clear();
  for (const MeshSource& mesh : meshes)
  {
    ImagePart other = mesh.part;
    other.labels = part.labels;
    const bool isAlike = mesh.file == meshes.front().file && other == part;
    if (meshes.size() < 2 || mesh.part.labels.empty() || !mesh.haptic.empty() || !isAlike)
    {
      return {};
    }
    std::string joined;
    for (const std::string& label : mesh.part.labels)
    {
      if (label.find('+') != label.npos)
      {
        return {}; // which would be two
      }
      joined.append(joined.empty() ? "" : "+").append(label);
    }
    part.labels.push_back(joined);
  }
  FileOrgans all = readFileOrgans(meshes.front().file, part, false);
  std::vector<std::string>& notes = all.organs.front().surface.notes;
  notes.insert(notes.begin(), all.notes.begin(), all.notes.end());
  return std::move(all.organs);
}

[[noreturn]] void refuseUneven(const SceneBody& body)
{
  throw Error(ErrorCode::BadValue,
    "law: " + body.name +
      " has nodules or a map of Young's modulus inside, which only the "
      "corrected law without coatings feels; keep that, or take them out");
}

} // namespace

SceneBody loadBody(const std::vector<MeshSource>& meshes, bool shown)
{
  return loadParts(meshes, shown);
}

SceneBody loadBodies(const ScenePlan& plan, bool shown)
{
  if (plan.organs.empty())
  {
    SceneBody body = loadBody(plan.meshes, shown);
    plan.training ? hideIn(body, plan.press.tissue.law(), *plan.training) : void();
    return body;
  }
  const std::vector<FileOrgan> labels = readLabels(plan.meshes);
  SceneBody all;
  all.sources = plan.meshes;
  const auto append = [](auto& to, const auto& from)
  { to.insert(to.end(), from.begin(), from.end()); };
  for (std::size_t i = 0; i < plan.organs.size(); ++i)
  {
    const FileSurface* read = labels.empty() ? nullptr : &labels[i].surface;
    SceneBody& organ = all.organs.emplace_back(loadParts({ plan.meshes[i] }, shown, read));
    organ.name = plan.organs[i].name;
    all.name.append(all.name.empty() ? "" : " + ").append(organ.name);
    all.unit = organ.unit;
    append(all.files, organ.files);
    append(all.nodules, organ.nodules);
    for (const std::string& note : organ.notes)
    {
      all.notes.push_back(organ.name + ": " + note);
    }
  }
  return all;
}

void hideIn(SceneBody& body, const ForceLaw& law, const TrainingPlan& training)
{
  body.nodules = hideNodules(*body.haptic, law, shippedCurriculum(), training);
  body.training = training;
}

void revealNodules(SceneBody& body)
{
  MeshSource& source = body.sources.front();
  const Eigen::Isometry3d inverse = source.frame().inverse();
  source.nodules = body.nodules;
  for (PlacedNodule& nodule : source.nodules)
  {
    nodule.center = inverse * nodule.center;
  }
  body.training.reset();
}

void setTissues(Scene& scene, const std::vector<OrganPlan>& organs)
{
  scene.others.clear();
  std::vector<Scene> felt;
  for (const std::size_t i : feltOrgans(organs))
  {
    Scene& organ = felt.emplace_back(scene);
    organ.law = organs[i].press.tissue.law();
    organ.damping = organs[i].press.damping;
  }
  if (!felt.empty())
  {
    scene = felt.front();
    scene.others.assign(felt.begin() + 1, felt.end());
  }
}

void setFelt(Scene& scene, const SceneBody& body, const std::vector<OrganPlan>& organs)
{
  const auto put = [&](Scene& organ, int place)
  {
    const SceneBody& felt = body.felt(organs, place);
    organ.surface = felt.haptic;
    feelTissue(organ, felt);
  };
  put(scene, 0);
  for (std::size_t i = 0; i < scene.others.size(); ++i)
  {
    put(scene.others[i], static_cast<int>(i) + 1);
  }
}

void feelTissue(Scene& scene, const SceneBody& body)
{
  const ForceLaw& law = scene.law;
  const LawSettings& own = law.settings();
  law.checkBody(boxAbout(body.haptic->points()).sizes().minCoeff());
  scene.nodules = nullptr;
  scene.stiffness = nullptr;
  if (body.compliance != nullptr && (!own.coatings.empty() || own.base != Base::Unset))
  {
    throw Error(ErrorCode::BadValue,
      "organ: an organ file has its own base and no coating; leave out --base and --coating");
  }
  scene.series = seriesBodyOf(body.compliance, law);
  if (own.mode != LawMode::Corrected || !own.coatings.empty())
  {
    return body.isUneven() ? refuseUneven(body) : void();
  }
  try
  {
    scene.nodules = embedNodules(*body.haptic, law, body.nodules);
  }
  catch (const Error& error)
  {
    throw Error(error.code(), body.name + ": " + error.what());
  }
  LawSettings settings = own;
  settings.thickness = settings.thickness && scene.series == nullptr; // else it is told twice
  scene.stiffness = feltStiffness(body, ForceLaw(law.tip(), law.material(), settings));
}

std::shared_ptr<const StiffnessField> feltStiffness(const SceneBody& body, const ForceLaw& law)
{
  if (!body.stiffness)
  {
    return nullptr;
  }
  try
  {
    return embedStiffness(*body.haptic, law,
      [&map = body.stiffness, young = law.material().youngModulus](const Eigen::Vector3d& position)
      { return map(position, young); });
  }
  catch (const Error& error)
  {
    throw Error(
      error.code(), error.what() + labelsWithoutTissue(body.sources, body.haptic->points()));
  }
}

} // namespace palp
