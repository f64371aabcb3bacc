#include "app/scene/scene_text.h"

#include "app/input/coating_text.h"
#include "app/input/law_options.h"
#include "app/input/tip_text.h"
#include "app/scene/scene_entries.h"
#include "app/stiffness/stiffness_text.h"
#include "app/supports/support_text.h"
#include "haptics/files/csv_text.h"
#include "haptics/tip/profile.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace palp
{
namespace
{

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// one scene on its way to text
class Writer
{
public:
  explicit Writer(const fs::path& folder)
    : folder_(fs::absolute(folder).lexically_normal())
  {
  }

  [[nodiscard]] Json scene(const ScenePlan& plan) const
  {
    Json scene{ { "palp_scene", 1 } };
    if (!plan.name.empty())
    {
      scene["title"] = plan.name;
    }
    addBodies(scene, plan);
    scene["tissue"] = tissue(plan.press);
    scene["tool"] = tool(plan.press.tissue.tip);
    scene["law"] = law(plan);
    addMotion(scene, plan);
    if (plan.training)
    {
      scene["training"] = training(*plan.training);
    }
    scene["dent"] = dent(plan.press.dent);
    addPictures(scene, plan);
    return scene;
  }

private:
  [[nodiscard]] std::string file(const fs::path& path) const
  {
    const fs::path whole = fs::absolute(path).lexically_normal();
    const fs::path inside = whole.lexically_relative(folder_);
    return (inside.empty() || *inside.begin() == ".." ? whole : inside).string();
  }

  static Json triple(const Eigen::Vector3d& value, Quantity quantity)
  {
    return { quantityText(value.x(), quantity), quantityText(value.y(), quantity),
      quantityText(value.z(), quantity) };
  }

  template <typename Enum>
  static std::string word(const Words& words, Enum value)
  {
    return words.at(static_cast<std::size_t>(value));
  }

  static void addPart(Json& mesh, const ImagePart& part)
  {
    if (!part.series.empty())
    {
      mesh["series"] = part.series;
    }
    if (part.level)
    {
      mesh["level"] = shortest(*part.level);
    }
    if (part.band)
    {
      mesh["values"] = bandText(*part.band);
    }
    if (!part.labels.empty())
    {
      mesh["label"] = labelsText(part.labels);
    }
  }

  [[nodiscard]] Json mesh(const MeshSource& source) const
  {
    Json mesh;
    if (source.bundled.empty())
    {
      mesh["file"] = file(source.file);
    }
    else
    {
      mesh["bundled"] = source.bundled;
    }
    if (!source.haptic.empty())
    {
      mesh["haptic"] = file(source.haptic);
    }
    addPart(mesh, source.part);
    if (source.unit)
    {
      mesh["unit"] = unitName(*source.unit);
    }
    if (!source.origin.isZero(0.0) || !source.rotation.isZero(0.0))
    {
      mesh["frame"] = { { "origin", triple(source.origin, Quantity::Length) },
        { "rotation", triple(source.rotation, Quantity::Angle) } };
    }
    if (source.stiffness.isGiven())
    {
      const fs::path& map = source.stiffness.file;
      mesh["stiffness"] = describeStiffness(source.stiffness, map.empty() ? "" : file(map));
    }
    if (!source.organ.empty())
    {
      mesh["organ"] = file(source.organ);
    }
    for (const std::string& support : source.supports)
    {
      const fs::path points = pointsOfSupport(support);
      mesh["supports"].push_back(points.empty() ? support : withPoints(support, file(points)));
    }
    for (const PlacedNodule& nodule : source.nodules)
    {
      mesh["nodules"].push_back({ { "center", triple(nodule.center, Quantity::Length) },
        { "radius", quantityText(nodule.radius, Quantity::Length) },
        { "ratio", shortest(nodule.ratio) } });
    }
    return mesh;
  }

  void addBodies(Json& scene, const ScenePlan& plan) const
  {
    for (std::size_t i = 0; i < plan.meshes.size(); ++i)
    {
      if (plan.organs.empty())
      {
        scene["meshes"].push_back(mesh(plan.meshes[i]));
        continue;
      }
      const OrganPlan& organ = plan.organs[i];
      Json entry{ { "name", organ.name }, { "role", word(kOrganRoles, organ.role) },
        { "color", colorText(organ.color) }, { "tissue", tissue(organ.press) } };
      entry.update(mesh(plan.meshes[i]));
      scene["organs"].push_back(std::move(entry));
    }
  }

  static Json tissue(const PressOptions& press)
  {
    Json tissue{ { "young", quantityText(press.tissue.young, Quantity::Pressure) },
      { "poisson", shortest(press.tissue.poisson) } };
    if (const Coatings& coatings = press.tissue.options.coatings; !coatings.empty())
    {
      tissue["coating"] = describeCoatings(coatings);
    }
    if (const PronySeries& series = press.tissue.options.relaxation; !series.empty())
    {
      tissue["relaxation"] = describeRelaxation(series);
    }
    if (press.tissue.options.friction > 0.0)
    {
      tissue["friction"] = shortest(press.tissue.options.friction);
    }
    tissue["damping"] = quantityText(press.damping, Quantity::Damping);
    return tissue;
  }

  [[nodiscard]] std::string tool(const Tip& tip) const
  {
    const auto* own = std::get_if<ProfileTip>(&tip);
    return own == nullptr
      ? describeTip(tip)
      : std::string("profile:").append(fs::absolute(own->profile->name()).string());
  }

  static Json law(const ScenePlan& plan)
  {
    const LawOptions& law = plan.press.tissue.options;
    return { { "mode", word(kLawModes, law.mode) }, { "base", word(kBases, law.base) },
      { "material", word(kMaterials, law.constitution) },
      { "contact", word(kContactRules, plan.press.contact) }, { "validity", plan.validity } };
  }

  [[nodiscard]] std::string device(const DeviceChoice& choice) const
  {
    const std::string& name = choice.name;
    return choice.isScript() ? name.substr(0, name.find(':') + 1) + std::string(file(choice.file))
                             : name;
  }

  void addMotion(Json& scene, const ScenePlan& plan) const
  {
    if (plan.presses)
    {
      scene["presses"] = presses(*plan.presses);
    }
    else if (plan.recording)
    {
      scene["recording"] = { { "file", file(plan.recording->file) },
        { "device", plan.recording->device }, { "names", plan.recording->names } };
    }
    else
    {
      scene["device"] = device(plan.device);
    }
    if (plan.second)
    {
      scene["second_device"] = device(*plan.second);
    }
    scene["dead_man"] = plan.deadMan;
    scene["window"] = plan.window;
    scene["chain"] = plan.chain;
  }

  static Json training(const TrainingPlan& plan)
  {
    Json json{ { "level", plan.level }, { "seed", plan.seed } };
    if (plan.nodules > 0)
    {
      json["nodules"] = plan.nodules;
    }
    json["side"] =
      shortest(plan.side.x()) + ',' + shortest(plan.side.y()) + ',' + shortest(plan.side.z());
    if (plan.marks)
    {
      json["marks"] = Json::array();
      for (const double time : *plan.marks)
      {
        json["marks"].push_back(quantityText(time, Quantity::Time));
      }
    }
    return json;
  }

  static Json presses(const PlacedPresses& presses)
  {
    Json places = Json::array();
    for (const PressPlace& place : presses.places)
    {
      Json& entry = places.emplace_back(Json::object());
      if (!place.name.empty())
      {
        entry["name"] = place.name;
      }
      entry["at"] = triple(place.position, Quantity::Length);
    }
    Json json{ { "places", places }, { "depth", quantityText(presses.depth, Quantity::Length) },
      { "speed", quantityText(presses.speed, Quantity::Speed) } };
    if (const auto& toward = presses.toward)
    {
      json["toward"] =
        shortest(toward->x()) + ',' + shortest(toward->y()) + ',' + shortest(toward->z());
    }
    return json;
  }

  [[nodiscard]] Json dent(const DentOptions& options) const
  {
    Json dent{ { "surface",
      options.surface == DentSurface::None ? "none" : word(kDentSurfaces, options.surface) } };
    if (!options.table.empty())
    {
      dent["table"] = file(options.table);
    }
    if (options.layer)
    {
      dent["layer"] = quantityText(*options.layer, Quantity::Length);
    }
    dent["threshold"] = quantityText(options.threshold, Quantity::Length);
    return dent;
  }

  void addPictures(Json& scene, const ScenePlan& plan) const
  {
    if (plan.overlays)
    {
      scene["overlays"] = Json::array();
      for (const Overlay overlay : *plan.overlays)
      {
        scene["overlays"].push_back(word(kOverlays, overlay));
      }
    }
    scene["plots"] = Json::array();
    for (const PlotKind plot : plan.plots)
    {
      scene["plots"].push_back(word(kPlotNames, plot));
    }
    scene["plot_files"] = plan.plotFiles;
    for (const fs::path& reference : plan.referenceFiles)
    {
      scene["references"].push_back(file(reference));
    }
    if (!plan.window)
    {
      scene["exports"] = exports(plan);
      scene["size"] =
        std::to_string(plan.size.width).append("x").append(std::to_string(plan.size.height));
    }
    if (plan.camera)
    {
      scene["camera"] = { { "position", triple(plan.camera->position, Quantity::Length) },
        { "focus", triple(plan.camera->focus, Quantity::Length) },
        { "up", triple(plan.camera->up, Quantity::Length) } };
    }
  }

  static Json exports(const ScenePlan& plan)
  {
    Json exports = Json::array();
    if (plan.samples)
    {
      exports.push_back(plan.allSamples ? "all-samples" : "samples");
    }
    if (plan.deformed)
    {
      exports.push_back(plan.refined ? "refined" : "deformed");
    }
    if (plan.picture)
    {
      exports.push_back("picture");
    }
    return exports;
  }

  fs::path folder_;
};

} // namespace

std::string sceneText(const ScenePlan& plan, const std::filesystem::path& folder)
{
  return Writer(folder).scene(plan).dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

} // namespace palp
