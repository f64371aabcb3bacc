#include "app/press/recording.h"

#include "app/input/law_options.h"
#include "app/input/tip_text.h"
#include "app/press/sample_text.h"
#include "haptics/contact/contact_geometry_of.h"
#include "haptics/contact/embed_nodules.h"
#include "haptics/files/csv_text.h"
#include "haptics/units.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <ostream>
#include <vector>

namespace palp
{

namespace
{

void describeRules(std::ostream& out, const Scene& scene, const Validity& validity)
{
  out << "# broken_rules: a sum of the conditions that the place does not meet\n";
  std::uint32_t bit = 1;
  for (const Rule& rule : rulesAt(scene, validity, {}))
  {
    out << "#   " << bit << " " << rule.name << ": " << rule.why << '\n';
    bit *= 2;
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

// what force_N was computed from, besides the law
void describeNodules(std::ostream& out, const Scene& scene)
{
  if (scene.nodules == nullptr)
  {
    return;
  }
  using units::toMillimeters;
  for (const EmbeddedNodule& one : scene.nodules->nodules())
  {
    const Eigen::Vector3d& center = one.nodule.center;
    out << "# nodule: center " << shortest(toMillimeters(center.x())) << ' '
        << shortest(toMillimeters(center.y())) << ' ' << shortest(toMillimeters(center.z()))
        << " mm, radius " << shortest(toMillimeters(one.nodule.radius)) << " mm, ratio "
        << shortest(one.nodule.ratio) << "; taken to lie " << shortest(toMillimeters(one.depth))
        << " mm deep in " << shortest(toMillimeters(one.place.thickness))
        << " mm of tissue, curvature " << shortest(one.place.surfaceCurvature) << " per m\n";
  }
  out << "# lateral_x/y/z_N: of the nodules on the tool, besides force_N along the normal\n";
}

// where the samples come from, and what they are of
void describeRecording(std::ostream& out, const Recording& recording)
{
  const ForceLaw& law = recording.scene.law;
  out << "# palp " << PALP_VERSION << '\n'
      << "# mesh: " << recording.mesh << " (coordinates read in " << recording.unit << ")\n"
      << origin(recording) << "# device: " << recording.device << '\n'
      << "# tool: " << describeTip(law.tip()) << '\n'
      << "# Young's modulus: " << shortest(units::toKilopascals(law.material().youngModulus))
      << " kPa, Poisson's ratio: " << shortest(law.material().poissonRatio) << '\n'
      << "# law: " << describeLaw(law.settings()) << '\n'
      << "# contact: " << (recording.scene.rule == ContactRule::Paper ? "paper" : "exact")
      << ", damping: " << shortest(recording.scene.damping) << " N*s/m, force scale: 1\n"
      << "# tool: position of the apex in the frame of the mesh; force_N: the law before damping "
         "and limits; force_x/y/z_N: sent to the device\n"
      << "# force_N = force of the paper's law (of the exact one where the paper has none) times "
         "all factors\n";
  if (law.rows() != nullptr)
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

void writeColumns(std::ostream& out, const Scene& scene, bool hasExtents, bool hasRules)
{
  out << "time_s,tool_x_mm,tool_y_mm,tool_z_mm,depth_mm,force_N,force_x_N,force_y_N,force_z_N,"
         "contact_radius_mm,"
      << (hasExtents ? "extent_radius_mm," : "")
      << "stiffness_N_per_mm,axis_x,axis_y,axis_z,normal_x,normal_y,normal_z,tilt_deg,flags"
      << (hasRules ? ",broken_rules" : "")
      << ",thickness_mm,curvature_per_m,curvature_spread_per_m";
  for (const Factor& factor : scene.law.factors({}))
  {
    out << ",factor_" << factor.name;
  }
  out << (scene.law.rows() != nullptr ? ",friction_x_N,friction_y_N,friction_z_N,surface_depth_mm"
                                      : "")
      << (scene.nodules != nullptr ? ",factor_nodules,lateral_x_N,lateral_y_N,lateral_z_N" : "")
      << '\n';
}

// what follows the place of the tool
std::vector<double> rowOf(const Sample& sample, const Scene& scene, const Calibration* calibration,
  const std::optional<Validity>& validity)
{
  using units::toMillimeters;
  const Eigen::Vector3d& axis = sample.pose.axis;
  const Contact& contact = sample.contact;
  std::vector<double> row{ toMillimeters(contact.depth), sample.response.force, sample.force.x(),
    sample.force.y(), sample.force.z(), toMillimeters(sample.response.contactRadius) };
  if (calibration)
  {
    row.push_back(toMillimeters(calibration->extents.extentRadius(contact.depth)));
  }
  row.insert(row.end(),
    { units::toNewtonsPerMillimeter(sample.response.stiffness), axis.x(), axis.y(), axis.z(),
      contact.normal.x(), contact.normal.y(), contact.normal.z(), units::toDegrees(contact.tilt),
      static_cast<double>(sample.flags) });
  if (validity)
  {
    row.push_back(static_cast<double>(brokenRules(rulesAt(scene, *validity, contact))));
  }
  row.insert(row.end(),
    { toMillimeters(contact.thickness), contact.surfaceCurvature, contact.curvatureSpread });
  for (const Factor& factor : scene.law.factors(contactGeometryOf(contact)))
  {
    row.push_back(factor.value);
  }
  if (scene.law.rows() != nullptr)
  {
    const Eigen::Vector3d& friction = sample.friction;
    row.insert(
      row.end(), { friction.x(), friction.y(), friction.z(), toMillimeters(sample.surfaceDepth) });
  }
  if (scene.nodules != nullptr)
  {
    const double plain = scene.law(contactGeometryOf(contact)).force;
    row.insert(row.end(),
      { plain > 0.0 ? sample.response.force / plain : 1.0, sample.lateral.x(), sample.lateral.y(),
        sample.lateral.z() });
  }
  return row;
}

// of each interval the extremes; returns how many are left of those from begin to end
std::size_t thinRange(
  std::vector<Sample>& samples, std::size_t begin, std::size_t end, double interval)
{
  const auto depth = [](const Sample& sample) { return sample.contact.depth; };
  const auto force = [](const Sample& sample) { return sample.response.force; };
  auto left = samples.begin() + static_cast<std::ptrdiff_t>(begin);
  const auto stop = samples.begin() + static_cast<std::ptrdiff_t>(end);
  for (auto at = left; at != stop;)
  {
    const double number = std::floor(at->time / interval);
    const auto next = std::find_if(
      at, stop, [&](const Sample& sample) { return std::floor(sample.time / interval) != number; });
    const std::array extremes{ std::ranges::min_element(at, next, {}, depth),
      std::ranges::max_element(at, next, {}, depth), std::ranges::min_element(at, next, {}, force),
      std::ranges::max_element(at, next, {}, force) };
    std::array<Sample, extremes.size()> kept;
    const auto last = std::copy_if(at, next, kept.begin(),
      [&, from = at](const Sample&) mutable
      { return std::ranges::find(extremes, from++) != extremes.end(); });
    left = std::copy(kept.begin(), last, left);
    at = next;
  }
  samples.erase(left, stop);
  return static_cast<std::size_t>(left - samples.begin()) - begin;
}

} // namespace

void keepContact(Recording& recording)
{
  recording.contactOnly = true;
  const std::vector<Sample>& all = recording.samples;
  const auto touches = [&](std::size_t i) { return i < all.size() && all[i].contact.touching(); };
  const bool none = recording.deepest() == nullptr;
  std::vector<Sample> kept;
  std::size_t thinned = 0;
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    const bool isEnd = none && (i == 0 || i + 1 == all.size());
    if (touches(i - 1) || touches(i) || touches(i + 1) || isEnd) // 0 - 1 is beyond the end
    {
      kept.push_back(all[i]);
      thinned += i < recording.thinned ? 1 : 0;
    }
  }
  recording.samples = std::move(kept);
  recording.thinned = thinned;
}

void bound(Recording& recording, std::size_t kept)
{
  const std::size_t minute = kept / 10; // at a time, so that moving the rest is rare
  if (recording.samples.size() > recording.thinned + kept + minute)
  {
    const std::size_t first = recording.thinned;
    recording.thinned += thinRange(recording.samples, first, first + minute, recording.interval);
    while (recording.thinned > 2 * minute)
    {
      recording.interval *= 2.0;
      recording.thinned = thinRange(recording.samples, 0, recording.thinned, recording.interval);
    }
  }
}

void thin(Recording& recording)
{
  recording.thinned = thinRange(recording.samples, 0, recording.samples.size(), recording.interval);
}

std::vector<double> contrastsAt(const Scene& scene, const Contact& contact)
{
  return scene.nodules == nullptr
    ? std::vector<double>{}
    : scene.nodules->contrasts(noduleContactOf(contact), scene.law(contactGeometryOf(contact)));
}

std::vector<Rule> rulesAt(const Scene& scene, const Validity& validity, const Contact& contact)
{
  const ContactGeometry geometry = contactGeometryOf(contact);
  const Rules all = validity(geometry, contact.edgeDistance);
  std::vector<Rule> rules(all.begin(), all.end());
  if (scene.nodules != nullptr)
  {
    const NoduleRules more = scene.nodules->rules(noduleContactOf(contact), scene.law(geometry));
    rules.insert(rules.end(), more.begin(), more.end());
  }
  return rules;
}

const Sample* Recording::deepest() const noexcept
{
  return deepestOf(samples);
}

std::span<const Sample> Recording::lastPress() const noexcept
{
  const auto touches = [](const Sample& sample) { return sample.contact.touching(); };
  const auto end = std::find_if(samples.rbegin(), samples.rend(), touches);
  const auto begin = std::find_if_not(end, samples.rend(), touches);
  return { begin.base(), end.base() };
}

const Sample* deepestOf(std::span<const Sample> samples) noexcept
{
  const Sample* deepest = nullptr;
  for (const Sample& sample : samples)
  {
    if (sample.contact.depth > (deepest ? deepest->contact.depth : 0.0))
    {
      deepest = &sample;
    }
  }
  return deepest;
}

void writeSamples(std::ostream& out, const Recording& recording, const Calibration* calibration)
{
  describeRecording(out, recording);
  const ForceLaw& law = recording.scene.law;
  const std::optional<Validity> validity =
    recording.rated ? std::optional<Validity>(law) : std::nullopt;
  if (validity)
  {
    describeRules(out, recording.scene, *validity);
  }
  writeColumns(out, recording.scene, calibration != nullptr, validity.has_value());
  for (const Sample& sample : recording.samples)
  {
    const Eigen::Vector3d& apex = sample.pose.apex;
    out << shortest(sample.time) << ',' << exactMillimeters(apex.x()) << ','
        << exactMillimeters(apex.y()) << ',' << exactMillimeters(apex.z()) << ',';
    writeCsvRow(out, rowOf(sample, recording.scene, calibration, validity));
  }
}

} // namespace palp
