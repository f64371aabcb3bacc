#include "app/input/press_options.h"

#include "app/input/option_values.h"
#include "app/input/quantity.h"
#include "app/input/tip_text.h"
#include "app/input/tissue_presets.h"
#include "app/program/data_files.h"
#include "haptics/files/csv_text.h"
#include "haptics/units.h"
#include "pipeline/surface_io/label_names.h"

#include <CLI/CLI.hpp>

namespace palp
{

using namespace units::literals;

double parseLayer(const std::string& text)
{
  return parseWithin(text, Quantity::Length, { 0.1_mm, 1e3, "0.1mm to 1000m" }, "--layer");
}

double parseThreshold(const std::string& text)
{
  return parseWithin(
    text, Quantity::Length, { 1.0_um, 100.0_mm, "0.001mm to 100mm" }, "--threshold");
}

double parseDamping(const std::string& text)
{
  return checkedDamping(parseQuantity(text, Quantity::Damping, "--damping"), "--damping");
}

std::filesystem::path MeshSource::shownFile() const
{
  return bundled.empty() ? file : dataFile("meshes/" + bundled + ".vtp");
}

std::filesystem::path MeshSource::feltFile() const
{
  return bundled == "liver" ? dataFile("meshes/liver_haptic.vtp")
    : haptic.empty()        ? shownFile()
                            : haptic;
}

Eigen::Isometry3d MeshSource::frame() const
{
  using Turn = Eigen::AngleAxisd;
  return Eigen::Translation3d(origin) * Turn(rotation.z(), Eigen::Vector3d::UnitZ()) *
    Turn(rotation.y(), Eigen::Vector3d::UnitY()) * Turn(rotation.x(), Eigen::Vector3d::UnitX());
}

void addOrganFile(CLI::App& command, MeshSource& mesh)
{
  command.add_option("--organ", mesh.organ,
    "Where the whole body gives way: the file that palp organ FILE --support ... --out made of it");
  command
    .add_option("--support", mesh.supports,
      "Where it rests, as palp organ takes it; an organ file of other supports is refused")
    ->allow_extra_args(false);
}

void MeshSource::addTo(CLI::App& command, bool isNeeded)
{
  const std::string what =
    "Surface: STL, OBJ, PLY, OFF, VTK, VTP, VTU or MSH; image: MHA, MHD, NII, NII.GZ, NRRD (all "
    "in LPS) or VTI; a DICOM segmentation or a folder of DICOM images (LPS)";
  addParsed(command, "FILE", what + (isNeeded ? "" : "; the bundled liver if none"), "",
    [this](const std::string& text)
    {
      file = text;
      bundled.clear();
    })
    ->required(isNeeded);
  addParsed(command, "--unit", "Unit of the coordinates in FILE: mm, cm, m or auto", "auto",
    [this](const std::string& text) { unit = parseUnit(text); })
    ->check(CLI::IsMember({ "mm", "cm", "m", "auto" }));
  addParsed(command, "--series",
    "Which one where FILE is a folder of several DICOM series: its place in the list of them, or "
    "its UID",
    "", [this](const std::string& text) { part.series = text; });
  auto* level = addParsed(command, "--level",
    "Value of an image on the surface, no unit: 0.5 for a mask of 0 and 1", "",
    [this](const std::string& text) { part.level = parseNumber(text, "--level"); });
  auto* band = addParsed(command, "--values",
    "or all of an image with values LOW:HIGH, of a CT in Hounsfield units: 200:3071 for bone", "",
    [this](const std::string& text) { part.band = parseBand(text, "--values"); });
  band->excludes(level);
  addParsed(command, "--names",
    "Table of the labels' names: of 3D Slicer, ITK-SNAP, or JSON as of TotalSegmentator", "",
    [this](const std::string& text) { part.names = readLabelNames(text); });
  addParsed(command, "--label",
    "Region of a label map that is the body, by value or name: 5, or 1,2 for both", "",
    [this](const std::string& text)
    { part.labels = valuesOfLabels(parseLabels(text, "--label"), part.names); })
    ->excludes(level)
    ->excludes(band);
}

CLI::Option* addTip(CLI::App& command, Tip& tip, const std::string& usual)
{
  return addParsed(command, "--tip",
    "Tool: sphere:R, cone:ALPHA:BASE, punch:R, truncated-cone:ALPHA:FLAT:BASE, "
    "blunt-cone:ALPHA:TIP:BASE, paraboloid:R or profile:FILE.csv (ALPHA from axis to flank)",
    usual, [&tip](const std::string& text) { tip = parseTip(text); });
}

CLI::Option* addPoisson(CLI::App& command, double& poisson)
{
  return addParsed(command, "--poisson", "Poisson's ratio nu, 0 to 0.5, no unit", shortest(poisson),
    [&poisson](const std::string& text) { poisson = parseNumber(text, "--poisson"); });
}

void TissueOptions::addTo(CLI::App& command)
{
  addMaterialTo(command);
  options.addTo(command);
}

void TissueOptions::addMaterialTo(CLI::App& command)
{
  addTip(command, tip, describeTip(tip));
  addParsed(command, "--tissue", // first, so that E and nu win over it wherever they stand
    "Tissue whose E and nu are taken, as in hcc, by a name of palp tissues; --young and --poisson "
    "win over it",
    "", [this](const std::string& name) { take(name); });
  addParsed(command, "--young",
    "Young's modulus E, 1Pa to 10GPa; what holds without it is a tumor's, 7.5 times that of "
    "healthy liver",
    shortest(young / 1.0_kPa) + "kPa",
    [this](const std::string& text)
    { young = parseQuantity(text, Quantity::Pressure, "--young"); });
  addPoisson(command, poisson);
}

void TissueOptions::take(const std::string& name)
{
  const std::vector<TissuePreset> tissues = shippedTissues();
  const Material& material = tissueNamed(name, tissues, "--tissue").material;
  young = material.youngModulus;
  poisson = material.poissonRatio;
}

TissueOptions optionsOf(const ForceLaw& law, bool rated)
{
  const LawSettings& settings = law.settings();
  return { .tip = law.tip(),
    .young = law.material().youngModulus,
    .poisson = law.material().poissonRatio,
    .options = { .mode = settings.mode,
      .base = settings.base,
      .constitution = settings.constitution,
      .coatings = settings.coatings,
      .relaxation = settings.relaxation,
      .friction = settings.friction,
      .rated = rated } };
}

ForceLaw TissueOptions::law() const
{
  return { tip, makeMaterial(young, poisson), options.settings() };
}

void PressOptions::addTo(CLI::App& command)
{
  tissue.addTo(command);
  addChoice(command, "--contact",
    "exact: depth to the triangles; paper: Sec. 4.1, from the mesh points inside the tool",
    kContactRules, contact);
  addParsed(command, "--damping", "Damping along the surface normal", "0N*s/m",
    [this](const std::string& text) { damping = parseDamping(text); });
  addParsed(command, "--friction",
    "mu between tool and tissue, 0 to 5, no unit, for --law corrected; no liver value known", "0",
    [this](const std::string& text) { tissue.options.friction = parseFriction(text); });
  addChoice(command, "--surface",
    "paper: the ring of Eq. (8), beyond half a sphere's radius from the contact that a sphere can "
    "have; paper-literal: from r = sqrt(R depth) there, too; fitted: curves fitted to finite "
    "elements, scaled to the tool",
    kDentSurfaces, dent.surface);
  command.add_option(
    "--table", dent.table, "Calibration table depth -> R_d; the bundled one if none");
  addParsed(command, "--layer",
    "Thickness of the tissue that R_d is taken for; five tool radii if none, as the paper's "
    "blocks",
    "", [this](const std::string& text) { dent.layer = parseLayer(text); });
  addParsed(command, "--threshold", "Displacement of the surface at R_d", "0.5mm",
    [this](const std::string& text) { dent.threshold = parseThreshold(text); });
}

} // namespace palp
