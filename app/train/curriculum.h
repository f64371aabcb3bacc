#pragma once

#include <string>
#include <vector>

namespace palp
{

/// What the nodules of a training are like, each within these.
struct TrainingLevel
{
  struct Span
  {
    double low;
    double high;
  };

  std::string name;  ///< as options take it
  std::string title; ///< for people
  int nodules;       ///< as many as are hidden
  Span radius;       ///< [m]
  Span cover;        ///< depth of the highest point [m]
  Span ratio;        ///< stiffness over that of the tissue [-]
  double depth;      ///< of the press under which they are noticed [m]
  double contrast;   ///< that each has at least under it, as palp detect computes it [-]
};

/// The levels from the first to the last, and what holds for all of them.
struct Curriculum
{
  double hitWithin;   ///< of the place above a nodule, that a mark finds it [m]
  double hardForce;   ///< over which a press is too hard [N]
  int mostFalseMarks; ///< with which a level is passed
  std::vector<TrainingLevel> levels;

  /// @throws Error  BadValue: no such level; lists them
  [[nodiscard]] const TrainingLevel& level(
    const std::string& name, const std::string& what = "--difficulty") const;

  /// Its name; empty after the last.
  [[nodiscard]] std::string levelAfter(const std::string& name) const;
};

/// @param file    stands before each message
/// @throws Error  BadFile: not of this form, or a value out of range, by its key
[[nodiscard]] Curriculum parseCurriculum(const std::string& text, const std::string& file);

/// data/training.json: from nodules that are large, shallow and hard to small, deep and soft ones.
/// In models of the breast physicians found 87 % of lumps of 1 cm and 14 % of 0.3 cm, 56 % of hard
/// and 40 % of soft ones.
/// @throws Error  BadFile: as parseCurriculum
/// @source        Fletcher, O'Malley, Bunce, JAMA 253:2224, 1985
[[nodiscard]] Curriculum shippedCurriculum();

/// The file that it stands in.
inline constexpr const char* kCurriculumFile = "training.json";

} // namespace palp
