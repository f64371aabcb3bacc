#include "app/train/score_sheet.h"

#include "app/input/tip_text.h"
#include "haptics/files/csv_text.h"
#include "haptics/files/fixed_text.h"
#include "haptics/files/input_text.h"
#include "haptics/files/replace_file.h"
#include "haptics/units.h"

#include <nlohmann/json.hpp>

#include <cmath>

namespace palp
{
namespace
{

using Json = nlohmann::ordered_json;
using units::toMillimeters;

std::string percent(double fraction)
{
  return fixed(1e2 * fraction, 1);
}

Json millimeters(const Eigen::Vector3d& place)
{
  Json json = Json::array();
  for (const double value : place)
  {
    json.push_back(std::round(1e6 * value) / 1e3);
  }
  return json;
}

double rounded(double value)
{
  return std::round(1e6 * value) / 1e6;
}

Json nodulesOf(const Grade& grade)
{
  Json all = Json::array();
  for (const GradedNodule& one : grade.nodules)
  {
    Json& nodule = all.emplace_back(Json{ { "above_mm", millimeters(one.above) },
      { "center_mm", millimeters(one.nodule.nodule.center) },
      { "radius_mm", rounded(toMillimeters(one.nodule.nodule.radius)) },
      { "cover_mm", rounded(toMillimeters(one.nodule.below().top)) },
      { "ratio", rounded(one.nodule.nodule.ratio) } });
    nodule["found_by_mark"] = one.foundBy ? Json(*one.foundBy + 1) : Json(nullptr);
  }
  return all;
}

Json marksOf(const Grade& grade)
{
  Json all = Json::array();
  for (const GradedMark& one : grade.marks)
  {
    all.push_back({ { "time_s", one.time }, { "place_mm", millimeters(one.place) },
      { "nearest_nodule", one.nearest + 1 }, { "distance_mm", rounded(toMillimeters(one.error)) },
      { "near", one.isNear } });
  }
  return all;
}

std::string jsonText(const ScoreSheet& sheet)
{
  Json json{ { "palp_score", 1 }, { "body", sheet.body }, { "tool", sheet.tool },
    { "level", sheet.level.name }, { "seed", sheet.plan.seed },
    { "passed", sheet.grade.isPassed } };
  for (const Measure& one : measuresOf(sheet))
  {
    json["measures"][one.name] = one.value.empty() ? Json(nullptr) : Json::parse(one.value);
  }
  json["nodules"] = nodulesOf(sheet.grade);
  json["marks"] = marksOf(sheet.grade);
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

std::string csvText(const ScoreSheet& sheet)
{
  std::string text = "measure,value,source\n";
  for (const Measure& one : measuresOf(sheet))
  {
    text += one.name + ',' + one.value + ',' + csvField(one.source) + '\n';
  }
  return text;
}

} // namespace

ScoreSheet scoreSheetOf(const std::string& body, const Scene& scene,
  std::span<const Sample> samples, const TrainingPlan& plan)
{
  const Curriculum curriculum = shippedCurriculum();
  Grade grade = gradeSearch(scene, samples, plan, curriculum);
  const std::string next = grade.isPassed ? curriculum.levelAfter(plan.level) : "";
  return { .body = body,
    .tool = describeTip(scene.law.tip()),
    .plan = plan,
    .level = curriculum.level(plan.level),
    .hitWithin = curriculum.hitWithin,
    .next = next,
    .grade = std::move(grade) };
}

std::vector<Measure> measuresOf(const ScoreSheet& sheet)
{
  const Grade& grade = sheet.grade;
  const auto count = [](std::size_t value) { return std::to_string(value); };
  const char* free = "free response: Chakraborty, Acad. Radiol. 20:915, 2013";
  const char* force = "Laufer et al., NEJM 372:784, 2015";
  return {
    { "nodules", "Nodules hidden", count(grade.nodules.size()), "", free },
    { "hits", "Found", count(grade.hits), "", free },
    { "misses", "Missed", count(grade.nodules.size() - grade.hits), "", free },
    { "false_marks", "False marks", count(grade.falseMarks), "", free },
    { "repeated_marks", "More marks on a found one", count(grade.repeatedMarks), "", free },
    { "hits_by_chance", "Found by chance, with as many marks", fixed(grade.hitsByChance, 2), "",
      "area near the nodules over the area searched" },
    { "distance_error_mm", "Mean distance of hits",
      grade.meanError ? fixed(toMillimeters(*grade.meanError), 1) : "", "mm",
      "deformation-based tactile feedback, Robot. Auton. Syst., 2012" },
    { "time_s", "Time, first to last touch", fixed(grade.time, 1), "s",
      "Fletcher et al., JAMA 253:2224, 1985" },
    { "peak_force_N", "Peak force", fixed(grade.peakForce, 2), "N", force },
    { "mean_force_N", "Mean force", fixed(grade.meanForce, 2), "N", force },
    { "coverage_percent", "Surface covered", percent(grade.coverage), "%",
      "Saunders et al., Cancer 58:2531, 1986" },
    { "too_hard_percent", "Time too hard", percent(grade.tooHard), "%",
      "over 6 N: remote palpation of lung, ICRA 2012" },
    { "too_soft_percent", "Time too soft", percent(grade.tooSoft), "%",
      "contact radius below " + fixed(toMillimeters(grade.softRadius), 1) +
        " mm, at which the deepest nodules stand out most: Eshelby, flat punch" },
    { "path_length_mm", "Path of the tool while it touches",
      fixed(toMillimeters(grade.pathLength), 0), "mm",
      "Datta et al., J. Am. Coll. Surg. 193:479, 2001" },
  };
}

std::string summaryOf(const Grade& grade)
{
  return std::to_string(grade.hits) + " of " + counted(grade.nodules.size(), "nodule") +
    " found, " + counted(grade.falseMarks, "false mark");
}

void writeScore(const std::filesystem::path& folder, const ScoreSheet& sheet)
{
  replaceFile(folder / kScoreFiles[0], jsonText(sheet));
  replaceFile(folder / kScoreFiles[1], csvText(sheet));
  replaceFile(folder / kScoreFiles[2], scorePage(sheet));
}

} // namespace palp
