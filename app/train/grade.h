#pragma once

#include "app/input/scene_plan.h"
#include "app/train/curriculum.h"
#include "app/train/search_area.h"
#include "haptics/force/nodules/nodule_field.h"
#include "haptics/servo/sample.h"
#include "haptics/servo/scene.h"

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace palp
{

/// A place that was marked, and what is there.
struct GradedMark
{
  double time;             ///< [s]
  Eigen::Vector3d place;   ///< on the undeformed surface, that was touched last [m]
  std::size_t nearest = 0; ///< nodule
  double error = 0.0;      ///< to the surface right above that one [m]
  bool isNear = false;     ///< it is within Curriculum::hitWithin of it
};

/// A nodule that was hidden, and who found it.
struct GradedNodule
{
  EmbeddedNodule nodule;
  Eigen::Vector3d above;              ///< on the surface [m]
  std::optional<std::size_t> foundBy; ///< the first mark near it; none: missed
};

/// How well hidden nodules were found.
struct Grade
{
  std::vector<GradedNodule> nodules;
  std::vector<GradedMark> marks;

  /// Found nodules. The first mark near a nodule finds it; more marks there count for nothing, one
  /// that is near none is false.
  /// @source  Chakraborty, Acad. Radiol. 20:915, 2013; how near: Haygood et al., Br. J. Radiol.
  ///          86:42313554, 2013: the size of the larger lesions
  std::size_t hits = 0;
  std::size_t falseMarks = 0;    ///< likewise
  std::size_t repeatedMarks = 0; ///< likewise

  /// Hits that as many marks would make on average at random places of what is searched.
  /// @source  1 - (1 - p)^n for each nodule, p the part of the area that is near it
  double hitsByChance = 0.0;

  /// Mean error of the hits [m]; none without one.
  /// @source  deformation-based tactile feedback, Robot. Auton. Syst., 2012: 11 to 18 mm in models
  /// of tissue
  std::optional<double> meanError{};

  /// From the first touch to the last [s].
  /// @source  Fletcher et al., JAMA 253:2224, 1985: the longer, the more is found, r = 0.59
  double time = 0.0;

  /// While the tool touches, of the force of the law [N].
  /// @source  Laufer et al., NEJM 372:784, 2015: who presses too lightly misses deep masses
  double peakForce = 0.0;
  double meanForce = 0.0; ///< likewise, over time

  /// The part of what is searched that was under the tool [-].
  /// @source  Saunders, Pilgrim, Pennypacker, Cancer 58:2531, 1986
  double coverage = 0.0;

  /// Part of the time of touch over Curriculum::hardForce [-].
  /// @source  remote palpation of bovine lung, ICRA 2012: 93 % of tumors found, never over 6 N
  double tooHard = 0.0;

  /// Part of the time of touch with a contact narrower than softRadius [-].
  /// @source  the stiffness that a nodule at depth z adds to a contact of radius a is as
  ///          a z^4 / (a^2 + z^2)^2 over a, largest at a = z / sqrt 7 (Eshelby, flat punch)
  double tooSoft = 0.0;
  double softRadius = 0.0; ///< for the deepest nodule that the level may have [m]

  /// Of the apex while the tool touches [m].
  /// @source  Datta et al., J. Am. Coll. Surg. 193:479, 2001
  double pathLength = 0.0;

  bool isPassed = false; ///< all are found, with no more false marks than the curriculum allows

  SearchArea area{};
  std::vector<bool> touched{}; ///< of its points, which were under the tool
};

/// Grades a search. The same samples give the same grade.
///
/// @param scene    with the nodules that were hidden, its only ones
/// @param samples  of it, in their order
/// @param plan     with marks, each at the place that was touched last
/// @throws Error   BadValue: no marks are given, or one comes before the first touch; as
///                 Curriculum::level, searchAreaOf
[[nodiscard]] Grade gradeSearch(const Scene& scene, std::span<const Sample> samples,
  const TrainingPlan& plan, const Curriculum& curriculum);

} // namespace palp
