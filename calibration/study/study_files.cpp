#include "calibration/study/study_files.h"

#include "calibration/study/curve_fit.h"
#include "calibration/tables/extent_table.h"
#include "calibration/tables/table_tool.h"
#include "haptics/error.h"
#include "haptics/files/csv_text.h"
#include "haptics/files/number_table.h"
#include "haptics/files/replace_file.h"
#include "haptics/units.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

namespace palp::fem
{
namespace
{

using units::toMillimeters;

std::ostringstream text(const std::string& header, const char* columns)
{
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out.precision(12);
  out << header << columns << '\n';
  return out;
}

std::string noteOf(const Outcome& outcome)
{
  return outcome.error.empty() ? "" : "# incomplete: " + outcome.error + "\n";
}

nlohmann::json json(const PolynomialFit& fit)
{
  return { { "coefficients_mm", fit.coefficients }, { "rms_mm", fit.rms },
    { "largest_residual_mm", fit.worst }, { "up_to_depth_mm", fit.upTo } };
}

constexpr const char* kColumns = "depth_mm,radius_mm,ur_mm,uz_mm"; // of the profiles
std::string coatingsText(const Coatings& coatings, int digits)
{
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out.precision(digits);
  for (const Coating& coating : coatings.all())
  {
    out << "\n# under the tool first: " << toMillimeters(coating.thickness) << " mm of "
        << units::toKilopascals(coating.material.youngModulus)
        << " kPa, nu = " << coating.material.poissonRatio << ", bonded to what is below";
  }
  return out.str();
}

std::string noduleText(const Inclusion& nodule, int digits)
{
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out.precision(digits);
  if (nodule.radius > 0.0)
  {
    out << "\n# on the axis: a ball of " << toMillimeters(nodule.radius) << " mm, its top "
        << toMillimeters(nodule.top) << " mm deep, of "
        << units::toKilopascals(nodule.material.youngModulus) << " kPa";
  }
  return out.str();
}

} // namespace

std::string describe(const Case& study, const Body& body, int digits)
{
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out.precision(digits);
  out << "# palp " << PALP_VERSION << ": " << study.name << '\n'
      << kToolLine << toolInWords(study.tip, digits)
      << "; depth counted from its tip\n# block: " << toMillimeters(study.width) << " x "
      << toMillimeters(study.length) << " x " << toMillimeters(study.height) << " mm, base "
      << (study.base == Base::Slip ? "slipping" : "bonded")
      << ", sides free, frictionless\n# material: "
      << units::toKilopascals(study.material.youngModulus)
      << " kPa, nu = " << study.material.poissonRatio << ", " << name(study.energy) << ": "
      << formula(study.energy) << coatingsText(study.coatings, digits)
      << noduleText(study.nodule, digits)
      << (study.map.young ? "\n# Young's modulus [kPa] by x = r and z below the surface [mm]: "
                          : "")
      << study.map.words << "\n# model: "
      << (study.model == BodyModel::Axisymmetric
             ? "axisymmetric, cylinder of equal area, eight-node quadrilaterals"
             : "volumetric block, eight-node bricks, one quarter")
      << ", " << body.elements.size() << " elements, " << body.nodeCount() << " nodes"
      << "\n# element size under the tool: " << toMillimeters(body.elementSize)
      << " mm, smaller where a shallow contact needs it\n# extent_radius_mm: deformed radius at "
         "which the surface sinks by "
      << toMillimeters(study.threshold) << " mm; it does not depend on Young's modulus"
      << (study.coatings.empty() ? "" : ", only on its ratios") << '\n';
  return out.str();
}

std::string tableText(const Case& study, const std::string& header, const Outcome& outcome)
{
  auto table = text(header + noteOf(outcome), ExtentTable::kHeader);
  for (const IndentationStep& step : outcome.steps)
  {
    table << toMillimeters(step.depth) << ','
          << toMillimeters(extentRadius(step.profile, study.threshold)) << ',' << step.force << ','
          << toMillimeters(step.contactRadius) << '\n';
  }
  return table.str();
}

std::vector<IndentationStep> readSteps(const std::filesystem::path& folder)
{
  std::vector<IndentationStep> steps;
  for (const auto& [row, line] :
    NumberTable::readFinite(folder / kTable, ExtentTable::kHeader).rows)
  {
    IndentationStep step;
    step.depth = units::fromMillimeters(row[0]);
    step.force = row[2];
    step.contactRadius = units::fromMillimeters(row[3]);
    steps.push_back(step);
  }
  std::size_t at = 0;
  for (const auto& [row, line] : NumberTable::readFinite(folder / kProfiles, kColumns).rows)
  {
    const double depth = units::fromMillimeters(row[0]);
    while (at < steps.size() && steps[at].depth < depth)
    {
      ++at;
    }
    if (at < steps.size() && steps[at].depth == depth)
    {
      steps[at].profile.push_back({ units::fromMillimeters(row[1]), units::fromMillimeters(row[2]),
        units::fromMillimeters(row[3]) });
    }
  }
  return steps;
}

namespace
{

// a folder may be copied or renamed, and the case, which is named like it, is the same
Case unnamed(Case study)
{
  study.name.clear();
  return study;
}

} // namespace

StudyFiles::StudyFiles(OutputFolder& folder, const Case& study, const Body& body)
  : folder_(folder)
  , study_(study)
  , header_(describe(study, body))
  , key_(describe(unnamed(study), body, std::numeric_limits<double>::max_digits10) +
      "# squared distances of the nodes: " + shortest(body.positions.squaredNorm()))
{
}

void StudyFiles::write(const Outcome& outcome) const
{
  auto profiles = text(header_ + noteOf(outcome), kColumns);
  std::vector<double> depths;
  std::vector<double> extents;
  for (const IndentationStep& step : outcome.steps)
  {
    depths.push_back(toMillimeters(step.depth));
    extents.push_back(toMillimeters(extentRadius(step.profile, study_.threshold)));
    for (const auto& point : step.profile)
    {
      profiles << depths.back() << ',' << toMillimeters(point.radius) << ','
               << toMillimeters(point.ur) << ',' << toMillimeters(point.uz) << '\n';
    }
  }
  replaceFile(folder_.stage() / kProfiles, profiles.str());
  replaceFile(folder_.stage() / kTable, tableText(study_, header_, outcome));

  const ExtentFits fits = fitExtent(depths, extents);
  const nlohmann::json fitted{ { "of", "extent_radius_mm over depth_mm, lowest power first" },
    { "linear", json(fits.linear) }, { "quadratic", json(fits.quadratic) },
    { "linear_holds_to_depth_mm", fits.linearHoldsTo },
    { "linear_holds_means", "every residual below 3 percent of the largest radius" } };
  replaceFile(folder_.stage() / "fit.json", fitted.dump(2) + "\n");
  folder_.publish();
}

} // namespace palp::fem
