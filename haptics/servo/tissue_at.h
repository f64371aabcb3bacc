#pragma once

#include "haptics/force/maps/stiffness_field.h"
#include "haptics/servo/scene.h"

#include <optional>

namespace palp
{

/// What the tissue of a scene answers at a contact: its law, with the map of its stiffness and its
/// nodules where it has such, in series with its body where that gives way.
class TissueAt
{
public:
  /// @param scene, contact  outlive this object
  /// @realtime              no allocation, no lock, no exception; the others likewise
  /// @threadsafe            no, as the last answer is kept
  TissueAt(const Scene& scene, const Contact& contact) noexcept;

  /// Whether a tissue may push a tool aside: else lateral() is zero everywhere.
  [[nodiscard]] static bool pushesAside(const Scene& scene) noexcept;

  /// As if the contact were another depth there; at the last that was asked for nothing.
  [[nodiscard]] Response operator()(double depth) const noexcept
  {
    return answer(depth).felt;
  }

  /// The same with how deep the tool is in the body.
  [[nodiscard]] SeriesResponse answer(double depth) const noexcept
  {
    if (depth != askedDepth_)
    {
      asked_ = find(depth);
      askedDepth_ = depth;
    }
    return asked_;
  }

  /// What a tool brings in on its way to a depth [J].
  [[nodiscard]] double energy(double depth) const noexcept;

  /// Of what the tissue pushes the tool aside with, while it stays where it touches [N].
  [[nodiscard]] Eigen::Vector3d lateral(const SeriesResponse& answer) const noexcept;

private:
  [[nodiscard]] Response plain(double depth) const noexcept;
  [[nodiscard]] Response local(double depth) const noexcept;
  [[nodiscard]] SeriesResponse find(double depth) const noexcept;
  [[nodiscard]] Eigen::Vector3d lateralOfShape(const SeriesResponse& answer) const noexcept;
  [[nodiscard]] const SeriesLaw::Loaded& load(double force) const noexcept; // of the body

  const Scene* scene_;
  const Contact* contact_;
  ContactGeometry geometry_; // as the law is asked
  std::optional<StiffnessField::Blend> stiffness_;
  std::optional<NoduleField::Local> nodules_;
  std::optional<SeriesBody::Below> body_;
  Response plain_{}; // of the law alone, at the depth of the contact
  mutable double askedDepth_;
  mutable SeriesResponse asked_{};   // there, of all of it
  mutable double loadedForce_ = 0.0; // that the body was last asked for [N]
  mutable SeriesLaw::Loaded loaded_{};
};

} // namespace palp
