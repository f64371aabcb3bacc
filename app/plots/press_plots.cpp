#include "app/plots/press_plots.h"

#include "haptics/contact/contact_geometry_of.h"
#include "haptics/error.h"
#include "haptics/servo/tissue_at.h"
#include "haptics/units.h"
#include "pipeline/charts/plot_files.h"

#include <algorithm>
#include <span>

namespace palp
{
namespace
{

using namespace units::literals;

const char* nameOf(LawMode mode)
{
  switch (mode)
  {
    case LawMode::Paper:
      return "paper's law";
    case LawMode::Exact:
      return "exact half-space";
    case LawMode::Corrected:
      return "corrected law";
  }
  return "";
}

// the one in use first: the band is about it, and as felt where the body gives way
std::vector<NamedLaw> lawsToCompare(const Scene& scene, const Contact& contact)
{
  const ForceLaw& law = scene.law;
  const bool isInBody = scene.series != nullptr && contact.touching();
  const LawMode used = law.settings().mode;
  const std::string of = std::string(law.settings().coatings.empty() ? "" : ", without coatings") +
    (isInBody ? ", without the organ file" : "");
  const auto color = [](LawMode mode) { return static_cast<std::size_t>(mode); };
  std::vector<NamedLaw> laws{ { .name = nameOf(used),
    .law = law,
    .geometry = contact.touching() ? contactGeometryOf(contact) : ContactGeometry{},
    .color = color(used) } };
  if (isInBody)
  {
    laws.front().name += " in the body";
    laws.front().answer = [scene, contact](double depth)
    {
      Contact at = contact;
      at.depth = depth;
      return TissueAt(scene, at).answer(depth).felt.force;
    };
  }
  for (const LawMode mode : { LawMode::Paper, LawMode::Exact })
  {
    if (mode != used)
    {
      laws.push_back({ .name = nameOf(mode) + of,
        .law = ForceLaw(law.tip(), law.material(), LawSettings{ .mode = mode }),
        .color = color(mode) });
    }
  }
  return laws;
}

// a neo-Hookean body is as many times stiffer as its Young's modulus is larger
ReferenceCurve elementsOf(const Calibration& calibration, const ForceLaw& law)
{
  ReferenceCurve curve{ .name = "finite elements", .x = {}, .y = {} };
  if (calibration.young)
  {
    for (const ExtentTable::Extent& row : calibration.extents.rows())
    {
      if (row.force > 0.0)
      {
        curve.x.push_back(row.depth);
        curve.y.push_back(row.force * law.material().youngModulus / *calibration.young);
      }
    }
  }
  return curve;
}

// thinned out
ReferenceCurve forceCurveOf(std::span<const Sample> samples)
{
  constexpr double kStep = 0.1_mm;
  ReferenceCurve curve{ .name = "this press", .x = {}, .y = {} };
  double next = kStep;
  for (const Sample& sample : samples)
  {
    if (sample.contact.depth >= next)
    {
      curve.x.push_back(sample.contact.depth);
      curve.y.push_back(sample.response.force);
      next = sample.contact.depth + kStep;
    }
  }
  return curve;
}

} // namespace

Plots forceComparison(const Scene& scene, std::span<const Sample> press,
  const Calibration* calibration, const std::vector<ReferenceCurve>& others)
{
  const Sample* deepest = deepestOf(press);
  std::vector<ReferenceCurve> references = others;
  if (deepest)
  {
    const auto until = static_cast<std::size_t>(deepest - press.data());
    references.insert(references.begin(), forceCurveOf(press.first(until + 1)));
  }
  if (calibration)
  {
    references.push_back(elementsOf(*calibration, scene.law));
  }
  std::erase_if(references, [](const ReferenceCurve& curve) { return curve.x.empty(); });
  double depth = 1.0_mm;
  for (const ReferenceCurve& curve : references)
  {
    depth = std::max(depth, *std::max_element(curve.x.begin(), curve.x.end()));
  }
  const std::vector<NamedLaw> laws = lawsToCompare(scene, deepest ? deepest->contact : Contact{});
  Plots plots;
  plots.push_back(forcePlot(laws, depth, references));
  plots.push_back(forceErrorPlot(laws, depth, references));
  return plots;
}

Plots extentComparison(const Calibration& calibration)
{
  Plots plots;
  plots.push_back(extentPlot(calibration.extents, {}));
  return plots;
}

Plots sectionOf(
  vtkPalpDeformFilter& press, const Calibration& calibration, std::span<const PlacedNodule> nodules)
{
  Plots plots;
  const Contact& contact = press.GetPress().contact;
  if (contact.touching())
  {
    constexpr double kAcross = 0.9; // [-] cosine
    const Eigen::Vector3d towards = std::abs(contact.normal.x()) < kAcross
      ? Eigen::Vector3d(Eigen::Vector3d::UnitX())
      : Eigen::Vector3d(Eigen::Vector3d::UnitY());
    plots.push_back(sectionPlot(press, towards,
      calibration.elements && contact.depth <= calibration.elements->deepest()
        ? calibration.elements->at(contact.depth)
        : std::nullopt,
      nodules));
  }
  return plots;
}

void writePlots(const Plots& plots, vtkRenderWindow& window, const std::filesystem::path& file)
{
  const std::string ending = file.extension().string();
  if (ending == ".png")
  {
    writePng(window, file);
  }
  else if (ending == ".svg")
  {
    writeSvg(window, file);
  }
  else if (ending == ".pdf")
  {
    writePdf(window, file);
  }
  else if (ending == ".csv")
  {
    writeCsv(plots, file);
  }
  else
  {
    throw Error(ErrorCode::BadFile, file.string() + ": end the name in .png, .svg, .pdf or .csv");
  }
}

} // namespace palp
