#include "app/press/presses.h"

#include "app/input/law_options.h"
#include "app/input/tip_text.h"
#include "haptics/contact/contact_geometry_of.h"
#include "haptics/files/csv_text.h"
#include "haptics/files/replace_file.h"
#include "haptics/units.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <limits>
#include <numeric>
#include <span>
#include <sstream>
#include <utility>

namespace palp
{
namespace
{

constexpr double kCalm = 0.01;  // [s] over which the steps of a device are no motion
constexpr double kNewton = 1.0; // force at which stiffnesses are compared [N]

// Of a force that goes with a power of the depth, as its stiffness tells: work from the surface on,
// and stiffness at 1 N where that is not deeper.
void beginAtSurface(PressSummary& press, const Sample& first)
{
  const Response& at = first.response;
  if (at.force > 0.0)
  {
    const double power = std::max(1.0, at.stiffness * first.contact.depth / at.force);
    press.energy = at.force * first.contact.depth / (1.0 + power);
    if (at.force >= kNewton)
    {
      press.stiffness = at.stiffness * std::pow(kNewton / at.force, 1.0 - 1.0 / power);
    }
  }
}

// on the way in, where the force comes to 1 N, between two samples
void watchStiffness(PressSummary& press, const Response& before, const Response& now)
{
  if (!press.stiffness && before.force < kNewton && now.force >= kNewton)
  {
    const double part = (kNewton - before.force) / (now.force - before.force);
    press.stiffness = before.stiffness + part * (now.stiffness - before.stiffness);
  }
}

void addSample(PressSummary& press, const Sample& last, const Sample& sample)
{
  const Contact& contact = sample.contact;
  press.end = sample.time;
  press.force = std::max(press.force, sample.response.force);
  watchStiffness(press, last.response, sample.response);
  if (contact.depth > press.deepest.depth)
  {
    // the way that is new, from the largest depth so far: what was given back counts once
    const double from = std::max(press.deepest.depth, last.contact.depth);
    press.energy += 0.5 * (last.response.force + sample.response.force) * (contact.depth - from);
    press.deepest = contact;
  }
}

enum class Way
{
  Forward, // from the first sample on
  Back,    // from the last one
};

// Fastest change of the depth from one sample on, over a time, or one step where that is longer.
// Nothing where there is no other sample.
std::optional<double> depthRate(std::span<const Sample> samples, Way way, double within)
{
  const auto from = [&](std::size_t k) -> const Sample&
  { return samples[way == Way::Forward ? k : samples.size() - 1 - k]; };
  std::optional<double> fastest;
  std::size_t begin = 0; // of a step
  for (std::size_t k = 1; k < samples.size(); ++k)
  {
    if (fastest && std::abs(from(k).time - from(0).time) > within)
    {
      break;
    }
    const double time = std::abs(from(k).time - from(begin).time);
    if (time >= kCalm || (!fastest && k + 1 == samples.size()))
    {
      const double change = std::abs(from(k).contact.depth - from(begin).contact.depth);
      fastest = std::max(fastest.value_or(0.0), time > 0.0 ? change / time : 0.0);
      begin = k;
    }
  }
  return fastest;
}

// of a depth, pressed or given back [s]
double timeOf(double depth, double rate)
{
  return rate > 0.0 ? depth / rate : std::numeric_limits<double>::infinity();
}

// whether the tool had time to lift between two samples that touch, with none between them
bool mayLift(std::span<const Sample> samples, std::size_t next)
{
  const Sample& before = samples[next - 1];
  const Sample& after = samples[next];
  const double gap = after.time - before.time;
  const auto out = depthRate(samples.first(next), Way::Back, gap);
  const auto in = depthRate(samples.subspan(next), Way::Forward, gap);
  if (!out && !in)
  {
    return gap >= kBounce; // however fast it is
  }
  return timeOf(before.contact.depth, out ? *out : *in) + kBounce +
    timeOf(after.contact.depth, in ? *in : *out) <=
    gap;
}

// Whether a press was recorded from its touch on, not from somewhere in the tissue: its first depth
// is what a step or two of it add.
bool isFromTouch(std::span<const Sample> samples, std::size_t first)
{
  if (first + 1 == samples.size() || (first > 0 && !samples[first - 1].contact.touching()))
  {
    return true;
  }
  const auto rate = depthRate(samples.subspan(first), Way::Forward, kCalm);
  const double step = samples[first + 1].time - samples[first].time;
  return samples[first].contact.depth <= 2.0 * rate.value_or(0.0) * step;
}

// Whether samples that thinning left out after one may have been apart: only where an earlier one
// of its interval is, for of those that are equally shallow the first is kept.
bool mayHideLift(const Recording& recording, std::size_t last)
{
  const auto number = [&](std::size_t i)
  { return std::floor(recording.samples[i].time / recording.interval); };
  for (std::size_t i = last; i > 0 && number(i - 1) == number(last); --i)
  {
    if (!recording.samples[i - 1].contact.touching())
    {
      return true;
    }
  }
  return false;
}

// whether a press ends between one sample that touches and the next that does
bool isReleased(const Recording& recording, std::size_t last, std::size_t next)
{
  const std::span<const Sample> samples = recording.samples;
  const double apart = (samples[next].contact.center - samples[last].contact.center).norm();
  if (samples[last].organ != samples[next].organ ||
    apart > 2.0 * baseRadius(recording.scene.law.tip()))
  {
    return true;
  }
  if (last + 1 < next)
  {
    return samples[next].time - samples[last].time >= kBounce;
  }
  const bool isThinned = last < recording.thinned;
  return (!isThinned || mayHideLift(recording, last)) && mayLift(samples, next);
}

PressSummary beginPress(std::string name, std::span<const Sample> samples, std::size_t first)
{
  const Sample& sample = samples[first];
  PressSummary press{ .name = std::move(name),
    .begin = sample.time,
    .end = sample.time,
    .force = sample.response.force,
    .deepest = sample.contact,
    .organ = sample.organ };
  if (isFromTouch(samples, first))
  {
    beginAtSurface(press, sample);
  }
  return press;
}

// in quotes, as a table takes it
auto cell(const std::string& text)
{
  return std::quoted(text, '"', '"');
}

// where the deepest contact is, in the frame of the mesh
void writePlace(std::ostream& out, const Contact& contact)
{
  using units::toMillimeters;
  for (const double value : { toMillimeters(contact.center.x()), toMillimeters(contact.center.y()),
         toMillimeters(contact.center.z()), contact.normal.x(), contact.normal.y(),
         contact.normal.z(), toMillimeters(contact.thickness) })
  {
    out << ',' << shortest(value);
  }
}

// in each organ
std::vector<std::size_t> noduleCounts(const Scene& scene)
{
  std::vector<std::size_t> counts;
  for (int i = 0; i < organCount(scene); ++i)
  {
    const auto& nodules = organOf(scene, i).nodules;
    counts.push_back(nodules == nullptr ? 0 : nodules->nodules().size());
  }
  return counts;
}

void explainContrasts(std::ostream& out)
{
  out << "# nodule_percent: what each nodule alone adds to the force without any, where it was "
         "deepest; people notice 7 of force, 15 of stiffness by finger, 22 of compliance, 45 of "
         "stiffness by stylus\n";
}

// empty of the nodules in other organs
void writeContrasts(std::ostream& out, const Scene& scene, const PressSummary& press)
{
  const std::vector<std::size_t> counts = noduleCounts(scene);
  const auto pressed = static_cast<std::size_t>(press.organ);
  for (std::size_t i = 0; i < counts.size(); ++i)
  {
    if (i != pressed)
    {
      out << std::string(counts[i], ',');
      continue;
    }
    for (const double contrast : contrastsAt(organOf(scene, press.organ), press.deepest))
    {
      out << ',' << shortest(100.0 * contrast);
    }
  }
}

// tool and tissue that it was pressed by
void writeLaw(std::ostream& out, const ForceLaw& law)
{
  out << ',' << cell(describeTip(law.tip())) << ','
      << shortest(units::toKilopascals(law.material().youngModulus)) << ','
      << shortest(law.material().poissonRatio) << ',' << cell(describeLaw(law.settings()));
}

} // namespace

std::string pressName(std::size_t index)
{
  return "press " + std::to_string(index + 1);
}

std::string outsideLimits(const Scene& scene, const Validity& validity, const Contact& contact)
{
  return brokenNames(rulesAt(scene, validity, contact));
}

std::vector<PressSummary> findPresses(const Recording& recording)
{
  const std::span<const Sample> samples = recording.samples;
  std::vector<PressSummary> presses;
  std::optional<std::size_t> touched; // the last that did
  for (std::size_t i = 0; i < samples.size(); ++i)
  {
    if (!samples[i].contact.touching())
    {
      continue;
    }
    if (!touched || isReleased(recording, *touched, i))
    {
      presses.push_back(beginPress(pressName(presses.size()), samples, i));
    }
    else
    {
      addSample(presses.back(), samples[*touched], samples[i]);
    }
    touched = i;
  }
  const std::size_t named = std::min(presses.size(), recording.names.size());
  for (std::size_t i = 0; i < named; ++i)
  {
    presses[i].name = recording.names[i];
  }
  std::erase_if(presses, [](const PressSummary& press) { return press.name.empty(); });
  return presses;
}

void writePresses(std::ostream& out, const Recording& recording)
{
  using units::toMillimeters;
  const Scene& scene = recording.scene;
  const bool isOne = recording.organs.empty();
  const std::vector<Validity> validity =
    recording.rated ? validityOf(scene) : std::vector<Validity>{};
  out << "# palp " << PALP_VERSION << '\n'
      << "# each press from touch to release; force of the law; place, normal and thickness where "
         "it was deepest, in the frame of the mesh\n"
      << "# energy: work on the way to the largest depth, from the first sample on where that is "
         "not the touch; stiffness: of the law at once, which a curve of tissue that relaxes falls "
         "short of; empty where 1 N was not reached on the way; outside_limits: "
         "rules of validity that the deepest contact breaks\n";
  const std::vector<std::size_t> counts = noduleCounts(scene);
  const auto nodules = std::accumulate(counts.begin(), counts.end(), std::size_t{ 0 });
  nodules > 0 ? explainContrasts(out) : void();
  out << "name," << (isOne ? "" : "organ,")
      << "start_s,duration_s,force_N,depth_mm,stiffness_at_1N_N_per_mm,energy_uJ,x_mm,y_mm,"
         "z_mm,normal_x,normal_y,normal_z,thickness_mm,tool,young_kPa,poisson,law"
      << (recording.rated ? ",outside_limits" : "");
  for (std::size_t number = 1; number <= nodules; ++number)
  {
    out << ",nodule_" << number << "_percent";
  }
  out << '\n';
  for (const PressSummary& press : findPresses(recording))
  {
    const Scene& organ = organOf(scene, press.organ);
    out << cell(press.name) << ',';
    isOne ? out : out << cell(recording.organName(press.organ)) << ',';
    out << shortest(press.begin) << ',' << shortest(press.end - press.begin) << ','
        << shortest(press.force) << ',' << shortest(toMillimeters(press.deepest.depth)) << ','
        << (press.stiffness ? shortest(units::toNewtonsPerMillimeter(*press.stiffness)) : "") << ','
        << shortest(units::toMicrojoules(press.energy));
    writePlace(out, press.deepest);
    writeLaw(out, organ.law);
    if (recording.rated)
    {
      out << ','
          << cell(outsideLimits(
               organ, validity[static_cast<std::size_t>(press.organ)], press.deepest));
    }
    writeContrasts(out, scene, press);
    out << '\n';
  }
}

void writePresses(const std::filesystem::path& file, const Recording& recording)
{
  std::ostringstream out;
  writePresses(out, recording);
  replaceFile(file, out.view());
}

} // namespace palp
