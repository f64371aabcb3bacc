#include "app/press/body.h"

#include "app/program/data_files.h"
#include "app/program/progress_line.h"
#include "app/train/hidden_nodules.h"
#include "haptics/contact/embed_nodules.h"
#include "haptics/error.h"
#include "haptics/files/input_text.h"
#include "haptics/surface/deviation.h"
#include "haptics/units.h"
#include "pipeline/model/poly_data.h"
#include "pipeline/surface_io/surface_io.h"

#include <Eigen/Geometry>
#include <vtkPolyData.h>

#include <iomanip>
#include <optional>
#include <sstream>

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

std::string describe(const Deviation& apart, std::size_t points)
{
  std::ostringstream note;
  note << "the force comes from " << points << " points, at most " << std::setprecision(2)
       << units::toMillimeters(apart.largest) << " mm (RMS "
       << units::toMillimeters(apart.rootMeanSquare) << " mm) from the surface shown";
  return note.str();
}

// what is felt of a surface: itself, or one of fewer points
std::filesystem::path feltFile(const MeshSource& source, const std::filesystem::path& shown)
{
  return source.bundled == "liver" ? dataFile("meshes/liver_haptic.vtp")
    : source.haptic.empty()        ? shown
                                   : source.haptic;
}

} // namespace

SceneBody loadBody(const std::vector<MeshSource>& meshes, bool shown)
{
  SceneBody body;
  body.sources = meshes;
  Union display;
  Union haptic;
  bool coarser = false;
  std::optional<ProgressLine> progress;
  for (const MeshSource& source : meshes)
  {
    const std::filesystem::path file =
      source.bundled.empty() ? source.file : dataFile("meshes/" + source.bundled + ".vtp");
    body.name.append(body.name.empty() ? "" : " + ").append(file.filename().string());
    const std::filesystem::path felt = feltFile(source, file);
    const FileStamps before = stampsOf(felt);
    progress.emplace("reading " + printable(file.filename().string()));
    const LoadedSurface loaded = readSurface(file, source.unit, source.part);
    body.unit = unitName(loaded.unit);
    body.notes.insert(body.notes.end(), loaded.notes.begin(), loaded.notes.end());
    if (shown)
    {
      display.add(*loaded.mesh, source.frame());
    }
    const bool isOther = felt != file;
    coarser = coarser || isOther;
    haptic.add(isOther ? *readSurface(felt, source.unit).mesh : *loaded.mesh, source.frame());
    MeshFile& origin = body.files.emplace_back(describeFile(felt));
    if (stampsOf(felt) != before)
    {
      throw Error(ErrorCode::BadFile,
        printable(felt.string()) + ": was changed while it was read; run again");
    }
    origin.unit = body.unit;
    origin.space = loaded.space;
    origin.part = source.part;
    for (PlacedNodule nodule : source.nodules)
    {
      nodule.center = source.frame() * nodule.center;
      body.nodules.push_back(nodule);
    }
    origin.moved = !source.frame().isApprox(Eigen::Isometry3d::Identity());
  }
  body.haptic = std::make_shared<const Surface>(haptic.points, haptic.triangles);
  if (body.haptic->crossing())
  {
    body.notes.push_back(describeCrossing(*body.haptic->crossing()));
  }
  if (shown)
  {
    body.display = makePolyData(display.points, display.triangles);
  }
  if (shown && coarser)
  {
    const BoxTree fine(display.points, display.triangles);
    const Surface& felt = *body.haptic;
    body.notes.push_back(
      describe(deviation(display.points, fine, felt.points(), felt.tree()), felt.points().size()));
  }
  return body;
}

SceneBody loadBodies(const ScenePlan& plan, bool shown)
{
  if (plan.organs.empty())
  {
    SceneBody body = loadBody(plan.meshes, shown);
    plan.training ? hideIn(body, plan.press.tissue.law(), *plan.training) : void();
    return body;
  }
  SceneBody all;
  all.sources = plan.meshes;
  const auto append = [](auto& to, const auto& from)
  { to.insert(to.end(), from.begin(), from.end()); };
  for (std::size_t i = 0; i < plan.organs.size(); ++i)
  {
    SceneBody& organ = all.organs.emplace_back(loadBody({ plan.meshes[i] }, shown));
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
    organ.nodules = feltNodules(felt, organ.law);
  };
  put(scene, 0);
  for (std::size_t i = 0; i < scene.others.size(); ++i)
  {
    put(scene.others[i], static_cast<int>(i) + 1);
  }
}

std::shared_ptr<const NoduleField> feltNodules(const SceneBody& body, const ForceLaw& law)
{
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& point : body.haptic->points())
  {
    box.extend(point);
  }
  law.checkBody(box.sizes().minCoeff());
  const bool known = law.settings().mode == LawMode::Corrected && law.settings().coatings.empty();
  return known ? embedNodules(*body.haptic, law, body.nodules) : nullptr;
}

} // namespace palp
