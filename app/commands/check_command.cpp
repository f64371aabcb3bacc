#include "app/commands/commands.h"
#include "app/input/mesh_file.h"
#include "app/input/option_values.h"
#include "app/input/press_options.h"
#include "app/input/quantity.h"
#include "app/program/interrupt.h"
#include "app/program/output.h"
#include "app/program/progress_line.h"
#include "calibration/figures/table.h"
#include "haptics/error.h"
#include "haptics/files/csv_text.h"
#include "haptics/files/input_text.h"
#include "haptics/units.h"
#include "pipeline/health/mesh_health.h"
#include "pipeline/health/mesh_repair.h"
#include "pipeline/model/poly_data.h"
#include "pipeline/surface_io/surface_io.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <map>
#include <memory>
#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>

namespace palp
{
namespace
{

using namespace units::literals;
using units::toMillimeters;

constexpr int kDisturbed = 7; // exit code
constexpr int kPrinted = 5;   // digits

struct CheckOptions
{
  MeshSource source;
  std::filesystem::path repaired;
  std::filesystem::path faults;
  double largestHole = 0.0; // length around it [m]
  bool overwrite = false;
};

// what becomes of a fault
struct Consequence
{
  const char* onLoading;
  const char* inAPress; // empty: nothing
};

Consequence consequenceOf(Fault fault)
{
  switch (fault)
  {
    case Fault::DuplicatePoint:
      return { "merged", "" };
    case Fault::UnusedPoint:
    case Fault::Degenerate:
    case Fault::InnerPiece:
      return { "left out", "" };
    case Fault::Flipped:
      return { "turned", "" };
    case Fault::DuplicateTriangle:
    case Fault::NonManifoldEdge:
      return { "kept", "inside and outside are not told apart near there" };
    case Fault::Sliver:
      return { "kept", "normal and curvature are rough there" };
    case Fault::NonManifoldPoint:
      return { "kept", "the normal is mixed at that point" };
    case Fault::Hole:
      return { "kept", "to be pressed from the front; flagged as an edge near there" };
    case Fault::SelfIntersection:
      return { "what is buried is left out, where closed", "the depth is uncertain near there" };
  }
  return { "kept", "" };
}

bool disturbs(const MeshHealth& health)
{
  return std::ranges::any_of(
    health.findings, [](const Finding& one) { return *consequenceOf(one.fault).inAPress != '\0'; });
}

std::string text(double value)
{
  return figures::textOf(value, kPrinted);
}

std::string inMillimeters(const Eigen::Vector3d& place)
{
  return text(toMillimeters(place.x())) + "," + text(toMillimeters(place.y())) + "," +
    text(toMillimeters(place.z()));
}

figures::Table tableOf(const MeshHealth& health)
{
  figures::Table table{ .name = "check",
    .caption = "Faults",
    .columns = { "fault", "count", "place_mm", "longest_around_mm", "on_loading", "in_a_press" } };
  for (const Finding& one : health.findings)
  {
    const auto [onLoading, inAPress] = consequenceOf(one.fault);
    table.rows.push_back(
      { std::string(nameOf(one.fault)), std::to_string(one.count), inMillimeters(one.place),
        one.size > 0.0 ? figures::Cell(toMillimeters(one.size)) : figures::Cell(std::string()),
        std::string(onLoading), std::string(inAPress) });
  }
  return table;
}

std::string piecesOf(const MeshHealth& health)
{
  constexpr std::size_t kMost = 5;
  std::string line = counted(health.pieces.size(), "piece");
  for (std::size_t i = 0; i < std::min(kMost, health.pieces.size()); ++i)
  {
    const MeshPiece& piece = health.pieces[i];
    line += (i == 0 ? ": " : "; ") + counted(piece.triangles, "triangle") +
      (piece.closed ? ", closed, " + text(units::toMilliliters(std::abs(piece.volume))) + " ml"
                    : ", open");
  }
  return line + (health.pieces.size() > kMost ? "; ..." : "");
}

// how many edges there are of each length, by octaves
std::string edgesOf(const std::vector<double>& lengths)
{
  std::map<int, std::size_t> octaves;
  for (const double length : lengths)
  {
    ++octaves[static_cast<int>(std::floor(std::log2(std::max(toMillimeters(length), 1e-6))))];
  }
  std::string line = counted(lengths.size(), "edge") + " of " +
    text(toMillimeters(lengths.front())) + " to " + text(toMillimeters(lengths.back())) +
    " mm, median " + text(toMillimeters(lengths[lengths.size() / 2])) + " mm:";
  for (const auto& [octave, count] : octaves)
  {
    line += " " + std::to_string(count) + " from " + text(std::exp2(octave)) + " mm,";
  }
  line.back() = '\n';
  return line;
}

std::string reportOf(const MeshHealth& health, const std::string& name)
{
  const Eigen::Vector3d size = health.high - health.low;
  std::string report = "# " + name + ": " + counted(health.points, "point") + ", " +
    counted(health.triangles, "triangle") + ", " + text(toMillimeters(size.x())) + " x " +
    text(toMillimeters(size.y())) + " x " + text(toMillimeters(size.z())) + " mm\n# " +
    piecesOf(health) + "\n";
  report += health.edgeLengths.empty() ? "" : "# " + edgesOf(health.edgeLengths);
  return report + figures::csv(tableOf(health), kPrinted);
}

// the surface as the file has it, each triangle with the number of its last fault, from 1
vtkSmartPointer<vtkPolyData> markedSurface(std::span<const Eigen::Vector3d> points,
  std::span<const Triangle> triangles, const MeshHealth& health)
{
  auto mesh = makePolyData(points, triangles);
  vtkNew<vtkUnsignedCharArray> marks;
  marks->SetName("fault");
  marks->SetNumberOfValues(static_cast<vtkIdType>(triangles.size()));
  marks->FillValue(0);
  for (const Finding& one : health.findings)
  {
    for (const int triangle : one.triangles)
    {
      marks->SetValue(triangle, static_cast<unsigned char>(static_cast<int>(one.fault) + 1));
    }
  }
  mesh->GetCellData()->SetScalars(marks);
  return mesh;
}

// files that are written beside others, which stay: those of one folder at once
class OutputFiles
{
public:
  explicit OutputFiles(const CheckOptions& options)
  {
    std::map<std::filesystem::path, std::vector<std::string>> names;
    for (const std::filesystem::path& file : { options.repaired, options.faults })
    {
      if (!file.empty())
      {
        names[folderOf(file)].push_back(file.filename());
      }
    }
    for (const auto& [folder, all] : names)
    {
      folders_[folder] =
        &outputs_.open(folder, all, options.overwrite, filesBehind(options.source.file));
    }
  }

