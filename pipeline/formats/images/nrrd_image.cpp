#include "pipeline/formats/images/nrrd_image.h"

#include "haptics/files/csv_text.h"
#include "haptics/files/input_text.h"
#include "pipeline/formats/images/inflate.h"
#include "pipeline/formats/images/nrrd_fields.h"
#include "pipeline/formats/images/nrrd_segments.h"
#include "pipeline/formats/meshes/refuse.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <sstream>
#include <string_view>
#include <vector>
#include <vtkByteSwap.h>
#include <vtkDataArray.h>
#include <vtkImageData.h>

namespace palp
{
namespace
{

// what is not read here
void checkHeader(const std::filesystem::path& file, const NrrdFields& fields)
{
  for (const char* skip : { "line skip", "lineskip", "byte skip", "byteskip" })
  {
    if (const std::string count = fieldOf(fields, skip); !count.empty() && count != "0")
    {
      refuse(file, std::string("its header has a ") + skip + "; save it without");
    }
  }
  const std::string encoding = fieldOf(fields, "encoding");
  if (encoding != "raw" && encoding != "gzip" && encoding != "gz")
  {
    refuse(file, "its encoding is " + inQuotes(encoding) + "; save it raw or as gzip");
  }
}

// what the definition calls them
int vtkTypeOf(const std::filesystem::path& file, const std::string& type)
{
  static const std::map<std::string_view, int> types{ { "signed char", VTK_SIGNED_CHAR },
    { "int8", VTK_SIGNED_CHAR }, { "int8_t", VTK_SIGNED_CHAR }, { "uchar", VTK_UNSIGNED_CHAR },
    { "unsigned char", VTK_UNSIGNED_CHAR }, { "uint8", VTK_UNSIGNED_CHAR },
    { "uint8_t", VTK_UNSIGNED_CHAR }, { "short", VTK_SHORT }, { "short int", VTK_SHORT },
    { "signed short", VTK_SHORT }, { "signed short int", VTK_SHORT }, { "int16", VTK_SHORT },
    { "int16_t", VTK_SHORT }, { "ushort", VTK_UNSIGNED_SHORT },
    { "unsigned short", VTK_UNSIGNED_SHORT }, { "unsigned short int", VTK_UNSIGNED_SHORT },
    { "uint16", VTK_UNSIGNED_SHORT }, { "uint16_t", VTK_UNSIGNED_SHORT }, { "int", VTK_INT },
    { "signed int", VTK_INT }, { "int32", VTK_INT }, { "int32_t", VTK_INT },
    { "uint", VTK_UNSIGNED_INT }, { "unsigned int", VTK_UNSIGNED_INT },
    { "uint32", VTK_UNSIGNED_INT }, { "uint32_t", VTK_UNSIGNED_INT }, { "longlong", VTK_LONG_LONG },
    { "long long", VTK_LONG_LONG }, { "long long int", VTK_LONG_LONG }, { "int64", VTK_LONG_LONG },
    { "int64_t", VTK_LONG_LONG }, { "ulonglong", VTK_UNSIGNED_LONG_LONG },
    { "unsigned long long", VTK_UNSIGNED_LONG_LONG }, { "uint64", VTK_UNSIGNED_LONG_LONG },
    { "uint64_t", VTK_UNSIGNED_LONG_LONG }, { "float", VTK_FLOAT }, { "double", VTK_DOUBLE } };
  const auto found = types.find(type);
  if (found == types.end())
  {
    refuse(
      file, "its type is " + inQuotes(type) + ", no number that is read here; save it as another");
  }
  return found->second;
}

// the sizes of its axes: three of space, and before them that of the layers
struct Sizes
{
  int layers = 1;
  std::array<int, 3> voxels{};
};

Sizes sizesOf(const std::filesystem::path& file, const NrrdFields& fields)
{
  const std::vector<double> sizes = numbersIn(fieldOf(fields, "sizes"));
  const std::string axes = std::to_string(sizes.size());
  if (fieldOf(fields, "dimension") != axes)
  {
    refuse(file, "its sizes are not as many as its dimension; export it again");
  }
  const std::string directions = fieldOf(fields, "space directions");
  const bool isLayered = sizes.size() == 4 && directions.starts_with("none");
  if (sizes.size() != 3 && !isLayered)
  {
    refuse(file,
      "an image of " + axes +
        " axes, not of three, as over time, of colors, or of layers behind those of space; save "
        "one volume of it, of one value at each voxel, as a file of its own");
  }
  constexpr double most = 100'000;
  if (!std::ranges::all_of(
        sizes, [](double size) { return size >= 1.0 && size <= most && size == std::floor(size); }))
  {
    refuse(file, "its sizes are " + inQuotes(fieldOf(fields, "sizes")) + "; export it again");
  }
  Sizes result{ .layers = isLayered ? static_cast<int>(sizes.front()) : 1 };
  std::transform(sizes.end() - 3, sizes.end(), result.voxels.begin(),
    [](double size) { return static_cast<int>(size); });
  return result;
}

// what brings the file's own axes to left, back and head; nothing where it names others
std::optional<std::array<double, 3>> toLps(std::string space)
{
  space = lowered(space);
  using Turn = std::array<double, 3>;
  return space == "left-posterior-superior" || space == "lps" ? std::optional(Turn{ 1, 1, 1 })
    : space == "right-anterior-superior" || space == "ras"    ? std::optional(Turn{ -1, -1, 1 })
    : space == "left-anterior-superior" || space == "las"     ? std::optional(Turn{ 1, -1, 1 })
                                                              : std::nullopt;
}

// one for all axes; empty: it names none
std::string unitOf(const std::filesystem::path& file, const NrrdFields& fields)
{
  const std::string given = fieldOf(fields, "space units");
  const std::vector<std::string_view> parts = split(given, '"');
  std::set<std::string> named; // every other part is between quotes
  for (std::size_t i = 1; i < parts.size(); i += 2)
  {
    named.emplace(parts[i] == "\u00b5m" || parts[i] == "microns" ? "um" : parts[i]);
  }
  named.erase("");
  std::string unit = named.empty() ? "" : *named.begin();
  const bool isKnown = unit.empty() || unit == "um" || unit == "mm" || unit == "cm" || unit == "m";
  if (named.size() > 1 || !isKnown)
  {
    refuse(file, "its space units are " + inQuotes(given) + "; export it in mm");
  }
  return unit;
}

// Where the first voxel's center lies, of the older form: the axes begin there, or half a voxel
// before it where their samples are cells; an axis that tells neither begins at 0.
std::vector<double> beginOf(
  const std::filesystem::path& file, const NrrdFields& fields, const std::vector<double>& sides)
{
  std::vector<double> begin = numbersIn(fieldOf(fields, "axis mins"));
  std::string kinds = fieldOf(fields, "centerings");
  kinds = kinds.empty() ? fieldOf(fields, "centers") : kinds;
  if (begin.empty())
  {
    return begin;
  }
  if (begin.size() != sides.size())
  {
    refuse(file, "its axis mins are not one for each axis; write them so, or leave them out");
  }
  std::istringstream words(kinds);
  for (std::size_t k = 0; k < sides.size(); ++k)
  {
    std::string centering;
    words >> centering;
    begin[k] = std::isnan(begin[k]) ? 0.0 : begin[k] + (centering == "cell" ? 0.5 * sides[k] : 0.0);
  }
  return begin;
}

void place(const std::filesystem::path& file, const NrrdFields& fields, PatientImage& result)
{
  const std::string space = fieldOf(fields, "space");
  const auto turn = toLps(space);
  if (!space.empty() && !turn && space.find("xyz") == space.npos && !space.starts_with("3D"))
  {
    refuse(file, "its space is " + inQuotes(space) + "; save it in left-posterior-superior");
  }
  const std::string given = fieldOf(fields, "space directions");
  std::vector<double> axes = numbersIn(given.substr(given.starts_with("none") ? 4 : 0));
  std::vector<double> origin = numbersIn(fieldOf(fields, "space origin"));
  if (given.empty()) // the older form
  {
    const std::vector<double> sides = numbersIn(fieldOf(fields, "spacings"));
    if (sides.size() != 3)
    {
      refuse(file,
        "its header has no space directions or spacings, the size of a voxel; write them there");
    }
    axes.assign(9, 0.0);
    for (std::size_t k = 0; k < 3; ++k)
    {
      axes[4 * k] = sides[k];
    }
    origin = origin.empty() ? beginOf(file, fields, sides) : origin;
  }
  if (origin.empty() && turn)
  {
    result.notes.emplace_back("warning: its header has no space origin; its first voxel is taken "
                              "to be at 0, 0, 0");
  }
  origin.resize(origin.empty() ? 3 : origin.size());
  if (axes.size() != 9 || origin.size() != 3)
  {
    refuse(file, "its space directions are not three vectors; export it again");
  }
  double* row = result.toPatient;
  for (std::size_t i = 0; i < 3; ++i)
  {
    const double sign = turn ? (*turn)[i] : 1.0;
    for (std::size_t k = 0; k < 3; ++k)
    {
      row[4 * i + k] = sign * axes[3 * k + i];
    }
    row[4 * i + 3] = sign * origin[i];
  }
  row[15] = 1.0;
  result.unit = unitOf(file, fields);
  result.space = turn ? "LPS" : "";
  if (result.unit.empty() && turn)
  {
    result.unit = "mm"; // as 3D Slicer writes none in the patient's axes
  }
  result.notes.emplace_back(turn ? "in the patient's axes to left, back and head (LPS)"
                                 : "the header tells no place in the patient; its own axes are "
                                   "taken");
}

std::uintmax_t bytesOf(const Sizes& sizes, int type)
{
  auto bytes = static_cast<std::uintmax_t>(sizes.layers) *
    static_cast<std::uintmax_t>(vtkDataArray::GetDataTypeSize(type));
  for (const int size : sizes.voxels)
  {
    bytes *= static_cast<std::uintmax_t>(size);
  }
  return bytes;
}

// before there is room for what it claims
void checkLength(const std::filesystem::path& file, const NrrdHeader& header, std::uintmax_t bytes)
{
  const std::uintmax_t there = std::filesystem::file_size(header.data) - header.begin;
  const bool isRaw = fieldOf(header.fields, "encoding") == "raw";
  if (there < (isRaw ? bytes : bytes / kDeflateRatio))
  {
    refuseCut(file, there, bytes);
  }
  if (isRaw && there > bytes)
  {
    refuseMore(file, there, bytes, "mend its sizes");
  }
}

void readVoxels(
  const std::filesystem::path& file, const NrrdHeader& header, std::span<unsigned char> voxels)
{
  std::ifstream in(header.data, std::ios::binary);
  in.seekg(static_cast<std::streamoff>(header.begin));
  if (fieldOf(header.fields, "encoding") == "raw")
  {
    in.read(reinterpret_cast<char*>(voxels.data()), static_cast<std::streamsize>(voxels.size()));
  }
  else
  {
    inflateInto(voxels, in, std::filesystem::file_size(header.data) - header.begin, file);
  }
}

} // namespace

PatientImage readNrrd(const std::filesystem::path& file)
{
  const NrrdHeader header = readNrrdHeader(file);
  const NrrdFields& fields = header.fields;
  checkHeader(file, fields);
  const Sizes sizes = sizesOf(file, fields);
  PatientImage result{ .image = vtkSmartPointer<vtkImageData>::New(), .toPatient = {} };
  place(file, fields, result);
  const int type = vtkTypeOf(file, fieldOf(fields, "type"));
  const std::uintmax_t bytes = bytesOf(sizes, type);
  checkLength(file, header, bytes);
  result.image->SetDimensions(sizes.voxels.data());
  result.image->AllocateScalars(type, sizes.layers);
  auto* voxels = static_cast<unsigned char*>(result.image->GetScalarPointer());
  readVoxels(file, header, { voxels, bytes });
  const auto wide = static_cast<std::uintmax_t>(result.image->GetScalarSize());
  const std::string endian = fieldOf(fields, "endian");
  if (wide > 1 && endian != "big" && endian != "little")
  {
    refuse(file, "its endian is " + inQuotes(endian) + ", not little or big; export it again");
  }
  if (wide > 1 && endian == "big")
  {
    vtkByteSwap::SwapVoidRange(voxels, bytes / wide, wide);
  }
  result.segments = nrrdSegments(file, fields, sizes.layers);
  return result;
}

std::uintmax_t nrrdBytes(const std::filesystem::path& file)
{
  const NrrdFields fields = readNrrdHeader(file).fields;
  return bytesOf(sizesOf(file, fields), vtkTypeOf(file, fieldOf(fields, "type")));
}

} // namespace palp
