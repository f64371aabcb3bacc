#pragma once

#include "haptics/servo/sample.h"
#include "haptics/servo/scene.h"
#include "haptics/servo/tissue_at.h"

#include <Eigen/Core>

namespace palp
{

/// How the tissue turns a tool about its apex, across its axis: its energy falls as the tool
/// follows. By two contacts more, of the tool turned a little about each axis.
///
/// @param sample  pose, contact, and proxyDepth at which the tissue is felt; touching
/// @param tissue  of the scene at that contact
/// @return        [N m], of tissue that neither relaxes nor rubs
/// @realtime      no allocation, no lock, no exception
[[nodiscard]] Eigen::Vector3d torqueAt(
  const Scene& scene, const Sample& sample, const TissueAt& tissue) noexcept;

} // namespace palp
