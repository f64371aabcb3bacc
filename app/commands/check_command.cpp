#include "app/check/check_text.h"
#include "app/check/checked_surface.h"
#include "app/commands/commands.h"
#include "app/input/mesh_file.h"
#include "app/input/option_values.h"
#include "app/input/press_options.h"
#include "app/program/output.h"
#include "calibration/figures/table.h"
#include "haptics/error.h"
#include "haptics/files/input_text.h"
#include "pipeline/model/poly_data.h"
#include "pipeline/surface_io/surface_io.h"

#include <CLI/CLI.hpp>

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

constexpr int kDisturbed = 7; // exit code

struct CheckOptions
{
  MeshSource source;
  std::filesystem::path repaired;
  std::filesystem::path faults;
  double largestHole = 0.0; // length around it [m]
  bool overwrite = false;
};

std::string reportOf(const MeshHealth& health, const std::filesystem::path& file)
{
  std::string report;
  for (const std::string& line : measuresOf(health, file))
  {
    report += "# " + line + '\n';
  }
  return report + figures::csv(faultTable(health), kCheckDigits);
}

// the surface as the file has it, each triangle with the number of its last fault, from 1
vtkSmartPointer<vtkPolyData> markedSurface(const CheckedSurface& checked)
{
  auto mesh = makePolyData(checked.points, checked.triangles);
  vtkNew<vtkUnsignedCharArray> marks;
  marks->SetName("fault");
  marks->SetNumberOfValues(static_cast<vtkIdType>(checked.triangles.size()));
  marks->FillValue(0);
  for (const Finding& one : checked.health.findings)
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

  // where a file waits until all are written
  [[nodiscard]] std::filesystem::path staged(const std::filesystem::path& file) const
  {
    return folders_.at(folderOf(file))->stage() / file.filename();
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

// before any work
void checkNames(const CheckOptions& options)
{
  const auto refuse = [](const std::filesystem::path& file, const std::string& what)
  { throw Error(ErrorCode::BadValue, printable(file.string()) + ": " + what); };
  const std::filesystem::path& repaired = options.repaired;
  repaired.empty() ? void() : checkRepairName(repaired);
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
  const CheckedSurface checked =
    checkFile(options.source.file, options.source.unit, options.source.part);
  for (const std::string& note : checked.notes)
  {
    std::cerr << "palp: " << note << '\n';
  }
  std::cout << reportOf(checked.health, checked.file);
  const OutputFiles out(options);
  if (!options.faults.empty())
  {
    writeSurface(out.staged(options.faults), *markedSurface(checked), checked.space);
  }
  bool isDisturbed = disturbs(checked.health);
  if (!options.repaired.empty())
  {
    const CheckedRepair repaired = repairedSurface(checked, options.largestHole);
    isDisturbed = disturbs(repaired.health);
    writeRepaired(out.staged(options.repaired), repaired, checked);
    std::cout << "# repaired: " << doneIn(repaired.mesh) << '\n'
              << reportOf(repaired.health, options.repaired);
  }
  out.publish();
  if (isDisturbed)
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
  options->source.addTo(*command, true);
  auto* repair = command->add_option("--repair", options->repaired,
    "Surface to write, .vtp, .stl, .ply or .obj in mm: merged, oriented, without slivers, parted "
    "where it is not manifold");
  addParsed(*command, "--close-holes", "Length around the largest hole that --repair closes", "0mm",
    [all](const std::string& text) { all->largestHole = parseLargestHole(text, "--close-holes"); })
    ->needs(repair);
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