  void write(const std::filesystem::path& file, vtkPolyData& mesh, const std::string& space) const
  {
    writeSurface(folders_.at(folderOf(file))->stage() / file.filename(), mesh, space);
  }

  void publish() const
  {
    for (const auto& [folder, files] : folders_)
    {
      files->publish();
    }
  }

private:
  static std::filesystem::path folderOf(const std::filesystem::path& file)
  {
    return std::filesystem::absolute(file).lexically_normal().parent_path();
  }

  Outputs outputs_;
  std::map<std::filesystem::path, OutputFolder*> folders_;
};

std::string doneIn(const RepairedMesh& repaired)
{
  std::string line;
  const auto add = [&](std::size_t count, const char* what, const char* many, const char* done)
  { line += count > 0 ? (line.empty() ? "" : ", ") + counted(count, what, many) + done : ""; };
  add(repaired.merged, "point", "points", " merged or left out");
  add(repaired.removed, "triangle", "triangles", " removed");
  add(repaired.cut, "triangle", "triangles", " added where points lay on edges of others");
  add(repaired.split, "point", "points", " added where parts met");
  add(repaired.slivers, "sliver", "slivers", " removed");
  add(repaired.filled, "hole", "holes", " closed");
  add(repaired.turned, "triangle", "triangles", " turned");
  line = line.empty() ? "nothing to repair" : line;
  add(repaired.seamsLeft, "edge", "edges",
    " left open beside others, as not all of a seam is within 1/50 of its edges");
  add(repaired.splitLeft, "point", "points", " left where parts meet, as these would cross");
  add(repaired.sliversLeft, "sliver", "slivers", " left, as the surface would cross itself");
  add(repaired.holesLeft, "hole", "holes", " left, as what closes them would cross the surface");
  return line;
}

// before any work
void checkNames(const CheckOptions& options)
{
  const auto refuse = [](const std::filesystem::path& file, const std::string& what)
  { throw Error(ErrorCode::BadValue, printable(file.string()) + ": " + what); };
  constexpr std::array kinds{ ".vtp", ".stl", ".ply", ".obj" };
  const std::filesystem::path& repaired = options.repaired;
  if (!repaired.empty() && std::ranges::count(kinds, repaired.extension().string()) == 0)
  {
    refuse(repaired, "not a kind of file written here; give .vtp, .stl, .ply or .obj");
  }
  if (!options.faults.empty() && options.faults.extension() != ".vtp")
  {
    refuse(options.faults, "only .vtp has a place for faults; give such a file");
  }
  if (!repaired.empty() && !options.faults.empty() &&
    std::filesystem::absolute(repaired).lexically_normal() ==
      std::filesystem::absolute(options.faults).lexically_normal())
  {
    refuse(repaired, "named by --repair and --faults; give two files");
  }
}

void runCheck(const CheckOptions& options)
{
  checkNames(options);
  const std::filesystem::path& file = options.source.file;
  const FileSurface read = readFileSurface(file, options.source.part);
  const LoadedSurface loaded = madeReady(read, file, options.source.unit);
  for (const std::string& note : loaded.notes)
  {
    std::cerr << "palp: " << note << '\n';
  }
  std::vector<Eigen::Vector3d> points = read.points;
  for (Eigen::Vector3d& point : points)
  {
    point *= unitLength(loaded.unit);
  }
  const ProgressLine progress("looking for faults");
  MeshHealth health = healthOf(points, read.triangles);
  std::cout << reportOf(health, printable(file.filename().string()));
  const OutputFiles out(options);
  if (!options.faults.empty())
  {
    out.write(options.faults, *markedSurface(points, read.triangles, health), read.space);
  }
  if (!options.repaired.empty())
  {
    const RepairedMesh repaired = repairedMesh(points, read.triangles, options.largestHole);
    health = healthOf(repaired.points, repaired.triangles);
    out.write(options.repaired, *makePolyData(repaired.points, repaired.triangles), read.space);
    std::cout << "# repaired: " << doneIn(repaired) << '\n'
              << reportOf(health, printable(options.repaired.filename().string()));
  }
  out.publish();
  if (disturbs(health))
  {
    throw CLI::RuntimeError(kDisturbed);
  }
}

} // namespace

void addCheckCommand(CLI::App& app)
{
  auto options = std::make_shared<CheckOptions>();
  CheckOptions* all = options.get();
  CLI::App* command =
    app.add_subcommand("check", "Tell what of a surface disturbs a press, and repair what is safe");
  options->source.addTo(*command);
  command->get_option("FILE")->required();
  command->add_option("--repair", options->repaired,
    "Surface to write, .vtp, .stl, .ply or .obj in mm: merged, oriented, without slivers, parted "
    "where it is not manifold");
  addParsed(*command, "--close-holes", "Length around the largest hole that --repair closes", "0mm",
    [all](const std::string& text)
    {
      all->largestHole =
        parseWithin(text, Quantity::Length, { 0.0, 10.0, "0mm to 10m" }, "--close-holes");
    });
  command->add_option("--faults", options->faults,
    "Surface to write as it was read, .vtp, whose cell array fault numbers the fault of each "
    "triangle");
  addOverwrite(*command, options->overwrite);
  command->footer(
    "Exit code 0: nothing disturbs a press; 7: something does, also after --repair.\n"
    "fault: 1 duplicate point, 2 unused point, 3 degenerate triangle, 4 duplicate triangle,\n"
    "5 sliver, 6 flipped triangle, 7 non-manifold edge, 8 non-manifold point, 9 hole,\n"
    "10 self-intersecting triangle, 11 inner piece. place_mm is that of the first, or of the\n"
    "widest hole, as --at takes it.\n"
    "Examples:\n"
    "  palp check liver.stl\n"
    "  palp check liver.stl --repair clean.vtp --close-holes 20mm\n"
    "  palp check liver.stl --faults faults.vtp      to be colored by fault in ParaView");
  command->callback([options] { runCheck(*options); });
}

} // namespace palp
