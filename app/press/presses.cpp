#include "app/press/presses.h"

#include "app/input/law_options.h"
#include "app/input/tip_text.h"
#include "haptics/contact/contact_geometry_of.h"
#include "haptics/files/csv_text.h"
#include "haptics/files/replace_file.h"
#include "haptics/units.h"

#include <algorithm>
#include <array>
#include <sstream>

namespace palp
{
namespace
{

constexpr double kBounce = 0.02; // [s]
constexpr double kNewton = 1.0;  // force at which stiffnesses are compared [N]

// on the way in, where the force comes to 1 N, between two samples
void watchStiffness(PressSummary& press, const Response& before, const Response& now)
{
  if (!press.stiffness && now.force >= kNewton)
  {
    const double gain = now.force - before.force;
    const double part = gain > 0.0 ? std::clamp((kNewton - before.force) / gain, 0.0, 1.0) : 1.0;
    press.stiffness = before.stiffness + part * (now.stiffness - before.stiffness);
  }
}

// in quotes, as a table takes it
std::string cell(const std::string& text)
{
  std::string quoted = "\"";
  for (const char c : text)
  {
    quoted.append(c == '"' ? 2 : 1, c);
  }
  return quoted + '"';
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

} // namespace

void PressFinder::add(const Sample& sample)
{
  const Contact& contact = sample.contact;
  if (!contact.touching())
  {
    isOpen_ = isOpen_ && sample.time - last_.time < kBounce;
    return;
  }
  if (!isOpen_ || sample.time - last_.time >= kBounce)
  {
    presses_.push_back({ .name = pressName(presses_.size()), .begin = sample.time });
    last_ = {}; // of no force at the surface
    isOpen_ = true;
  }
  PressSummary& press = presses_.back();
  press.end = sample.time;
  press.force = std::max(press.force, sample.response.force);
  watchStiffness(press, last_.response, sample.response);
  if (contact.depth > press.deepest.depth)
  {
    // the way that is new, from the largest depth so far: what was given back counts once
    const double from = std::max(press.deepest.depth, last_.contact.depth);
    press.energy += 0.5 * (last_.response.force + sample.response.force) * (contact.depth - from);
    press.deepest = contact;
  }
  last_ = sample;
}

std::string pressName(std::size_t index)
{
  return "press " + std::to_string(index + 1);
}

std::string outsideLimits(const Validity& validity, const PressSummary& press)
{
  const Contact& deepest = press.deepest;
  return brokenNames(validity(contactGeometryOf(deepest), deepest.edgeDistance));
}

std::vector<PressSummary> findPresses(const Recording& recording)
{
  PressFinder finder;
  for (const Sample& sample : recording.samples)
  {
    finder.add(sample);
  }
  std::vector<PressSummary> presses = finder.presses();
  for (std::size_t i = 0; i < presses.size(); ++i)
  {
    if (i < recording.names.size() && !recording.names[i].empty())
    {
      presses[i].name = recording.names[i];
    }
  }
  return presses;
}

void writePresses(std::ostream& out, const Recording& recording)
{
  using units::toMillimeters;
  const ForceLaw& law = recording.scene.law;
  const auto validity = recording.rated ? std::optional<Validity>(law) : std::nullopt;
  out << "# palp " << PALP_VERSION << '\n'
      << "# each press from touch to release; force of the law; place, normal and thickness where "
         "it was deepest, in the frame of the mesh\n"
      << "# energy: work on the way to the largest depth; stiffness: empty where 1 N was not "
         "reached; outside_limits: rules of validity that the deepest contact breaks\n"
      << "name,start_s,duration_s,force_N,depth_mm,stiffness_at_1N_N_per_mm,energy_uJ,x_mm,y_mm,"
         "z_mm,normal_x,normal_y,normal_z,thickness_mm,tool,young_kPa,poisson,law"
      << (validity ? ",outside_limits" : "") << '\n';
  for (const PressSummary& press : findPresses(recording))
  {
    out << cell(press.name) << ',' << shortest(press.begin) << ','
        << shortest(press.end - press.begin) << ',' << shortest(press.force) << ','
        << shortest(toMillimeters(press.deepest.depth)) << ','
        << (press.stiffness ? shortest(units::toNewtonsPerMillimeter(*press.stiffness)) : "") << ','
        << shortest(units::toMicrojoules(press.energy));
    writePlace(out, press.deepest);
    out << ',' << cell(describeTip(law.tip())) << ','
        << shortest(units::toKilopascals(law.material().youngModulus)) << ','
        << shortest(law.material().poissonRatio) << ',' << cell(describeLaw(law.settings()));
    if (validity)
    {
      out << ',' << cell(outsideLimits(*validity, press));
    }
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
