#include "app/press/recording.h"

#include "app/input/law_options.h"
#include "app/input/tip_text.h"
#include "haptics/contact/contact_geometry_of.h"
#include "haptics/files/csv_text.h"
#include "haptics/force/validity.h"
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

void describeRules(std::ostream& out, const Validity& validity)
{
  out << "# broken_rules: a sum of the conditions that the place does not meet\n";
  std::uint32_t bit = 1;
  for (const Rule& rule : validity(ContactGeometry{}))
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
  if (recording.thinned > 0)
  {
    const bool all = recording.thinned == recording.samples.size();
    out << "# of a long recording: before "
        << shortest(all ? recording.samples.back().time : recording.samples[recording.thinned].time)
        << " s only the samples of the least and the largest depth and force within each "
        << shortest(recording.interval) << " s\n";
  }
}

void writeColumns(std::ostream& out, const ForceLaw& law, bool hasExtents, bool hasRules)
{
  out << "time_s,tool_x_mm,tool_y_mm,tool_z_mm,depth_mm,force_N,force_x_N,force_y_N,force_z_N,"
         "contact_radius_mm,"
      << (hasExtents ? "extent_radius_mm," : "")
      << "stiffness_N_per_mm,axis_x,axis_y,axis_z,normal_x,normal_y,normal_z,tilt_deg,flags"
      << (hasRules ? ",broken_rules" : "")
      << ",thickness_mm,curvature_per_m,curvature_spread_per_m";
  for (const Factor& factor : law.factors({}))
  {
    out << ",factor_" << factor.name;
  }
  out << '\n';
}

std::vector<double> rowOf(const Sample& sample, const ForceLaw& law, const Calibration* calibration,
  const std::optional<Validity>& validity)
{
  using units::toMillimeters;
  const Eigen::Vector3d& apex = sample.pose.apex;
  const Eigen::Vector3d& axis = sample.pose.axis;
  const Contact& contact = sample.contact;
  std::vector<double> row{ sample.time, toMillimeters(apex.x()), toMillimeters(apex.y()),
    toMillimeters(apex.z()), toMillimeters(contact.depth), sample.response.force, sample.force.x(),
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
    row.push_back(static_cast<double>(
      brokenRules((*validity)(contactGeometryOf(contact), contact.edgeDistance))));
  }
  row.insert(row.end(),
    { toMillimeters(contact.thickness), contact.surfaceCurvature, contact.curvatureSpread });
  for (const Factor& factor : law.factors(contactGeometryOf(contact)))
  {
    row.push_back(factor.value);
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
    describeRules(out, *validity);
  }
  writeColumns(out, law, calibration != nullptr, validity.has_value());
  for (const Sample& sample : recording.samples)
  {
    writeCsvRow(out, rowOf(sample, law, calibration, validity));
  }
}

} // namespace palp
