#include "pipeline/surface_io/surface_io.h"

#include "haptics/error.h"
#include "haptics/files/csv_text.h"
#include "haptics/files/prefix.h"
#include "haptics/files/replace_file.h"
#include "haptics/units.h"
#include "pipeline/model/poly_data.h"
#include "pipeline/process/child_process.h"
#include "pipeline/process/file_surface.h"
#include "pipeline/surface_io/surface_repair.h"

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <map>
#include <sstream>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataWriter.h>

namespace palp
{
namespace
{

// factor: from the unit of the points to that of the result
vtkSmartPointer<vtkPolyData> scaled(vtkPolyData& mesh, double factor)
{
  vtkNew<vtkPoints> points;
  points->SetDataType(mesh.GetPoints()->GetDataType());
  points->SetNumberOfPoints(mesh.GetNumberOfPoints());
  for (vtkIdType i = 0; i < mesh.GetNumberOfPoints(); ++i)
  {
    const double* p = mesh.GetPoint(i);
    points->SetPoint(i, factor * p[0], factor * p[1], factor * p[2]);
  }
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->ShallowCopy(&mesh);
  result->SetPoints(points);
  return result;
}

std::string summary(const std::string& name, const LoadedSurface& surface, const std::string& why)
{
  double box[6];
  surface.mesh->GetBounds(box);
  std::ostringstream text;
  text << name << ": " << surface.mesh->GetNumberOfPoints() << " points, "
       << surface.mesh->GetNumberOfPolys() << " triangles, " << (surface.closed ? "closed, " : "");
  text.precision(3);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double side = units::toMillimeters(box[2 * axis + 1] - box[2 * axis]);
    text << (axis > 0 ? " x " : "") << (side < 100.0 ? side : std::round(side));
  }
  text << " mm; coordinates taken in " << unitName(surface.unit) << ", " << why;
  return text.str();
}

void writeVtp(const std::filesystem::path& file, vtkPolyData& data)
{
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(&data);
  writer->WriteToOutputStringOn();
  writer->SetCompressionLevel(1); // a third of the time; coordinates hardly shrink by more
  if (writer->Write() != 1)
  {
    refuseFile(file, ENOMEM);
  }
  replaceFile(file, writer->GetOutputString());
}

template <typename Value>
void append(std::string& bytes, const Value& value)
{
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

// VTK's writers of the kinds below tell a full disk late, in words of their own or not at all

// the word in a header, where 3D Slicer looks for the axes; empty: unknown
std::string headerOf(vtkPolyData& data)
{
  auto* space = vtkStringArray::SafeDownCast(data.GetFieldData()->GetAbstractArray(kSpaceArray));
  return space ? std::string(kSpaceArray) + "=" + space->GetValue(0) : std::string();
}

void writePly(const std::filesystem::path& file, vtkPolyData& data)
{
  static_assert(std::endian::native == std::endian::little);
  const std::vector<Eigen::Vector3d> points = pointsOf(data);
  const std::vector<Triangle> triangles = trianglesOf(data);
  const std::string header = headerOf(data);
  std::string bytes = "ply\nformat binary_little_endian 1.0\n" +
    (header.empty() ? "" : "comment " + header + "\n") + "element vertex " +
    std::to_string(points.size()) +
    "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
    std::to_string(triangles.size()) + "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const Eigen::Vector3d& point : points)
  {
    append(bytes, point.cast<float>().eval());
  }
  for (const Triangle& triangle : triangles)
  {
    append(bytes, std::uint8_t{ 3 });
    append(bytes, triangle);
  }
  replaceFile(file, bytes);
}

void writeStl(const std::filesystem::path& file, vtkPolyData& data)
{
  const std::vector<Eigen::Vector3d> points = pointsOf(data);
  const std::vector<Triangle> triangles = trianglesOf(data);
  std::string bytes = "binary STL " + headerOf(data);
  bytes.resize(80, ' ');
  append(bytes, static_cast<std::uint32_t>(triangles.size()));
  const auto at = [&](int i) { return points[static_cast<std::size_t>(i)]; };
  for (const auto& [a, b, c] : triangles)
  {
    const Eigen::Vector3d normal = (at(b) - at(a)).cross(at(c) - at(a)).normalized();
    for (const Eigen::Vector3d& vector : { normal, at(a), at(b), at(c) })
    {
      append(bytes, vector.cast<float>().eval());
    }
    append(bytes, std::uint16_t{ 0 });
  }
  replaceFile(file, bytes);
}

void writeObj(const std::filesystem::path& file, vtkPolyData& data)
{
  const std::string header = headerOf(data);
  std::string text = header.empty() ? "" : "# " + header + "\n";
  for (const Eigen::Vector3d& point : pointsOf(data))
  {
    text +=
      "v " + shortest(point.x()) + ' ' + shortest(point.y()) + ' ' + shortest(point.z()) + '\n';
  }
  for (const auto& [a, b, c] : trianglesOf(data))
  {
    text += "f " + std::to_string(a + 1) + ' ' + std::to_string(b + 1) + ' ' +
      std::to_string(c + 1) + '\n';
  }
  replaceFile(file, text);
}

} // namespace

namespace
{

// the command line of the reader, which reads numbers in the C locale
std::vector<std::string> commandOf(
  const std::filesystem::path& file, const ImagePart& part, const std::string& mode = "surface")
{
  std::vector<std::string> command{ (prefix() / "bin/palp-read").string(), file.string(), mode };
  if (part.level)
  {
    command.push_back("level=" + shortest(*part.level));
  }
  if (part.band)
  {
    command.push_back("band=" + shortest((*part.band)[0]) + ':' + shortest((*part.band)[1]));
  }
  command.push_back("components=" + std::to_string(part.components));
  for (const LabelName& label : part.names)
  {
    command.push_back("name=" + shortest(label.value) + ':' + label.name);
  }
  if (!part.series.empty())
  {
    command.push_back("series=" + part.series);
  }
  for (const std::string& label : part.labels)
  {
    command.push_back("label=" + label);
  }
  return command;
}

[[noreturn]] void refuseCrash(const std::filesystem::path& file)
{
  throw Error(ErrorCode::BadFile,
    file.string() +
      ": damaged or cut off: the reader crashed or exceeded its limits; export or copy it again");
}

// what the reader answers, unpacked
template <typename What>
What read(const std::filesystem::path& file, const std::vector<std::string>& command,
  std::optional<What> (*unpacked)(std::string_view))
{
  const auto answer = answerOf(command);
  std::optional<What> what = answer ? unpacked(*answer) : std::nullopt;
  what ? void() : refuseCrash(file);
  return *std::move(what);
}

} // namespace

FileSurface readFileSurface(const std::filesystem::path& file, const ImagePart& part)
{
  return read(file, commandOf(file, part), unpack);
}

FileOrgans readFileOrgans(const std::filesystem::path& file, const ImagePart& part, bool isList)
{
  return read(file, commandOf(file, part, isList ? "list" : "organs"), unpackOrgans);
}

FileOrgans readFileOrgansAt(
  const std::filesystem::path& file, const ImagePart& part, std::span<const std::size_t> places)
{
  std::vector<std::string> command = commandOf(file, part, "some");
  for (const std::size_t place : places)
  {
    command.push_back("place=" + std::to_string(place));
  }
  return read(file, command, unpackOrgans);
}

LoadedSurface readSurface(const std::filesystem::path& file, UnitChoice unit, const ImagePart& part)
{
  return madeReady(read(file, commandOf(file, part, "joined"), unpack), file, unit);
}

LoadedSurface madeReady(const FileSurface& read, const std::filesystem::path& file, UnitChoice unit)
{
  const std::string name = file.filename().string();
  const RepairedSurface repaired =
    repair(read.points, read.triangles, file.string(), read.field > 0.0);

  const UnitChoice named = unitNamed(read.unit);
  std::string why = "as asked";
  if (unit && named && *unit != *named)
  {
    why.append(", though the file says ").append(unitName(*named));
  }
  std::vector<std::string> warnings = repaired.warnings;
  if (!unit)
  {
    unit = named;
    why = "as the file says";
    if (!unit && !read.unit.empty())
    {
      throw Error(ErrorCode::BadFile,
        file.string() + ": its unit, " + inQuotes(read.unit) +
          ", is none that is read; say what a coordinate of 1 is: mm, cm or m (--unit)");
    }
  }
  if (!unit)
  {
    double box[6];
    repaired.mesh->GetBounds(box);
    const bool isSlicers = !read.space.empty() && read.field == 0.0;
    unit = guessUnit(std::max({ box[1] - box[0], box[3] - box[2], box[5] - box[4] }), file.string(),
      read.field, isSlicers);
    why = "a guess";
    warnings.push_back(std::string("the file names no unit; ") + unitName(*unit) +
      (isSlicers ? " gives" : " is the only one that gives") +
      " the size of an organ or a part of one; --unit " + unitName(*unit) + " confirms it");
  }
  LoadedSurface surface{ .mesh = scaled(*repaired.mesh, unitLength(*unit)),
    .unit = *unit,
    .closed = repaired.closed,
    .space = read.space,
    .notes = {} };
  surface.notes.push_back(summary(name, surface, why));
  constexpr std::string_view kWarning = "warning: ";
  const auto tell = [&](std::string_view kind, std::string_view what)
  { surface.notes.emplace_back(kind).append(name).append(": ").append(what); };
  for (const std::string_view note : read.notes)
  {
    const bool warns = note.starts_with(kWarning);
    tell(warns ? kWarning : "", note.substr(warns ? kWarning.size() : 0));
  }
  for (const std::string& note : repaired.notes)
  {
    tell("", note);
  }
  for (const std::string& warning : warnings)
  {
    tell(kWarning, warning);
  }
  return surface;
}

void writeSurface(const std::filesystem::path& file, vtkPolyData& mesh, const std::string& space)
{
  using Writer = void (*)(const std::filesystem::path&, vtkPolyData&);
  const std::map<std::string, Writer> writers{ { ".vtp", writeVtp }, { ".stl", writeStl },
    { ".ply", writePly }, { ".obj", writeObj } };
  const auto writer = writers.find(file.extension().string());
  if (writer == writers.end())
  {
    throw Error(ErrorCode::BadFile,
      file.string() + ": not a kind of file written here; give .vtp, .stl, .ply or .obj");
  }
  const auto data = scaled(mesh, 1.0 / unitLength(LengthUnit::Millimeter));
  data->SetFieldData(vtkNew<vtkFieldData>());
  const auto add = [&](const char* name, const std::string& value)
  {
    vtkNew<vtkStringArray> words;
    words->SetName(name);
    words->InsertNextValue(value);
    data->GetFieldData()->AddArray(words);
  };
  add(kUnitArray, unitName(LengthUnit::Millimeter));
  if (!space.empty())
  {
    add(kSpaceArray, space);
  }
  writer->second(file, *data);
}

} // namespace palp
