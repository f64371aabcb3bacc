#include "pipeline/formats/meta_image.h"

#include "haptics/files/input_text.h"
#include "pipeline/formats/inflate.h"
#include "pipeline/formats/meshes/refuse.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <map>
#include <sstream>
#include <vector>
#include <vtkByteSwap.h>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkPointData.h>

namespace palp
{
namespace
{

using Fields = std::map<std::string, std::string>;

std::string trimmed(std::string_view text)
{
  const auto first = text.find_first_not_of(" \t\r");
  return first == text.npos
    ? std::string()
    : std::string(text.substr(first, text.find_last_not_of(" \t\r") - first + 1));
}

// "key = value" with or without blanks, to the line that names the data; end: of that line
Fields readFields(const std::filesystem::path& file, std::uintmax_t& end)
{
  constexpr std::size_t most = 1 << 16; // [bytes], of a header
  std::string text(most, '\0');
  std::ifstream in(file, std::ios::binary);
  in.read(text.data(), most);
  text.resize(static_cast<std::size_t>(in.gcount()));
  Fields fields;
  for (std::size_t begin = 0; begin < text.size();)
  {
    const std::size_t stop = text.find('\n', begin);
    const std::string_view line = std::string_view(text).substr(begin, stop - begin);
    const std::size_t equals = line.find_first_of("=:");
    if (stop == text.npos || equals == line.npos)
    {
      break;
    }
    const std::string key = trimmed(line.substr(0, equals));
    fields[key] = trimmed(line.substr(equals + 1));
    begin = stop + 1;
    if (key == "ElementDataFile")
    {
      end = begin;
      return fields;
    }
  }
  refuse(file,
    fields.contains("NDims") || fields.contains("ObjectType")
      ? "cut off, its header names no ElementDataFile; export or copy it again"
      : "not a MetaImage file, whatever its name; rename or convert it");
}

std::vector<double> numbers(
  const std::filesystem::path& file, const Fields& fields, const std::string& key)
{
  std::vector<double> values;
  const auto field = fields.find(key);
  std::istringstream words(field == fields.end() ? "" : field->second);
  for (std::string word; words >> word;)
  {
    double value = 0.0;
    const auto [end, failure] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (failure != std::errc{} || end != word.data() + word.size() || !std::isfinite(value))
    {
      refuse(file, key + " is " + inQuotes(field->second) + ", not numbers; export it again");
    }
    values.push_back(value);
  }
  return values;
}

// the first of these keys that is there, three numbers; none: as they are
void read3(const std::filesystem::path& file, const Fields& fields,
  std::initializer_list<const char*> keys, std::array<double, 3>& values)
{
  for (const char* key : keys)
  {
    const std::vector<double> found = numbers(file, fields, key);
    if (!found.empty() && found.size() != 3)
    {
      refuse(file, std::string(key) + " has not three numbers; export it again");
    }
    if (!found.empty())
    {
      std::copy_n(found.begin(), 3, values.begin());
      return;
    }
  }
}

void checkStraight(const std::filesystem::path& file, const Fields& fields)
{
  for (const char* key : { "TransformMatrix", "Rotation", "Orientation" })
  {
    const std::vector<double> turn = numbers(file, fields, key);
    constexpr double rounding = 1e-6;
    bool straight = turn.empty() || turn.size() == 9;
    for (std::size_t i = 0; straight && i < turn.size(); ++i)
    {
      straight = std::abs(turn[i] - (i % 4 == 0 ? 1.0 : 0.0)) <= rounding; // 3 x 3, row by row
    }
    if (!straight)
    {
      refuse(file, "its axes are turned, which is read from NIfTI only; save it as .nii.gz");
    }
  }
}

bool isTrue(const Fields& fields, const char* key)
{
  const auto field = fields.find(key);
  return field != fields.end() && (field->second.starts_with('T') || field->second == "1");
}

int typeOf(const std::filesystem::path& file, const Fields& fields)
{
  static const std::map<std::string, int> kTypes{ { "MET_CHAR", VTK_SIGNED_CHAR },
    { "MET_UCHAR", VTK_UNSIGNED_CHAR }, { "MET_SHORT", VTK_SHORT },
    { "MET_USHORT", VTK_UNSIGNED_SHORT }, { "MET_INT", VTK_INT }, { "MET_UINT", VTK_UNSIGNED_INT },
    { "MET_LONG", VTK_INT }, { "MET_ULONG", VTK_UNSIGNED_INT }, { "MET_LONG_LONG", VTK_LONG_LONG },
    { "MET_ULONG_LONG", VTK_UNSIGNED_LONG_LONG }, { "MET_FLOAT", VTK_FLOAT },
    { "MET_DOUBLE", VTK_DOUBLE } };
  const auto field = fields.find("ElementType");
  const auto type = field == fields.end() ? kTypes.end() : kTypes.find(field->second);
  if (type == kTypes.end())
  {
    refuse(file,
      "its ElementType is " +
        (field == fields.end() ? std::string("missing") : inQuotes(field->second)) +
        "; give an image of one number at each voxel");
  }
  return type->second;
}

// where the data are, for LOCAL or the name of a file beside
void findData(const std::filesystem::path& file, const Fields& fields, std::uintmax_t headerEnd,
  MetaHeader& header)
{
  const std::string& name = fields.at("ElementDataFile");
  const std::filesystem::path beside = name;
  const bool local = name == "LOCAL" || name == "Local" || name == "local";
  if (!local && (name.empty() || name == "LIST" || name.find('%') != name.npos))
  {
    refuse(file, "its slices are files of their own; save it as one .mha or .nii.gz");
  }
  if (!local && beside.has_parent_path())
  {
    refuse(file, "its data are not beside it; put both into one folder");
  }
  header.dataFile = local ? file : file.parent_path() / beside;
  std::error_code failure;
  const std::uintmax_t there = std::filesystem::file_size(header.dataFile, failure);
  if (failure)
  {
    refuse(file, "its data, " + inQuotes(name) + ", are not beside it; copy both");
  }
  header.begin = local ? headerEnd : 0;
  const std::vector<double> skip = numbers(file, fields, "HeaderSize");
  if (!skip.empty() && skip[0] == -1.0 && !header.compressed && there >= header.bytes)
  {
    header.begin = there - header.bytes; // at the end of their file
  }
  else if (!skip.empty() && skip[0] > 0.0 && !local)
  {
    header.begin = static_cast<std::uintmax_t>(std::min(skip[0], 1e15));
  }
}

void readWords(vtkDataArray& voxels, std::ifstream& in, const std::filesystem::path& file)
{
  vtkIdType count = 0;
  for (std::string word; count < voxels.GetNumberOfTuples() && in >> word; ++count)
  {
    double value = 0.0;
    const auto [end, failure] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (failure != std::errc{} || end != word.data() + word.size())
    {
      refuse(file, inQuotes(word) + " stands among its numbers; export it again");
    }
    voxels.SetComponent(count, 0, value);
  }
  if (count < voxels.GetNumberOfTuples())
  {
    refuse(file,
      "cut off, it holds " + std::to_string(count) + " of " +
        std::to_string(voxels.GetNumberOfTuples()) + " voxels; export or copy it again");
  }
}

} // namespace

MetaHeader readMetaHeader(const std::filesystem::path& file)
{
  std::uintmax_t end = 0;
  const Fields fields = readFields(file, end);
  const std::vector<double> size = numbers(file, fields, "DimSize");
  const std::vector<double> dimensions = numbers(file, fields, "NDims");
  if (dimensions != std::vector{ 3.0 } || size.size() != 3)
  {
    refuse(file, "not a volume of three dimensions; save one volume");
  }
  const std::vector<double> channels = numbers(file, fields, "ElementNumberOfChannels");
  if (!channels.empty() && channels[0] != 1.0)
  {
    refuse(file, "several values at each voxel; give an image of one");
  }
  MetaHeader header;
  header.type = typeOf(file, fields);
  header.bytes = static_cast<std::uintmax_t>(vtkDataArray::GetDataTypeSize(header.type));
  for (std::size_t i = 0; i < 3; ++i)
  {
    constexpr double most = 1e5;
    if (!(size[i] >= 1.0 && size[i] <= most && size[i] == std::floor(size[i])))
    {
      refuse(file, "its DimSize is no size of a volume; export it again");
    }
    header.size[i] = static_cast<int>(size[i]);
    header.bytes *= static_cast<std::uintmax_t>(size[i]);
  }
  checkStraight(file, fields);
  read3(file, fields, { "ElementSpacing", "ElementSize" }, header.spacing);
  read3(file, fields, { "Offset", "Position", "Origin" }, header.origin);
  if (std::ranges::any_of(header.spacing, [](double side) { return !(side > 0.0); }))
  {
    refuse(file, "its ElementSpacing is not positive; export it again");
  }
  if (const auto unit = fields.find("DistanceUnits");
      unit != fields.end() && (unit->second == "um" || unit->second == "cm"))
  {
    header.unit = unit->second;
  }
  header.text = fields.contains("BinaryData") && !isTrue(fields, "BinaryData");
  header.bigEndian =
    isTrue(fields, "BinaryDataByteOrderMSB") || isTrue(fields, "ElementByteOrderMSB");
  header.compressed = isTrue(fields, "CompressedData");
  const std::vector<double> packed = numbers(file, fields, "CompressedDataSize");
  header.compressedSize =
    packed.empty() ? 0 : static_cast<std::uintmax_t>(std::clamp(packed[0], 0.0, 1e15));
  findData(file, fields, end, header);
  return header;
}

vtkSmartPointer<vtkImageData> readMetaVolume(
  const std::filesystem::path& file, const MetaHeader& header)
{
  std::error_code failure;
  const std::uintmax_t all = std::filesystem::file_size(header.dataFile, failure);
  const std::uintmax_t there = all > header.begin ? all - header.begin : 0;
  const auto voxel = static_cast<std::uintmax_t>(vtkDataArray::GetDataTypeSize(header.type));
  const std::uintmax_t needed = header.compressed
    ? std::max(header.compressedSize, header.bytes / kDeflateRatio)
    : header.text ? 2 * (header.bytes / voxel) - 1 // a digit and a blank
                  : header.bytes;
  if (failure || there < needed)
  {
    refuseCut(file, there, needed);
  }
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(header.size.data());
  image->SetSpacing(header.spacing.data());
  image->SetOrigin(header.origin.data());
  image->AllocateScalars(header.type, 1);
  vtkDataArray& voxels = *image->GetPointData()->GetScalars();
  std::ifstream in(header.dataFile, std::ios::binary);
  in.seekg(static_cast<std::streamoff>(header.begin));
  auto* bytes = static_cast<unsigned char*>(voxels.GetVoidPointer(0));
  if (header.text)
  {
    readWords(voxels, in, file);
    return image;
  }
  if (header.compressed)
  {
    inflateInto({ bytes, static_cast<std::size_t>(header.bytes) }, in,
      header.compressedSize > 0 ? header.compressedSize : there, file);
  }
  else if (!in.read(reinterpret_cast<char*>(bytes), static_cast<std::streamsize>(header.bytes)))
  {
    refuseCut(file, static_cast<std::uintmax_t>(in.gcount()), header.bytes);
  }
  if (header.bigEndian)
  {
    vtkByteSwap::SwapVoidRange(bytes, static_cast<std::size_t>(voxels.GetNumberOfTuples()),
      static_cast<std::size_t>(voxels.GetDataTypeSize()));
  }
  return image;
}

} // namespace palp
