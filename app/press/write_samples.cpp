// samples.csv of a recording.

#include "app/input/law_options.h"
#include "app/input/tip_text.h"
#include "app/press/recording.h"
#include "app/press/sample_text.h"
#include "haptics/contact/contact_geometry_of.h"
#include "haptics/contact/embed_nodules.h"
#include "haptics/files/csv_text.h"
#include "haptics/servo/tissue_at.h"
#include "haptics/units.h"

#include <algorithm>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

namespace palp
{
namespace
{

// whether an organ of a scene has something
template <typename Has>
bool anyOrgan(const Scene& scene, Has has)
{
  return has(scene) || std::ranges::any_of(scene.others, has);
}

bool hasMemory(const Scene& scene)
{
  return anyOrgan(scene, [](const Scene& organ) { return organ.law.rows() != nullptr; });
}

bool hasNodules(const Scene& scene)
{
  return anyOrgan(scene, [](const Scene& organ) { return organ.nodules != nullptr; });
}

bool hasSeries(const Scene& scene)
{
  return anyOrgan(scene, [](const Scene& organ) { return organ.series != nullptr; });
}

// what lies in the tissue, by which force_N is another than the law's; empty: nothing
std::string insideOf(const Scene& scene)
{
  const bool hasMap =
    anyOrgan(scene, [](const Scene& organ) { return organ.stiffness != nullptr; });
  return hasNodules(scene) ? "nodules" : hasMap ? "stiffness" : "";
}

bool pushesAside(const Scene& scene)
{
  return anyOrgan(scene, TissueAt::pushesAside);
}

void describeRules(std::ostream& out, const Scene& scene, const Validity& validity,
  const std::string& of, const Rule* last)
{
  out << "# broken_rules" << of << ": a sum of the conditions that the place does not meet\n";
  std::uint32_t bit = 1;
  std::vector<Rule> rules = rulesAt(scene, validity, {});
  last != nullptr ? rules.push_back(*last) : void();
  for (const Rule& rule : rules)
  {
    out << "#   " << bit << " " << rule.name << ": " << rule.why << '\n';
    bit *= 2;
  }
}

// each organ's, where there are several
void describeRules(std::ostream& out, const Recording& recording,
  const std::vector<Validity>& validity, const Rule* last)
{
  for (std::size_t i = 0; i < validity.size(); ++i)
  {
    const int organ = static_cast<int>(i);
    const std::string name = recording.organName(organ);
    describeRules(
      out, organOf(recording.scene, organ), validity[i], name.empty() ? name : " of " + name, last);
  }
}

std::string origin(const Recording& recording)
{
  std::string lines = recording.command.empty() ? "" : "# command: " + recording.command + '\n';
  for (const MeshFile& file : recording.files)
  {
    lines.append(kFelt).append(describe(file)).append("\n");
  }
  return lines;
}

void describeNodules(std::ostream& out, const NoduleField& nodules)
{
  using units::toMillimeters;
  for (const EmbeddedNodule& one : nodules.nodules())
  {
    const Eigen::Vector3d& center = one.nodule.center;
    out << "# nodule: center " << shortest(toMillimeters(center.x())) << ' '
        << shortest(toMillimeters(center.y())) << ' ' << shortest(toMillimeters(center.z()))
        << " mm, radius " << shortest(toMillimeters(one.nodule.radius)) << " mm, ratio "
        << shortest(one.nodule.ratio) << "; taken to lie " << shortest(toMillimeters(one.depth))
        << " mm deep in " << shortest(toMillimeters(one.place.thickness))
        << " mm of tissue, curvature " << shortest(one.place.surfaceCurvature) << " per m\n";
  }
}

// what force_N was computed from, besides the law
void describeNodules(std::ostream& out, const Scene& scene)
{
  for (int i = 0; i < organCount(scene); ++i)
  {
    const auto& nodules = organOf(scene, i).nodules;
    nodules != nullptr ? describeNodules(out, *nodules) : void();
    if (const auto& map = organOf(scene, i).stiffness; map != nullptr)
    {
      out << "# stiffness: a map, felt at " << map->places() << " places; factor_stiffness: of the "
          << "force by the law and its Young's modulus\n";
    }
  }
  if (hasSeries(scene))
  {
    out << "# organ file: depth_mm = local_depth_mm, at which law and factors hold, without the "
           "thickness, + f (G + 4/15 B a^2) - what the pressure gains by moving aside, f = force_N "
           "/ E*; G, B, slope and 1/D of an edge: organ_constant_per_m, organ_bend_per_m3, "
           "organ_slope_per_m2, organ_edge_per_m\n";
  }
  out << "# depth_slope: of depth_mm as the tool moves along the normal, on which it is pushed by "
         "force_N times that\n"
      << (pushesAside(scene) ? "# lateral_x/y/z_N: besides, of the tissue and its shape on the "
                               "tool, before any limit\n"
                             : "");
}

std::string elasticityOf(const ForceLaw& law)
{
  return "Young's modulus: " + shortest(units::toKilopascals(law.material().youngModulus)) +
    " kPa, Poisson's ratio: " + shortest(law.material().poissonRatio);
}

std::string dampingOf(const Scene& scene)
{
  return ", damping: " + shortest(scene.damping) + " N*s/m";
}

// the one body, or each organ
void describeTissues(std::ostream& out, const Recording& recording)
{
  const Scene& scene = recording.scene;
  const char* contact = scene.rule == ContactRule::Paper ? "paper" : "exact";
  if (recording.organs.empty())
  {
    out << "# " << elasticityOf(scene.law) << "\n# law: " << describeLaw(scene.law.settings())
        << "\n# contact: " << contact << dampingOf(scene) << ", force scale: 1\n";
    return;
  }
  int felt = 0;
  for (const OrganPlan& plan : recording.organs)
  {
    out << "# organ " << plan.name << ": ";
    if (!plan.isFelt())
    {
      out << "not felt\n";
      continue;
    }
    const Scene& organ = organOf(scene, felt++);
    out << elasticityOf(organ.law) << ", law: " << describeLaw(organ.law.settings())
        << dampingOf(organ) << '\n';
  }
  out << "# contact: " << contact << ", force scale: 1\n"
      << "# organ: that is touched, of which the row tells; empty: none is\n";
}

// where the samples come from, and what they are of
void describeRecording(std::ostream& out, const Recording& recording)
{
  out << "# palp " << PALP_VERSION << '\n'
      << "# mesh: " << recording.mesh << " (coordinates read in " << recording.unit << ")\n"
      << origin(recording) << "# device: " << recording.device << '\n'
      << (recording.second ? std::string(kSecondDevice) + recording.second->device +
               "\n# hand: 1 or 2, each with a tool, a contact and a force of its own\n"
                           : "")
      << "# tool: " << describeTip(recording.scene.law.tip()) << '\n';
  describeTissues(out, recording);
  out << "# tool: position of the apex in the frame of the mesh; force_N: the law before damping "
         "and limits; force_x/y/z_N: sent to the device; stiffness_N_per_mm: slope of force_N over "
         "depth_mm\n"
      << "# force_N = force of the paper's law (of the exact one where the paper has none) times "
         "all factors\n";
  if (hasMemory(recording.scene))
  {
    out
      << "# that is of the instantaneous modulus: force_N relaxes from there; friction_x/y/z_N: of "
         "the tissue on the tool before limits, part of force_x/y/z_N; surface_depth_mm: of the "
         "tissue at the tool, also of the dent that it leaves\n";
  }
  describeNodules(out, recording.scene);
  if (recording.contactOnly)
  {
    out << kContactOnly << '\n';
  }
  if (recording.thinned > 0)
  {
    const bool all = recording.thinned == recording.samples.size();
    out << kThinned
        << shortest(all ? recording.samples.back().time : recording.samples[recording.thinned].time)
        << kThinnedTo << shortest(recording.interval) << " s\n";
  }
}

void writeColumns(std::ostream& out, const Recording& recording, bool hasExtents)
{
  const Scene& scene = recording.scene;
  const std::string inside = insideOf(scene);
  out << "time_s," << (recording.second ? "hand," : "") << "tool_x_mm,tool_y_mm,tool_z_mm,"
      << (recording.organs.empty() ? "" : "organ,")
      << "depth_mm,force_N,force_x_N,force_y_N,force_z_N,"
         "contact_radius_mm,"
      << (hasExtents ? "extent_radius_mm," : "")
      << "stiffness_N_per_mm,axis_x,axis_y,axis_z,normal_x,normal_y,normal_z,tilt_deg,flags"
      << (recording.rated ? ",broken_rules" : "")
      << ",thickness_mm,curvature_per_m,curvature_spread_per_m,depth_slope";
  for (const Factor& factor : scene.law.factors({}))
  {
    out << ",factor_" << factor.name;
  }
  out << (hasMemory(scene) ? ",friction_x_N,friction_y_N,friction_z_N,surface_depth_mm" : "")
      << (inside.empty() ? "" : ",factor_" + inside)
      << (hasSeries(scene) ? ",local_depth_mm,organ_constant_per_m,organ_slope_per_m2,"
                             "organ_bend_per_m3,organ_edge_per_m"
                           : "")
      << (pushesAside(scene) ? ",lateral_x_N,lateral_y_N,lateral_z_N" : "") << '\n';
}

// what follows the place of the tool
std::vector<double> rowOf(const Sample& sample, const Scene& all, const Calibration* calibration,
  const std::vector<Validity>& validity, const Rule* last)
{
  using units::toMillimeters;
  const Scene& scene = organOf(all, sample.organ);
  const Eigen::Vector3d& axis = sample.pose.axis;
  const Contact& contact = sample.contact;
  std::vector<double> row{ toMillimeters(contact.depth), sample.response.force, sample.force.x(),
    sample.force.y(), sample.force.z(), toMillimeters(sample.response.contactRadius) };
  if (calibration)
  {
    row.push_back(toMillimeters(organOf(*calibration, sample.organ).extentRadius(sample)));
  }
  row.insert(row.end(),
    { units::toNewtonsPerMillimeter(sample.response.stiffness), axis.x(), axis.y(), axis.z(),
      contact.normal.x(), contact.normal.y(), contact.normal.z(), units::toDegrees(contact.tilt),
      static_cast<double>(sample.flags) });
  if (!validity.empty())
  {
    const Validity& rules = validity[static_cast<std::size_t>(sample.organ)];
    std::vector<Rule> asked = rulesAt(scene, rules, contact);
    last != nullptr ? asked.push_back(*last) : void();
    row.push_back(static_cast<double>(brokenRules(asked)));
  }
  row.insert(row.end(),
    { toMillimeters(contact.thickness), contact.surfaceCurvature, contact.curvatureSpread,
      contact.slope });
  const ContactGeometry geometry = lawGeometryOf(scene, contact);
  for (const Factor& factor : scene.law.factors(geometry))
  {
    row.push_back(factor.value);
  }
  if (hasMemory(all))
  {
    const Eigen::Vector3d& friction = sample.friction;
    row.insert(
      row.end(), { friction.x(), friction.y(), friction.z(), toMillimeters(sample.surfaceDepth) });
  }
  if (!insideOf(all).empty())
  {
    const double plain = scene.law(geometry).force;
    row.push_back(plain > 0.0 ? sample.response.force / plain : 1.0);
  }
  if (hasSeries(all))
  {
    const BodyCompliance body = scene.series != nullptr && contact.touching()
      ? scene.series->at(seriesPlaceOf(contact)).here
      : BodyCompliance{};
    row.insert(row.end(),
      { toMillimeters(sample.localDepth), body.constant, body.slope, body.bend, body.edge });
  }
  if (pushesAside(all))
  {
    row.insert(row.end(), { sample.lateral.x(), sample.lateral.y(), sample.lateral.z() });
  }
  return row;
}

} // namespace

void writeSamples(std::ostream& out, const Recording& recording, const Calibration* calibration)
{
  describeRecording(out, recording);
  const std::vector<Validity> validity =
    recording.rated ? validityOf(recording.scene) : std::vector<Validity>{};
  const auto betweenHands = [&](const Sample& sample, const Sample& other)
  {
    return recording.second && calibration != nullptr
      ? std::optional(betweenRule(*calibration, sample, other))
      : std::nullopt;
  };
  const std::optional<Rule> last = betweenHands({}, {});
  describeRules(out, recording, validity, last ? &*last : nullptr);
  writeColumns(out, recording, calibration != nullptr);
  const auto write = [&](const HandSample& row)
  {
    const Sample& sample = *row.sample;
    const Eigen::Vector3d& apex = sample.pose.apex;
    out << shortest(sample.time) << ',' << (recording.second ? std::to_string(row.hand) + ',' : "")
        << exactMillimeters(apex.x()) << ',' << exactMillimeters(apex.y()) << ','
        << exactMillimeters(apex.z()) << ',';
    if (!recording.organs.empty())
    {
      out << (sample.contact.touching() ? recording.organName(sample.organ) : "") << ',';
    }
    const std::optional<Rule> between =
      betweenHands(sample, row.other != nullptr ? *row.other : Sample{});
    writeCsvRow(
      out, rowOf(sample, recording.scene, calibration, validity, between ? &*between : nullptr));
  };
  forEachInOrder(recording, write);
}

} // namespace palp
