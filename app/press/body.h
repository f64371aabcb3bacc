#pragma once

#include "app/input/mesh_file.h"
#include "app/input/scene_plan.h"
#include "haptics/force/force_law.h"
#include "haptics/force/nodules/nodule_field.h"
#include "haptics/surface/surface.h"

#include <memory>
#include <string>
#include <vector>
#include <vtkSmartPointer.h>

class vtkPolyData;

namespace palp
{

/// What is pressed, in two levels of detail: one to look at, one to feel.
struct SceneBody
{
  std::string name;                      ///< file name, for people
  std::string unit;                      ///< that the file's coordinates were read in
  std::vector<MeshSource> sources;       ///< that it was loaded from
  std::vector<MeshFile> files;           ///< that are felt
  vtkSmartPointer<vtkPolyData> display;  ///< [m]; null where nobody looks
  std::shared_ptr<const Surface> haptic; ///< [m]
  std::vector<PlacedNodule> nodules;     ///< in it [m]
  std::vector<std::string> notes;        ///< what was taken, and warnings; a line each
};

/// Loads surfaces into one body; what is felt is what is shown, but for the bundled liver, which
/// has a coarser surface to feel.
///
/// @param meshes   one or more
/// @param shown    whether a surface to look at is needed, too
/// @throws Error   BadFile, BadMesh, BadValue
[[nodiscard]] SceneBody loadBody(const std::vector<MeshSource>& meshes, bool shown = true);

/// The nodules of a body, felt by the tool of a law; null where there are none, or the law does not
/// know them.
/// @throws Error  as embedNodules
[[nodiscard]] std::shared_ptr<const NoduleField> feltNodules(
  const SceneBody& body, const ForceLaw& law);

} // namespace palp
