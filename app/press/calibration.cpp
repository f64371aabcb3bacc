#include "app/press/calibration.h"

#include "app/input/coating_text.h"
#include "app/input/quantity.h"
#include "app/program/data_files.h"
#include "calibration/tables/surface_table.h"
#include "calibration/tables/table_tool.h"
#include "haptics/contact/contact_geometry_of.h"
#include "haptics/contact/embed_nodules.h"
#include "haptics/error.h"
#include "haptics/files/input_text.h"
#include "haptics/force/relaxation/friction_rows.h"
#include "haptics/units.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <utility>
#include <vector>

namespace palp
{
namespace
{

using namespace units::literals;

constexpr double kThreshold = 0.5_mm; // Sec. 3.3.2
constexpr double kPoisson = 0.33;
constexpr double kYoung = 50.0_kPa;
constexpr double kMaxDepth = 50.0_mm; // that the window asks for
constexpr double kTableTip = 0.3_mm;  // of the cones' tables
constexpr double kLayer = 5.0;        // thickness over radius of the paper's blocks, 10 and 6 mm

bool same(double a, double b)
{
  return std::abs(a - b) <= 1e-9 * b;
}

bool isCone(const Tip& tip)
{
  return std::holds_alternative<ConeTip>(tip) || std::holds_alternative<BluntConeTip>(tip);
}

// the nearer of the two radii that tables are shipped for
std::string bundledTable(const Tip& tip)
{
  const bool small = baseRadius(tip) < 8.0_mm;
  return std::string(isCone(tip) ? "tables/cone45_" : "tables/sphere_") +
    (small ? "r6_h30" : "r10_h50");
}

struct Layer
{
  double thickness; // [m]
  double threshold; // [m]
};

Layer layerOf(const DentOptions& options, double radius)
{
  return { options.layer.value_or(kLayer * radius), options.threshold };
}

// whether finite elements of a tool of this shape were computed, whatever its size
bool hasElements(const Tip& tip)
{
  const auto* sharp = std::get_if<ConeTip>(&tip);
  const auto* blunt = std::get_if<BluntConeTip>(&tip);
  return std::holds_alternative<SphereTip>(tip) || (sharp && same(sharp->halfAngle, 45.0_deg)) ||
    (blunt && same(blunt->halfAngle, 45.0_deg));
}

Calibration ofTable(const std::filesystem::path& file, double young)
{
  ExtentTable extents = ExtentTable::read(file);
  const double reach = extents.rows().back().depth;
  return { .extents = std::move(extents),
    .style = {},
    .reach = reach,
    .note = {},
    .elements = std::nullopt,
    .young = young };
}

// of a cone there is one table for each of the paper's blocks
Calibration ofCone(const DentOptions& options, const ForceLaw& law)
{
  const auto& tip = law.tip();
  const auto* sharp = std::get_if<ConeTip>(&tip);
  const double angle = sharp != nullptr ? sharp->halfAngle : std::get<BluntConeTip>(tip).halfAngle;
  const Layer layer = layerOf(options, baseRadius(tip));
  if (options.layer || !same(layer.threshold, kThreshold))
  {
    throw Error(ErrorCode::BadValue,
      "--layer, --threshold: for a cone, make its own table with palp calibrate and give --table");
  }
  const auto* blunt = std::get_if<BluntConeTip>(&tip);
  const bool known = same(angle, 45.0_deg) && same(law.material().poissonRatio, kPoisson) &&
    (same(baseRadius(tip), 6.0_mm) || same(baseRadius(tip), 10.0_mm)) &&
    (!blunt || same(blunt->tipRadius, kTableTip));
  Calibration calibration = ofTable(dataFile(bundledTable(tip) + ".csv"), kYoung);
  if (!known)
  {
    calibration.reach = 0.0;
    calibration.young.reset();
    calibration.note =
      "R_d is that of the nearest cone with a table (45 degrees, tip of 0.3 mm, "
      "nu = 0.33) and may be off by a factor of three; palp calibrate makes its own for "
      "--table";
  }
  return calibration;
}

Calibration ofSphere(const DentOptions& options, const ForceLaw& law)
{
  const double radius = baseRadius(law.tip());
  const double poisson = law.material().poissonRatio;
  const Layer layer = layerOf(options, radius);
  const bool asPaper = (same(radius, 10.0_mm) || same(radius, 6.0_mm)) && same(poisson, kPoisson) &&
    same(layer.thickness, kLayer * radius) && same(layer.threshold, kThreshold) &&
    std::holds_alternative<SphereTip>(law.tip());
  if (asPaper)
  {
    return ofTable(dataFile(bundledTable(law.tip()) + ".csv"), kYoung);
  }
  const SurfaceTable table = SurfaceTable::read(dataFile("tables/surface_sphere.csv"));
  SurfaceTable::Indentation indentation{
    .depth = radius, .tipRadius = radius, .thickness = layer.thickness, .poissonRatio = poisson
  };
  const bool covered = table.covers(indentation);
  const bool sphere = std::holds_alternative<SphereTip>(law.tip());
  indentation.depth = std::max(radius, kMaxDepth);
  return { .extents = table.extents(indentation, layer.threshold),
    .style = {},
    .reach = sphere && covered ? radius : 0.0,
    .note = !sphere
      ? "R_d is that of a sphere of the same radius and may be off by a factor of three; palp "
        "calibrate makes its own for --table"
      : covered ? ""
                : "R_d is clamped to the border of its table (layer of 2 to 20 radii, nu to 0.49)",
    .elements = std::nullopt,
    .young = std::nullopt };
}

// the shape, layer and tissue that the fitted surfaces were computed for, whatever the size
bool isOfTheseElements(const DentOptions& options, const ForceLaw& law)
{
  const auto* blunt = std::get_if<BluntConeTip>(&law.tip());
  const double radius = baseRadius(law.tip());
  return same(law.material().poissonRatio, kPoisson) &&
    same(layerOf(options, radius).thickness, kLayer * radius) &&
    (!blunt || blunt->tipRadius <= 2.0 * kTableTip);
}

// What stands in was computed for another tool or body, and may reach less far than this tool's own
// contact, which it never does: each row is held to that of the next, which none between exceeds.
ExtentTable atLeastContact(const ExtentTable& extents, const ForceLaw& law)
{
  constexpr double least = 1e-6; // [m]
  constexpr double step = 1.02;
  constexpr double deepest = 1.0; // [m]
  std::set<double> depths;
  for (const ExtentTable::Extent& row : extents.rows())
  {
    depths.insert(row.depth);
  }
  const auto contactAt = [&](double depth) { return law({ .depth = depth }).contactRadius; };
  const double widest = contactAt(deepest);
  for (double depth = least; depth < deepest; depth *= step)
  {
    depths.insert(depth);
    if (depth > extents.rows().back().depth && contactAt(depth) >= widest)
    {
      break;
    }
  }
  std::vector<ExtentTable::Extent> rows;
  for (auto depth = depths.begin(); depth != depths.end(); ++depth)
  {
    const double next = std::next(depth) != depths.end() ? *std::next(depth) : deepest;
    rows.push_back({ .depth = *depth,
      .extentRadius = std::max(extents.extentRadius(*depth), contactAt(next)),
      .force = 0.0,
      .contactRadius = 0.0 });
  }
  return ExtentTable(std::move(rows));
}

void add(std::string& notes, const std::string& note)
{
  notes += (notes.empty() ? "" : "; ") + note;
}

// that a table of the user's was computed for, where it is another
std::string toolOfOther(const DentOptions& options, const Tip& tip)
{
  const std::string tool = options.table.empty() ? "" : toolOfTable(options.table);
  return tool.empty() || isToolOfTable(tip, tool) ? "" : printable(tool);
}

// shipped tables are of tissue without any, the user's of the tissue that was asked for at first
bool isOfTheseCoatings(const PressOptions& options, const LawSettings& settings)
{
  if (options.dent.table.empty() || settings.mode != LawMode::Corrected)
  {
    return settings.coatings.empty();
  }
  return describeCoatings(settings.coatings) == describeCoatings(options.tissue.options.coatings);
}

// by the force of the tool on the tissue
Eigen::Vector3d carriedAlong(const Sample& sample, double mu, const Material& tissue)
{
  const double drag = sample.friction.norm();
  const double far = carriedBy(drag, sample.response.force,
    { .coefficient = mu, .poissonRatio = tissue.poissonRatio }, tissue.shearModulus(),
    sample.response.contactRadius);
  return drag > 0.0 ? Eigen::Vector3d(-far / drag * sample.friction)
                    : Eigen::Vector3d(Eigen::Vector3d::Zero());
}

} // namespace

bool Calibration::fits(const Contact& contact) const noexcept
{
  // A bent surface leaves a flat one by kappa a^2 / 2 at the rim of the contact, and a^2 < 2 R
  // delta: by a part kappa R of the depth. A tool that leans moves its flank by the angle, of which
  // a part as large is seen. Each 1 %, beside the 1.8 % of a flat layer.
  constexpr double kBent = 0.01;    // [-] curvature times radius
  constexpr double kLeaning = 0.01; // [rad]
  constexpr double kThicker = 0.05; // [-]
  constexpr double kAside = 0.9;    // [-] of the layer, as far as the paper's block reaches
  if (!(layer > 0.0) || !contact.touching())
  {
    return true;
  }
  const double radius = layer / kLayer;
  const double bent = std::abs(contact.surfaceCurvature) + contact.curvatureSpread;
  return bent * radius <= kBent && contact.tilt <= kLeaning &&
    std::abs(contact.thickness - layer) <= kThicker * layer &&
    contact.edgeDistance >= kAside * layer;
}

Calibration loadCalibration(const PressOptions& options, const ForceLaw& law)
{
  const Tip& tip = law.tip();
  // a table of the user's is made of the tissue that is pressed
  const DentOptions& dent = options.dent;
  Calibration calibration = !dent.table.empty() ? ofTable(dent.table, law.material().youngModulus)
    : isCone(tip)                               ? ofCone(dent, law)
                                                : ofSphere(dent, law);
  if (hasElements(tip))
  {
    const std::string bundled = bundledTable(tip);
    const double shipped = bundled.ends_with("r6_h30") ? 6.0_mm : 10.0_mm;
    // the same picture for a layer as many radii thick
    calibration.elements = FittedSurfaces::read(
      dataFile(bundled + "_surface.csv"), baseRadius(tip) / shipped, baseRadius(tip));
  }
  if (const std::string other = toolOfOther(dent, tip); !other.empty())
  {
    calibration.reach = 0.0;
    calibration.young.reset();
    add(calibration.note,
      dent.table.filename().string() + ": R_d is that of another tool (" + other +
        ") and may be off by a factor of three; palp calibrate makes that of this one");
  }
  if (!isOfTheseCoatings(options, law.settings()))
  {
    calibration.reach = 0.0;
    calibration.elements.reset();
    calibration.young.reset();
    add(calibration.note,
      "R_d is that of tissue with other coatings or none; palp calibrate --coating makes its own");
  }
  if (calibration.reach == 0.0)
  {
    calibration.extents = atLeastContact(calibration.extents, law);
  }
  calibration.style.isLiteral = dent.surface == DentSurface::PaperLiteral;
  if (dent.surface == DentSurface::Fitted)
  {
    calibration.style.fitted = calibration.elements;
    calibration.layer = calibration.elements ? kLayer * baseRadius(tip) : 0.0;
    if (!calibration.elements)
    {
      add(calibration.note, "the surface is the paper's, as none is fitted to this tool");
    }
    else if (!isOfTheseElements(dent, law))
    {
      calibration.reach = 0.0;
      calibration.elements.reset(); // not those of this press
      add(calibration.note,
        "the surface is fitted to a layer of five tool radii, nu = 0.33 and a sharp tip; here it "
        "may "
        "be wrong by more than 3 % of the depth");
    }
    else
    {
      calibration.reach = std::min(calibration.reach, calibration.elements->deepest());
    }
  }
  return calibration;
}

void followTissue(Calibration& calibration, const Scene& scene)
{
  for (int i = 0; i < organCount(scene); ++i)
  {
    const Scene& organ = organOf(scene, i);
    Calibration& its = i == 0 ? calibration : calibration.others[static_cast<std::size_t>(i) - 1];
    its.style.extent = nullptr;
    if (organ.nodules != nullptr)
    {
      its.style.extent = [nodules = organ.nodules, law = organ.law](
                           const Sample& sample, double extent)
      {
        return nodules->extentRadius(
          noduleContactOf(sample.contact), law(contactGeometryOf(sample.contact)), extent);
      };
    }
    its.tip = organ.law.tip();
    its.style.motion = organ.series != nullptr ? organ.series->field->motion() : nullptr;
    its.style.loads = [tissue = organ](const Sample& sample, double depth)
    { return std::vector{ organLoadOf(sample, depth, tissue) }; };
    its.style.carried = nullptr;
    if (const double mu = organ.law.settings().friction; mu > 0.0)
    {
      its.style.carried = [mu, tissue = organ.law.material()](const Sample& sample)
      { return carriedAlong(sample, mu, tissue); };
    }
  }
}

Calibration loadCalibration(const PressOptions& options, const Scene& scene)
{
  Calibration calibration = loadCalibration(options, scene.law);
  for (const Scene& organ : scene.others)
  {
    calibration.others.push_back(loadCalibration(options, organ.law));
  }
  followTissue(calibration, scene);
  return calibration;
}

} // namespace palp
