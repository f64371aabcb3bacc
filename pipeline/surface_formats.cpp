#include "pipeline/surface_formats.h"

#include "haptics/error.h"
#include "pipeline/child_process.h"
#include "pipeline/off_format.h"
#include "pipeline/poly_data.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <clocale>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <limits>
#include <string_view>
#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkOBJReader.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkPLYReader.h>
#include <vtkPolyData.h>
#include <vtkPolyDataReader.h>
#include <vtkSTLReader.h>
#include <vtkStringArray.h>
#include <vtkTriangleFilter.h>
#include <vtkXMLPolyDataReader.h>

namespace palp
{
namespace
{

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& message)
{
  throw Error(ErrorCode::BadFile, file.string() + ": " + message);
}

// keeps the first sign of failure that any object of VTK would print
class ErrorLog : public vtkOutputWindow
{
public:
  static ErrorLog* New();
  vtkTypeMacro(ErrorLog, vtkOutputWindow);

  void DisplayErrorText(const char* text) override
  {
    if (this->First.empty())
    {
      // "ERROR: In file, line n\nvtkClass (0x..): what happened"; a warning names no class
      std::string_view what(text);
      what.remove_prefix(what.find('\n') + 1);
      what = what.substr(0, what.find_first_of("\r\n"));
      const std::size_t name = what.find("): ");
      this->First = what.substr(name == what.npos ? 0 : name + 3);
    }
  }

  // data that end too early are but a warning to VTK
  void DisplayGenericWarningText(const char* text) override
  {
    if (std::strstr(text, "Error reading"))
    {
      this->DisplayErrorText(text);
    }
  }

