#include "pipeline/formats/dicom/dicom_image.h"

#include "pipeline/formats/dicom/dicom_series.h"
#include "pipeline/formats/dicom/dicom_values.h"
#include "pipeline/formats/images/inflate.h"
#include "pipeline/formats/meshes/refuse.h"
#include "pipeline/process/child_process.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <gdcmImageReader.h>
#include <span>
#include <vector>
#include <vtkImageData.h>

namespace palp
{
namespace
{

// what the bits of a voxel mean: those beyond the stored ones may be of an overlay
template <typename Stored>
void convert(std::span<const char> bytes, const gdcm::PixelFormat& format, const DicomSlice& slice,
  std::span<float> values)
{
  const int shift = static_cast<int>(8 * sizeof(Stored)) - format.GetBitsStored();
  const int low = format.GetHighBit() + 1 - format.GetBitsStored();
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    Stored stored{};
    std::copy_n(bytes.data() + i * sizeof stored, sizeof stored, reinterpret_cast<char*>(&stored));
    using Bits = std::make_unsigned_t<Stored>;
    const auto top = static_cast<Bits>(static_cast<Bits>(stored) << (shift - low));
    const auto value = static_cast<Stored>(static_cast<Stored>(top) >> shift); // keeps the sign
    values[i] = static_cast<float>(slice.slope * static_cast<double>(value) + slice.intercept);
  }
}

// before there is room for what the headers claim
void checkLength(const std::filesystem::path& folder, const DicomSeries& series)
{
  std::uintmax_t there = 0;
  std::uintmax_t claimed = 0;
  for (const DicomSlice& slice : series.slices)
  {
    there += std::filesystem::file_size(slice.file);
    claimed += static_cast<std::uintmax_t>(slice.columns) * static_cast<std::uintmax_t>(slice.rows);
  }
  if (claimed == 0 || claimed / kDeflateRatio > there)
  {
    refuse(folder, "its images are cut off, or their sizes damaged; export or copy them again");
  }
}

// voxels that are not compressed, to the byte that makes their length even; GDCM fills them up
void checkLength(const DicomSlice& slice, const gdcm::Image& image, std::size_t needed)
{
  const gdcm::ByteValue* stored = image.GetDataElement().GetByteValue();
  const std::size_t there = stored ? static_cast<std::size_t>(stored->GetLength()) : needed;
  if (there != needed + needed % 2)
  {
    refuse(slice.file,
      "its Pixel Data are " + std::to_string(there) + " bytes, its size asks for " +
        std::to_string(needed) + "; export it again");
  }
}

// GDCM fills up what a file was cut off of, and warns
void readVoxels(const DicomSlice& slice, std::span<float> values)
{
  listenToGdcm();
  gdcm::ImageReader reader;
  reader.SetFileName(slice.file.c_str());
  if (!reader.Read())
  {
    refuse(slice.file, "its voxels cannot be decoded, or are cut off; export or copy it again");
  }
  const gdcm::Image& image = reader.GetImage();
  const gdcm::PixelFormat& format = image.GetPixelFormat();
  std::vector<char> bytes(image.GetBufferLength());
  const std::size_t wide = format.GetBitsAllocated() / 8U;
  if (wide > 0 && format.GetSamplesPerPixel() == 1)
  {
    checkLength(slice, image, values.size() * wide);
  }
  const bool fits = bytes.size() == values.size() * wide && format.GetSamplesPerPixel() == 1;
  if (!fits || !image.GetBuffer(bytes.data()) || wasFilledUp())
  {
    refuse(slice.file, "its voxels cannot be decoded, or are cut off; export or copy it again");
  }
  if (isDamagedJpeg())
  {
    refuse(slice.file, "its JPEG data are damaged; export or copy it again");
  }
  switch (format.GetScalarType())
  {
    case gdcm::PixelFormat::UINT8:
      return convert<std::uint8_t>(bytes, format, slice, values);
    case gdcm::PixelFormat::INT8:
      return convert<std::int8_t>(bytes, format, slice, values);
    case gdcm::PixelFormat::UINT16:
      return convert<std::uint16_t>(bytes, format, slice, values);
    case gdcm::PixelFormat::INT16:
      return convert<std::int16_t>(bytes, format, slice, values);
    case gdcm::PixelFormat::UINT32:
      return convert<std::uint32_t>(bytes, format, slice, values);
    case gdcm::PixelFormat::INT32:
      return convert<std::int32_t>(bytes, format, slice, values);
    default:
      refuse(slice.file, "its voxels are of a type that is not read here; save it as .nrrd");
  }
}

} // namespace

PatientImage readDicom(const std::filesystem::path& folder, const std::string& asked)
{
  std::vector<std::string> notes;
  DicomSeries series = chosenSeries(folder, asked, notes);
  const Eigen::Vector3d step = stack(folder, series);
  checkLength(folder, series);
  const DicomSlice& first = series.slices.front();
  PatientImage result{ .image = vtkSmartPointer<vtkImageData>::New(), .toPatient = {} };
  const auto count = static_cast<int>(series.slices.size());
  result.image->SetDimensions(first.columns, first.rows, count);
  result.image->SetSpacing(first.columnSpacing, first.rowSpacing, step.norm());
  result.image->AllocateScalars(VTK_FLOAT, 1);
  const auto size = static_cast<std::size_t>(first.columns) * static_cast<std::size_t>(first.rows);
  auto* values = static_cast<float*>(result.image->GetScalarPointer());
  for (const DicomSlice& slice : series.slices)
  {
    blameForACrash(slice.file);
    readVoxels(slice, { values, size });
    values += size;
  }
  blameForACrash({});

  result.notes = std::move(notes);
  placeInPatient(result, { first.alongRow, first.alongColumn, step.normalized() }, first.position);
  result.notes.push_back("series \"" + series.description + "\" (" + series.modality + "), " +
    std::to_string(count) + " images");
  return result;
}

} // namespace palp
