#pragma once

#include "app/input/mesh_file.h"
#include "app/input/scene_plan.h"
#include "haptics/force/force_law.h"
#include "haptics/force/nodules/nodule_field.h"
#include "haptics/force/series/compliance_field.h"
#include "haptics/servo/scene.h"
#include "haptics/surface/surface.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>
#include <vtkSmartPointer.h>

class vtkPolyData;

namespace palp
{

/// What is pressed, in two levels of detail: one to look at, one to feel.
struct SceneBody
{
  std::string name;                                    ///< file name, for people
  std::string unit;                                    ///< that the file's coordinates were read in
  std::vector<MeshSource> sources;                     ///< that it was loaded from
  std::vector<MeshFile> files;                         ///< that are felt
  vtkSmartPointer<vtkPolyData> display;                ///< [m]; null where nobody looks
  vtkSmartPointer<vtkPolyData> coarse{};               ///< [m]; see loadLiveBodies; null: none
  std::shared_ptr<const Surface> haptic;               ///< [m]
  std::vector<PlacedNodule> nodules;                   ///< in it [m]
  TissueMap stiffness;                                 ///< in it; empty: the same everywhere
  std::shared_ptr<const ComplianceField> compliance{}; ///< as a whole; null: it does not give way
  std::vector<std::string> notes;         ///< what was taken, and warnings; a line each
  std::optional<TrainingPlan> training{}; ///< by which its nodules were hidden; none: as in sources
  std::vector<SceneBody> organs{};        ///< each by itself, which alone are seen and felt then

  /// Nodules that pictures may show: none while they are searched for.
  [[nodiscard]] std::span<const PlacedNodule> shownNodules() const
  {
    return training ? std::span<const PlacedNodule>{} : nodules;
  }

  /// Whether its stiffness, or that of an organ of it, differs from place to place.
  [[nodiscard]] bool isUneven() const
  {
    return !nodules.empty() || stiffness || std::ranges::any_of(organs, &SceneBody::isUneven);
  }

  /// One of the organs that are felt, or the only body.
  /// @param organ  as in a Sample of a scene of these organs
  [[nodiscard]] const SceneBody& felt(const std::vector<OrganPlan>& plans, int organ) const
  {
    return plans.empty() ? *this : organs[feltOrgans(plans)[static_cast<std::size_t>(organ)]];
  }
};

/// Loads surfaces into one body; what is felt is what is shown, but for the bundled liver and a
/// source with a haptic surface, which have a coarser one to feel.
///
/// @param meshes   one or more
/// @param shown    whether a surface to look at is needed, too
/// @throws Error   BadFile, BadMesh, BadValue
[[nodiscard]] SceneBody loadBody(const std::vector<MeshSource>& meshes, bool shown = true);

/// The same of a plan, organs by themselves, with the nodules of its training.
/// @throws Error   also as hideNodules
[[nodiscard]] SceneBody loadBodies(const ScenePlan& plan, bool shown = true);

/// Hides the nodules of a training in a body, in place of those that it has.
/// @throws Error  as hideNodules
void hideIn(SceneBody& body, const ForceLaw& law, const TrainingPlan& training);

/// Ends the training of a body: its nodules are then known, as if its first source held them.
void revealNodules(SceneBody& body);

/// Puts laws and damping of the organs that are felt into a scene; changes nothing where there are
/// no organs.
/// @throws Error  as TissueOptions::law
void setTissues(Scene& scene, const std::vector<OrganPlan>& organs);

/// Puts surface and nodules of a body, or of each organ that is felt, to the laws in a scene.
/// @throws Error  as feelTissue
void setFelt(Scene& scene, const SceneBody& body, const std::vector<OrganPlan>& organs);

/// Puts the nodules of a body, its map and its compliance into a scene, felt by its law.
/// @throws Error  BadValue: an uneven body under a law that knows it even; as embedNodules,
///                embedStiffness and ForceLaw::checkBody
void feelTissue(Scene& scene, const SceneBody& body);

/// The stiffness of a body with a map, as a law feels it; null: it has none.
/// @throws Error  as embedStiffness, naming labels in the body that have no tissue
[[nodiscard]] std::shared_ptr<const StiffnessField> feltStiffness(
  const SceneBody& body, const ForceLaw& law);

} // namespace palp
