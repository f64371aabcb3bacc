#pragma once

#include "haptics/force/relaxation/friction_rows.h"
#include "haptics/force/relaxation/relaxing_contact.h"
#include "haptics/servo/coupling.h"
#include "haptics/servo/organ_touch.h"
#include "haptics/servo/sample.h"
#include "haptics/servo/scene.h"
#include "haptics/servo/tissue_at.h"

#include <Eigen/Core>
#include <cstdint>
#include <optional>

namespace palp
{

/// What a scene remembers from tick to tick: which of several organs is touched, and of its tissue,
/// where the law relaxes or rubs, the past. One organ forgets it when another is touched.
///
/// What is remembered goes with the tool while it touches; what a lifted tool has left fades with
/// the distance at which it comes back, and is gone beyond the radius of the contact that left it.
/// A tick is begin, any number of questions, settle. Belongs to the thread that steps the scene.
class TissueMemory
{
public:
  /// Of a scene with several organs; of any other it tells of the first.
  [[nodiscard]] OrganTouch& touch() noexcept
  {
    return touch_;
  }

  /// Looks at the tissue of a contact; takes time and the tool's motion from what it remembers, and
  /// forgets all where the scene is another.
  ///
  /// @param scene     the organ that the sample tells of
  /// @param sample    pose and contact of this tick, which outlives it
  /// @param dt        since the last tick [s]
  /// @return          whether the law of the scene has a memory; if not, tissue() is all there is
  /// @realtime        no allocation, no lock, no exception
  bool begin(const Scene& scene, const Sample& sample, double dt) noexcept;

  /// What is touched in this tick, as if it had no past; after begin() only.
  [[nodiscard]] const TissueAt& tissue() const noexcept
  {
    return *tissue_;
  }

  /// The law of this tick; without a contact radius.
  /// @realtime  pure; no allocation, no lock, no exception
  [[nodiscard]] Response at(double depth) const noexcept;

  /// Ends the tick.
  ///
  /// @param felt       what the tool feels of the law, at its proxy
  /// @param stiffest   that may be rendered [N/m]; 0 or less: no friction
  /// @param sample     gets the friction, the depth of the surface, the radius of the contact
  /// @return           friction on the tool [N]
  /// @realtime         no allocation, no lock, no exception
  Eigen::Vector3d settle(const Rendered& felt, double stiffest, Sample& sample) noexcept;

private:
  void forget(const Scene& scene, int organ) noexcept;
  void returnTo(const Contact& contact) noexcept;
  [[nodiscard]] Eigen::Vector3d drag(
    const Rendered& felt, double stiffest, const Eigen::Vector3d& normal) noexcept;
  [[nodiscard]] Response elastic(double depth) const noexcept;

  OrganTouch touch_;
  RelaxingContact contact_;
  FrictionRows friction_;
  std::optional<ContactRows> rows_; // of this place; none: nothing has begun
  std::uint64_t version_ = 0;
  int organ_ = 0;
  const ForceLaw* law_ = nullptr;                   // of this tick
  std::optional<TissueAt> tissue_;                  // likewise
  Eigen::Vector3d apex_ = Eigen::Vector3d::Zero();  // last known [m]
  Eigen::Vector3d moved_ = Eigen::Vector3d::Zero(); // since the last tick [m]
  Eigen::Vector3d left_ = Eigen::Vector3d::Zero();  // apex when it last touched [m]
  double radius_ = 0.0;                             // of the widest contact that the dent is of [m]
  bool touched_ = false;                            // last tick
};

} // namespace palp
