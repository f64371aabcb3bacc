#include "app/input/press_options.h"

#include "app/input/quantity.h"
#include "app/input/tip_text.h"
#include "haptics/error.h"
#include "haptics/units.h"

#include <CLI/CLI.hpp>

namespace palp
{

using namespace units::literals;

void TissueOptions::addTo(CLI::App& command)
{
  command
    .add_option("--tip", tip,
      "Tool: sphere:R, cone:ALPHA:BASE, punch:R, truncated-cone:ALPHA:FLAT:BASE, "
      "blunt-cone:ALPHA:TIP:BASE, paraboloid:R or profile:FILE.csv (ALPHA from axis to flank)")
    ->capture_default_str();
  command.add_option("--young", young, "Young's modulus E, 1Pa to 10GPa")->capture_default_str();
  command.add_option("--poisson", poisson, "Poisson's ratio nu, 0 to 0.5, no unit")
    ->capture_default_str();
  options.addTo(command);
}

ForceLaw TissueOptions::law() const
{
  return ForceLaw(parseTip(tip),
    makeMaterial(
      parseQuantity(young, Quantity::Pressure, "--young"), parseNumber(poisson, "--poisson")),
    options.settings());
}

void PressOptions::addTo(CLI::App& command)
{
  command.add_option("FILE", file,
    "Surface: STL, OBJ, PLY, OFF, VTK or VTP; image: MHA, MHD, NII, NII.GZ or VTI; the bundled "
    "liver if none");
  command.add_option("--unit", unit, "Unit of the coordinates in FILE: mm, cm, m or auto")
    ->check(CLI::IsMember({ "mm", "cm", "m", "auto" }))
    ->capture_default_str();
  command.add_option(
    "--level", level, "Value of an image on the surface, no unit: 0.5 for a mask of 0 and 1");
  command
    .add_option(
      "--label", labels, "Value of a label map whose region is the body: 5, or 1,2 for both")
    ->delimiter(',')
    ->excludes("--level");
  tissue.addTo(command);
  command
    .add_option("--contact", contact,
      "exact: depth to the triangles; paper: Sec. 4.1, from the mesh points inside the tool")
    ->check(CLI::IsMember({ "exact", "paper" }))
    ->capture_default_str();
  command.add_option("--damping", damping, "Damping along the surface normal")
    ->capture_default_str();
  command
    .add_option("--surface", surface,
      "paper: the ring of Eq. (8), beyond half a sphere's radius from the contact that a sphere "
      "can "
      "have; paper-literal: from r = sqrt(R depth) there, too; fitted: curves fitted to finite "
      "elements, scaled to the tool")
    ->check(CLI::IsMember({ "paper", "paper-literal", "fitted" }))
    ->capture_default_str();
  command.add_option("--table", table, "Calibration table depth -> R_d; the bundled one if none");
  command.add_option("--layer", layer,
    "Thickness of the tissue that R_d is taken for; five tool radii if none, as the paper's "
    "blocks");
  command.add_option("--threshold", threshold, "Sink of the surface at R_d")->capture_default_str();
}

ImagePart PressOptions::part() const
{
  ImagePart part;
  if (!level.empty())
  {
    part.level = parseNumber(level, "--level");
  }
  for (const std::string& label : labels)
  {
    part.labels.push_back(parseNumber(label, "--label"));
  }
  return part;
}

ContactRule PressOptions::rule() const
{
  return contact == "paper" ? ContactRule::Paper : ContactRule::Exact;
}

double PressOptions::layerSi() const
{
  return parseWithin(layer, Quantity::Length, { 0.1_mm, 1e3, "0.1mm to 1000m" }, "--layer");
}

double PressOptions::thresholdSi() const
{
  return parseWithin(
    threshold, Quantity::Length, { 1.0_um, 100.0_mm, "0.001mm to 100mm" }, "--threshold");
}

double PressOptions::dampingSi() const
{
  return checkedDamping(parseQuantity(damping, Quantity::Damping, "--damping"), "--damping");
}

} // namespace palp
