#pragma once

#include "haptics/force/large_strain.h"
#include "haptics/force/linear/coating.h"
#include "haptics/force/linear/half_space.h"
#include "haptics/force/linear/layer.h"
#include "haptics/force/relaxation/contact_rows.h"
#include "haptics/force/relaxation/prony_series.h"
#include "haptics/material.h"
#include "haptics/tip/tip.h"

#include <array>
#include <limits>
#include <memory>

namespace palp
{

/// What the law may know of the place that is pressed. Everything but the depth has a
/// neutral default, under which the body is a half-space pressed straight.
struct ContactGeometry
{
  double depth = 0.0;                                         ///< delta [m]
  double tilt = 0.0;                                          ///< tool axis to inward normal [rad]
  double thickness = std::numeric_limits<double>::infinity(); ///< of the body under the tool [m]
  double surfaceCurvature = 0.0;                              ///< mean, 1/R0 [1/m], convex positive
  double curvatureSpread = 0.0; ///< half the difference of the principal curvatures [1/m]
  double normalSpread = 0.0;    ///< of the normals below the tool, rms [rad]; told by Validity
  double hollow = 0.0;          ///< part of it above a hollow within the body [-]; likewise
};

/// What the tissue answers.
struct Response
{
  double force = 0.0;         ///< F [N] along the outward normal, 0 or more
  double contactRadius = 0.0; ///< r [m], at most the base radius
  double stiffness = 0.0;     ///< dF/ddepth [N/m]
};

/// Which law answers.
enum class LawMode
{
  Paper,     ///< Eqs. (2)-(5) for sphere and cone, exact for other tips; nothing else
  Exact,     ///< the exact linear half-space for every tip; nothing else
  Corrected, ///< the exact law with every factor that is switched on
};

/// What the tissue is made of, under large strain.
enum class ConstitutiveModel
{
  Linear,
  NeoHookean, ///< by the ratio of LawSettings::largeStrain; as linear where there is none
};

/// What the corrected law takes into account.
struct LawSettings
{
  LawMode mode = LawMode::Paper;
  Base base = Base::Unset;
  ConstitutiveModel constitution = ConstitutiveModel::NeoHookean;
  LargeStrainTable largeStrain{}; ///< null: the ratio is 1; of a body without coatings
  Coatings coatings{};            ///< on the body, whose thickness counts theirs
  bool curvature = true;
  bool thickness = true;
  bool inclination = true;
  PronySeries relaxation{}; ///< of the modulus, whose instantaneous value the material has
  double friction = 0.0; ///< mu between tool and tissue [-], 0 or more; no liver's value is known
};

/// One named correction: the force with it over the force without it.
struct Factor
{
  const char* name;
  double value; ///< [-]
};

/// The corrections in the order in which they act; the paper's force times all of them is the
/// law's. A tip without a paper's law begins with its exact one.
using Factors = std::array<Factor, 7>;

/// Reaction of soft tissue to a rigid tip: Eq. (1), F = Phi(tip, depth, E, nu).
///
/// Built while setting up; asked inside the servo loop.
class ForceLaw
{
public:
  /// @param material  of the body, below its coatings
  /// @throws Error    BadValue: see checkedTip, makeMaterial and CoatedBody
  ForceLaw(const Tip& tip, const Material& material, LawSettings settings = {});

  /// @param local  where and how deep; depth of 0 or less, or not finite, is no contact
  /// @source       Eqs. (2)-(5)
  /// @realtime     pure; no allocation, no lock, no exception
  [[nodiscard]] Response operator()(const ContactGeometry& local) const noexcept;

  /// @param thickness  of a body where it is thickest [m]
  /// @throws Error     BadValue: the coatings that act leave nothing of it below them
  void checkBody(double thickness) const;

  /// The law at one place, taken apart: shape, curvature, ellipse, thickness, large_strain,
  /// inclination, coatings; 1 where nothing acts.
  ///
  /// @realtime  pure; no allocation, no lock, no exception
  [[nodiscard]] Factors factors(const ContactGeometry& local) const noexcept;

  /// The ratio of large strain at one place, with whether the table covers it.
  /// @realtime  pure; no allocation, no lock, no exception
  [[nodiscard]] LargeStrainGrid::Ratio largeStrain(const ContactGeometry& local) const noexcept;

  /// Half the difference of the principal curvatures of the gap over their mean; 0 where no ellipse
  /// is formed.
  /// @realtime  pure; no allocation, no lock, no exception
  [[nodiscard]] double gapSpread(const ContactGeometry& local) const noexcept;

  /// Factor of the ellipse; 1 where none is formed.
  /// @realtime  pure; no allocation, no lock, no exception
  [[nodiscard]] double ellipse(const ContactGeometry& local) const noexcept;

  /// The best law known here for the same tip and tissue: every correction switched on.
  [[nodiscard]] ForceLaw corrected() const;

  [[nodiscard]] const Tip& tip() const noexcept
  {
    return tip_;
  }
  [[nodiscard]] const Material& material() const noexcept
  {
    return material_;
  }
  [[nodiscard]] const LawSettings& settings() const noexcept
  {
    return settings_;
  }

  /// The law on a half-space as rows, in which tissue relaxes and rubs; null where it does neither.
  [[nodiscard]] const ContactRows* rows() const noexcept;

private:
  struct Corrections;

  [[nodiscard]] Response paper(double depth) const noexcept;
  [[nodiscard]] LargeStrainGrid::Ratio largeStrainByRadius(
    const ContactGeometry& local) const noexcept;
  [[nodiscard]] LinearContact uncoated(const ContactGeometry& local) const noexcept;
  [[nodiscard]] LinearContact linear(const ContactGeometry& local) const noexcept;
  [[nodiscard]] double layerThickness(const ContactGeometry& local) const noexcept;

  Tip tip_;
  Material material_;
  LawSettings settings_;
  HalfSpace halfSpace_;
  std::shared_ptr<const Corrections> corrections_; // only of the corrected law
};

} // namespace palp
