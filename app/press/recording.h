#pragma once

#include "app/input/mesh_file.h"
#include "app/input/organ_plan.h"
#include "app/press/calibration.h"
#include "haptics/force/validity.h"
#include "haptics/servo/sample.h"
#include "haptics/servo/scene.h"

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace palp
{

/// A part of a recording's samples that were moved down or left out, from `to` up to `from`, while
/// it is bounded: they are none of it.
struct Gap
{
  std::size_t to = 0;
  std::size_t from = 0;
  std::size_t thinsTo = 0; ///< up to where others are left out; 0: there is no gap
};

/// What another hand did at the same time, with a tool and a tissue like the first's.
struct SecondHand
{
  std::string device{};
  std::vector<Sample> samples{}; ///< see Recording, as the others
  std::size_t thinned = 0;
  double interval = 0.1;
  Gap gap{};
};

/// Who pressed what, and everything that was measured. Of a tool that rests away from the surface
/// only the first and the last sample are kept; of a long recording, see bound().
struct Recording
{
  std::string mesh{};               ///< file name, for people
  std::string unit{};               ///< that its coordinates were read in
  std::string device{};             ///< hand, mouse, path:NAME
  std::vector<MeshFile> files{};    ///< that were felt
  std::string command{};            ///< see commandLine
  std::vector<std::string> names{}; ///< of its presses, in their order; empty: was removed
  std::vector<OrganPlan> organs{};  ///< of its scene, also those that are not felt; none: one body
  Scene scene{};
  std::vector<Sample> samples{};
  std::size_t thinned = 0;            ///< of these the first, between which others were left out
  double interval = 0.1;              ///< of which of those only the extremes are kept [s]
  Gap gap{};                          ///< none but between two calls of boundSome
  bool rated = true;                  ///< how far each sample may be believed is told, too
  bool contactOnly = false;           ///< see keepContact
  std::optional<SecondHand> second{}; ///< none: one hand, of which all else tells

  /// Of an organ of its scene, as in a Sample; empty where there is but one body.
  [[nodiscard]] std::string organName(int organ) const;

  /// All but the first hand's samples, which may be many.
  [[nodiscard]] Recording head() const;

  /// The first sample of the largest depth; nothing when the tool never touched.
  [[nodiscard]] const Sample* deepest() const noexcept;

  /// Whether any hand touched, while the first was there.
  [[nodiscard]] bool isTouched() const noexcept;

  /// Of all hands.
  [[nodiscard]] std::size_t sampleCount() const noexcept
  {
    return samples.size() + (second ? second->samples.size() : 0);
  }

  /// The samples of the last contact without a gap; the present one, where the tool touches.
  [[nodiscard]] std::span<const Sample> lastPress() const noexcept;
};

constexpr std::size_t kKeptWhole = 600'000; ///< samples, ten minutes

/// Bounds a recording that grows: of what is older than the last `kept` samples those stay that
/// have the least and the largest depth and force within each interval, which doubles where they
/// are too many. Never more than 1.2 times `kept` stay, the deepest among them, in memory that is
/// taken once.
/// @param kept  a multiple of 1000
void bound(Recording& recording, std::size_t kept = kKeptWhole);

/// A part of that, as all of it takes longer than a picture may wait: samples may be added before
/// the next, but those that are there are not to be looked at while there is a gap, see closeGap.
/// @param most  samples of each hand that are moved, about
void boundSome(Recording& recording, std::size_t most, std::size_t kept = kKeptWhole);

/// Does the rest at once, if there is any.
void closeGap(Recording& recording);

/// The same of all samples of a recording that has ended.
void thin(Recording& recording);

/// Adds the samples of another recording, of whole samples as these are; later where their times
/// are not.
void append(Recording& recording, std::vector<Sample> samples);

/// Leaves the samples of contact, each with the one before and the one after it, and the header
/// that says so; where nothing touches, the first and the last.
void keepContact(Recording& recording);

/// The first sample of the largest depth; null where none touches.
[[nodiscard]] const Sample* deepestOf(std::span<const Sample> samples) noexcept;

/// What each nodule of a scene alone adds to the force at a contact, over that without any [-];
/// none where there are none.
[[nodiscard]] std::vector<double> contrastsAt(const Scene& scene, const Contact& contact);

/// What the law of a scene is asked at a contact: where the body gives way, what is left of the
/// depth, without what is below.
[[nodiscard]] ContactGeometry lawGeometryOf(const Scene& scene, const Contact& contact);

/// The conditions of the law at a contact, those of its nodules, of its map and of its organ file
/// after them where there are any; without such a file whether the body may bend there.
[[nodiscard]] std::vector<Rule> rulesAt(
  const Scene& scene, const Validity& validity, const Contact& contact);

/// A sample of one hand or of two.
struct HandSample
{
  const Sample* sample;
  const Sample* other; ///< the last before it of the other hand; null: none
  int hand;            ///< 1 or 2
};

/// Those of all hands in the order of their times.
void forEachInOrder(const Recording& recording, const std::function<void(const HandSample&)>& each);

/// Whether the contact of another hand is so far that neither dent reaches the other's: each force
/// knows of one tool. Holds where one of them does not touch, or touches another organ.
[[nodiscard]] Rule betweenRule(
  const Calibration& calibration, const Sample& sample, const Sample& other);

/// The conditions of each organ's law, in the order of the scene.
[[nodiscard]] std::vector<Validity> validityOf(const Scene& scene);

/// Writes samples.csv: a header of comment lines, the column names with units, one row per sample.
///
/// Each row tells what its force was computed from: the place (thickness, infinite where there is
/// none below; mean curvature, convex positive, and half the difference of the principal ones) and
/// the factors of the law there, by which force_N is the product of the paper's force and theirs.
/// A tip without a paper's law begins with its exact one. Of several organs it names the one that
/// is touched, which all of the row tells of. Of two hands it names the hand, the rows of both in
/// the order of their times.
///
/// Times, positions and forces sent read back to the last bit. The same recording gives the same
/// bytes: no date, no host.
///
/// @param calibration  R_d(depth) for the column extent_radius_mm, 0 when
///                     apart; null: no such column
void writeSamples(std::ostream& out, const Recording& recording, const Calibration* calibration);

} // namespace palp
