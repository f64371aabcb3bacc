#pragma once

#include "haptics/contact/find_contact.h"
#include "haptics/force/force_law.h"
#include "haptics/force/maps/stiffness_field.h"
#include "haptics/force/nodules/nodule_field.h"
#include "haptics/force/series/series_body.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace palp
{

/// All the servo thread knows of the world. Replaced whole, through Latest<Scene>.
struct Scene
{
  std::shared_ptr<const Surface> surface; ///< null: nothing to touch
  ForceLaw law{ SphereTip{ .radius = 0.01 },
    Material{ .youngModulus = 50e3, .poissonRatio = 0.33 } };
  ContactRule rule = ContactRule::Exact;
  double damping = 0.0;      ///< b [N s/m], 0 or more
  double forceLimit = 4.0;   ///< [N], at most what the device can bear
  std::uint64_t version = 0; ///< another number with another surface or law
  bool armed = false;        ///< the user wants to feel force; after a fault: off, then on again
  std::shared_ptr<const NoduleField> nodules{};      ///< felt by the law's tool; null: none
  std::shared_ptr<const StiffnessField> stiffness{}; ///< likewise; null: the same everywhere
  std::shared_ptr<const SeriesBody> series{};        ///< likewise; null: the body does not give way

  /// More organs, each with a surface, law, damping, nodules, stiffness and compliance of its own;
  /// in all else, the tool of the law included, as this one.
  std::vector<Scene> others{};
};

/// Sharp edges are none where the body's compliance tells what gives way at them.
[[nodiscard]] inline CurvatureOf curvatureOf(const Scene& scene) noexcept
{
  return scene.series != nullptr ? CurvatureOf::Faces : CurvatureOf::All;
}

/// Of a tool with the first organ.
/// @realtime  pure; no allocation, no lock, no exception
[[nodiscard]] inline Contact findContact(const Scene& scene, const ToolPose& pose) noexcept
{
  return findContact(*scene.surface, scene.law.tip(), pose, scene.rule, curvatureOf(scene));
}

/// How many organs something tells of.
template <typename Told>
[[nodiscard]] int organCount(const Told& first) noexcept
{
  return 1 + static_cast<int>(first.others.size());
}

/// Of what is told of several organs, that of one: the first, or one of its others.
/// @param organ  see Sample
template <typename Told>
[[nodiscard]] const Told& organOf(const Told& first, int organ) noexcept
{
  return organ == 0 ? first : first.others[static_cast<std::size_t>(organ) - 1];
}

} // namespace palp
