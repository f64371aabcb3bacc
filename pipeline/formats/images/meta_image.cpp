#include "pipeline/formats/images/meta_image.h"

#include "haptics/files/input_text.h"
#include "pipeline/formats/images/inflate.h"
#include "pipeline/formats/images/meta_fields.h"
#include "pipeline/formats/meshes/refuse.h"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <map>
#include <string_view>
#include <vector>
#include <vtkByteSwap.h>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkPointData.h>

namespace palp
{
namespace
{

void readSpacing(const std::filesystem::path& file, const MetaFields& fields, MetaHeader& header)
{
  if (!readThree(file, fields, { "ElementSpacing", "ElementSize" }, header.spacing))
  {
    refuse(file, "its header has no ElementSpacing, the size of a voxel; write it there");
  }
  for (std::size_t k = 0; k < 3; ++k)
  {
    if (!(std::abs(header.spacing[k]) > 0.0))
    {
      refuse(file, "a side of its ElementSpacing is no length; export it again");
    }
    if (header.spacing[k] < 0.0) // against its direction, as ITK takes it
    {
      header.spacing[k] = -header.spacing[k];
      Eigen::Map<Eigen::Matrix3d>(header.axes.data()).col(static_cast<Eigen::Index>(k)) *= -1.0;
    }
  }
  const auto unit = fields.find("DistanceUnits");
  const std::string name = unit == fields.end() ? "" : unit->second;
  const bool isNone = name.empty() || name == "?"; // as MetaIO writes it where it knows none
  if (!isNone && name != "um" && name != "mm" && name != "cm")
  {
    refuse(file,
      "its DistanceUnits is " + inQuotes(name) + ", none of MetaImage's; write um, mm or cm there");
  }
  // ITK and 3D Slicer write none in the patient's axes
  const bool isPatient = fields.contains("AnatomicalOrientation");
  header.unit = !isNone ? name : isPatient ? "mm" : "";
}

// what is stored times the slope, plus the offset
void readScale(const std::filesystem::path& file, const MetaFields& fields, MetaHeader& header)
{
  const auto read = [&](const std::string& key, double& value)
  {
    const std::vector<double> found = numbersOf(file, fields, key);
    if (found.size() > 1)
    {
      refuse(file, key + " is more than one number; export it again");
    }
    value = found.empty() ? value : found[0];
  };
  read("ElementToIntensityFunctionSlope", header.slope);
  read("ElementToIntensityFunctionOffset", header.intercept);
  if (header.slope == 0.0)
  {
    refuse(
      file, "ElementToIntensityFunctionSlope is 0, which makes all values alike; export it again");
  }
}

void readAxes(const std::filesystem::path& file, const MetaFields& fields, MetaHeader& header)
{
  Eigen::Map<Eigen::Matrix3d> axes(header.axes.data());
  axes.setIdentity();
  for (const char* key : { "TransformMatrix", "Rotation", "Orientation" })
  {
    const std::vector<double> turn = numbersOf(file, fields, key);
    if (turn.empty())
    {
      continue;
    }
    constexpr double kRounding = 1e-3;
    constexpr double kFlat = 0.01;
    if (turn.size() == 9)
    {
      axes = Eigen::Map<const Eigen::Matrix3d>(turn.data());
    }
    const Eigen::Array3d lengths = axes.colwise().norm();
    if (turn.size() != 9 || !((lengths - 1.0).abs() < kRounding).all() ||
      std::abs(axes.determinant()) < kFlat)
    {
      refuse(file, std::string("its ") + key + " is not three directions; export it again");
    }
  }
}

// Letters tell from where each axis comes, or, as some write them, to where it goes. ITK, and with
// it 3D Slicer, takes the matrix alone: ITK's issue 1017.
std::string contradictionOf(const MetaFields& fields, const MetaHeader& header)
{
  const auto field = fields.find("AnatomicalOrientation");
  const std::string letters = field == fields.end() ? "" : field->second;
  bool isFrom = true;
  bool isTo = true;
  for (std::size_t k = 0; k < letters.size(); ++k)
  {
    constexpr std::string_view kTo = "RLAPIS"; // of pairs: less along x, more, along y, z
    const std::size_t letter = kTo.find(letters[k]);
    if (letters.size() != 3 || letter == kTo.npos)
    {
      return {}; // as ??? where the program knew none
    }
    constexpr double kAlong = 0.4; // of an oblique axis
    const double along = (letter % 2 == 0 ? -1.0 : 1.0) * header.axes[3 * k + letter / 2];
    isTo = isTo && along > kAlong;
    isFrom = isFrom && along < -kAlong;
  }
  return isFrom || isTo ? std::string()
                        : "its AnatomicalOrientation, " + letters +
      ", contradicts its TransformMatrix; the matrix is taken, as 3D Slicer does";
}

int typeOf(const std::filesystem::path& file, const MetaFields& fields)
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
void findData(const std::filesystem::path& file, const MetaFields& fields, std::uintmax_t headerEnd,
  MetaHeader& header)
{
  const std::string& name = fields.at("ElementDataFile");
  const auto beside = std::filesystem::path(name).lexically_normal(); // of ./DATA
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
  if (!std::ifstream(header.dataFile))
  {
    refuse(file,
      "its data, " + inQuotes(name) +
        ", cannot be opened; check their permissions, and copy what a link leads to");
  }
  header.begin = local ? headerEnd : 0;
  const std::vector<double> skip = numbersOf(file, fields, "HeaderSize");
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
  if (std::string word; in >> word)
  {
    refuse(file,
      "it holds more than the " + std::to_string(count) +
        " voxels that its header claims; mend its DimSize, or export it again");
  }
}

} // namespace

MetaHeader readMetaHeader(const std::filesystem::path& file)
{
  std::uintmax_t end = 0;
  const MetaFields fields = readMetaFields(file, end);
  const std::vector<double> size = numbersOf(file, fields, "DimSize");
  const std::vector<double> dimensions = numbersOf(file, fields, "NDims");
  if (dimensions != std::vector{ 3.0 } || size.size() != 3)
  {
    refuse(file, "not a volume of three dimensions; save one volume");
  }
  const std::vector<double> channels = numbersOf(file, fields, "ElementNumberOfChannels");
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
  readAxes(file, fields, header);
  header.contradiction = contradictionOf(fields, header);
  readSpacing(file, fields, header);
  readScale(file, fields, header);
  readThree(file, fields, { "Offset", "Position", "Origin" }, header.origin);
  header.text = fields.contains("BinaryData") && !isTrue(fields, "BinaryData");
  header.bigEndian =
    isTrue(fields, "BinaryDataByteOrderMSB") || isTrue(fields, "ElementByteOrderMSB");
  header.compressed = isTrue(fields, "CompressedData");
  const std::vector<double> packed = numbersOf(file, fields, "CompressedDataSize");
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
  const std::uintmax_t claimed = header.compressed ? header.compressedSize : header.bytes;
  if (!header.text && claimed > 0 && there > claimed)
  {
    refuseMore(file, there, claimed,
      header.compressed
        ? "mend its CompressedDataSize"
        : "mend its DimSize or ElementType, or name what stands before the voxels in HeaderSize");
  }
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(header.size.data());
  image->SetSpacing(header.spacing.data());
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
