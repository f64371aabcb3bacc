#pragma once

#include "app/train/grade.h"

#include <filesystem>
#include <string>
#include <vector>

namespace palp
{

/// What a search was, and how well it went.
struct ScoreSheet
{
  std::string body; ///< that was searched, for people
  std::string tool; ///< as options take it
  TrainingPlan plan;
  TrainingLevel level;
  double hitWithin; ///< [m]
  std::string next; ///< level that comes after it; empty: it is the last, or not passed
  Grade grade;
};

/// One figure of a sheet.
struct Measure
{
  std::string name;  ///< with its unit, as a column
  std::string title; ///< for people
  std::string value; ///< a number; empty where there is none
  std::string unit;  ///< empty: a number of things
  std::string source;
};

[[nodiscard]] ScoreSheet scoreSheetOf(const std::string& body, const Scene& scene,
  std::span<const Sample> samples, const TrainingPlan& plan); ///< Error: as gradeSearch

/// All of a sheet's figures, each with who took it as a measure.
[[nodiscard]] std::vector<Measure> measuresOf(const ScoreSheet& sheet);

/// "2 of 3 nodules found, 1 false mark".
[[nodiscard]] std::string summaryOf(const Grade& grade);

/// The names of the files that writeScore leaves.
inline const std::vector<std::string> kScoreFiles{ "score.json", "score.csv", "score.html" };

/// Writes score.json (all of it, with nodules and marks), score.csv (the figures) and score.html
/// (one page, with a map). The same sheet gives the same bytes: no date, no host.
/// @throws Error  BadFile: cannot be written
void writeScore(const std::filesystem::path& folder, const ScoreSheet& sheet);

/// The page.
[[nodiscard]] std::string scorePage(const ScoreSheet& sheet);

} // namespace palp