  std::string First;
};
vtkStandardNewMacro(ErrorLog);

template <typename Reader>
vtkSmartPointer<vtkPolyData> readWith(const std::filesystem::path& file)
{
  vtkNew<Reader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  return reader->GetOutput();
}

struct Format
{
  const char* ending;
  const char* name;
  const char* signature; // how such a file begins; empty: in many ways
  vtkSmartPointer<vtkPolyData> (*read)(const std::filesystem::path&);
};

constexpr std::array kFormats{ Format{ ".stl", "STL", "", readWith<vtkSTLReader> },
  Format{ ".obj", "OBJ", "", readWith<vtkOBJReader> },
  Format{ ".ply", "PLY", "ply", readWith<vtkPLYReader> }, Format{ ".off", "OFF", "", readOff },
  Format{ ".vtk", "legacy VTK", "# vtk DataFile", readWith<vtkPolyDataReader> },
  Format{ ".vtp", "VTP", "<", readWith<vtkXMLPolyDataReader> } };

const Format& formatOf(const std::filesystem::path& file)
{
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
    [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const Format& format : kFormats)
  {
    if (ending == format.ending)
    {
      return format;
    }
  }
  refuse(file, "not a kind of surface file known here; give .stl, .obj, .ply, .off, .vtk or .vtp");
}

// VTK stops at the end of a binary STL file without a word
void checkBinaryStl(const std::filesystem::path& file, std::ifstream& in, std::uintmax_t size)
{
  constexpr std::uintmax_t header = 84; // [bytes], the last four are the number of triangles
  constexpr std::uintmax_t facet = 50;  // [bytes]
  std::string text(std::min<std::uintmax_t>(size, 512), '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  const bool isText = text.starts_with("solid") && text.find('\0') == std::string::npos;
  if (isText)
  {
    return;
  }
  std::uint32_t count = 0;
  if (size >= header)
  {
    std::memcpy(&count, text.data() + header - sizeof count, sizeof count);
  }
  if (size < header + facet)
  {
    refuse(file, "too short for a binary STL file; export the surface again");
  }
  if ((size - header) / facet < count)
  {
    refuse(file,
      "cut off: it holds " + std::to_string((size - header) / facet) + " of " +
        std::to_string(count) + " triangles; export or copy it again");
  }
}

void checkFile(const std::filesystem::path& file, const Format& format)
{
  std::error_code failure;
  const auto status = std::filesystem::status(file, failure);
  if (!std::filesystem::exists(status))
  {
    refuse(file, "not found; check the name");
  }
  if (!std::filesystem::is_regular_file(status))
  {
    refuse(file, "not a file; name a surface file");
  }
  std::ifstream in(file, std::ios::binary);
  if (!in)
  {
    refuse(file, "cannot be opened; check its permissions");
  }
  const std::uintmax_t size = std::filesystem::file_size(file, failure);
  if (size == 0)
  {
    refuse(file, "empty; export the surface again");
  }
  std::string start(std::strlen(format.signature), '\0');
  in.read(start.data(), static_cast<std::streamsize>(start.size()));
  if (start != format.signature)
  {
    refuse(
      file, std::string("not a ") + format.name + " file, whatever its name; rename or convert it");
  }
  if (std::string_view(format.ending) == ".stl")
  {
    in.seekg(0);
    checkBinaryStl(file, in, size);
  }
}

// a reader passes on whatever indices the file holds
bool indicesInRange(vtkCellArray& cells, vtkIdType points)
{
  if (!cells.IsValid())
  {
    return false;
  }
  vtkDataArray& indices = *cells.GetConnectivityArray();
  for (vtkIdType i = 0; i < indices.GetNumberOfValues(); ++i)
  {
    const double index = indices.GetComponent(i, 0);
    if (!(index >= 0.0 && index < static_cast<double>(points)))
    {
      return false;
    }
  }
  return true;
}

void checkContent(const std::filesystem::path& file, vtkPolyData& data)
{
  const vtkIdType points = data.GetNumberOfPoints();
  if (data.GetNumberOfPolys() + data.GetNumberOfStrips() == 0 || points == 0)
  {
    throw Error(ErrorCode::BadMesh,
      file.string() + ": no triangles in it; export a surface, not points or a volume");
  }
  if (points > std::numeric_limits<int>::max())
  {
    throw Error(ErrorCode::BadMesh, file.string() + ": too many points; export a coarser surface");
  }
  if (!indicesInRange(*data.GetPolys(), points) || !indicesInRange(*data.GetStrips(), points))
  {
    refuse(file, "a triangle names a point that is not there; export it again");
  }
  for (vtkIdType i = 0; i < points; ++i)
  {
    const double* p = data.GetPoint(i);
    constexpr double most = 1e12; // keeps every product of coordinates finite
    if (!(std::abs(p[0]) < most && std::abs(p[1]) < most && std::abs(p[2]) < most))
    {
      throw Error(ErrorCode::BadMesh,
        file.string() + ": point " + std::to_string(i + 1) +
          " has a coordinate that is not a usable number; repair the surface");
    }
  }
}

FileSurface readHere(const std::filesystem::path& file, const Format& format)
{
  std::setlocale(LC_ALL, "C"); // NOLINT(concurrency-mt-unsafe): alone in its process
  const vtkNew<ErrorLog> log;
  vtkOutputWindow::SetInstance(log);
  const vtkSmartPointer<vtkPolyData> data = format.read(file);
  if (!log->First.empty())
  {
    refuse(file,
      std::string("cannot be read as ") + format.name + " (" + log->First + "); export it again");
  }
  checkContent(file, *data);

  vtkNew<vtkTriangleFilter> cut;
  cut->PassVertsOff();
  cut->PassLinesOff();
  cut->SetInputData(data);
  cut->Update();
  FileSurface surface{
    .points = pointsOf(*data), .triangles = trianglesOf(*cut->GetOutput()), .unit = {}
  };
  auto* unit = vtkStringArray::SafeDownCast(data->GetFieldData()->GetAbstractArray(kUnitArray));
  if (unit && unit->GetNumberOfValues() == 1)
  {
    surface.unit = unit->GetValue(0);
  }
  return surface;
}

template <typename Value>
void pack(std::string& bytes, const Value* values, std::size_t count)
{
  bytes.append(reinterpret_cast<const char*>(&count), sizeof count);
  bytes.append(reinterpret_cast<const char*>(values), count * sizeof(Value));
}

template <typename Values>
void unpack(std::string_view& bytes, Values& values)
{
  std::size_t count = 0;
  std::memcpy(&count, bytes.data(), sizeof count);
  values.resize(count);
  std::memcpy(static_cast<void*>(values.data()), bytes.data() + sizeof count,
    count * sizeof(typename Values::value_type));
  bytes.remove_prefix(sizeof count + count * sizeof(typename Values::value_type));
}

} // namespace

FileSurface readFile(const std::filesystem::path& file)
{
  const Format& format = formatOf(file);
  checkFile(file, format);
  // several times what the slowest reader takes for an honest file
  const std::uint64_t size = std::filesystem::file_size(file);
  const ChildLimits limits{ .memory = (4ULL << 30) + 64 * size, .time = 10 + (size >> 20) };
  const auto packed = runInChild(
    [&]
    {
      const FileSurface surface = readHere(file, format);
      std::string bytes;
      pack(bytes, surface.points.data(), surface.points.size());
      pack(bytes, surface.triangles.data(), surface.triangles.size());
      pack(bytes, surface.unit.data(), surface.unit.size());
      return bytes;
    },
    limits);
  if (!packed)
  {
    refuse(file,
      std::string("damaged or cut off, no ") + format.name +
        " reader gets through it; export or copy it again");
  }
  std::string_view rest = *packed;
  FileSurface surface;
  unpack(rest, surface.points);
  unpack(rest, surface.triangles);
  unpack(rest, surface.unit);
  return surface;
}

} // namespace palp
