#include "pipeline/formats/dicom/dicom_segments.h"

#include "haptics/files/input_text.h"
#include "pipeline/formats/dicom/dicom_elements.h"
#include "pipeline/formats/dicom/dicom_values.h"
#include "pipeline/formats/meshes/refuse.h"
#include "pipeline/process/child_process.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <span>
#include <vtkImageData.h>

namespace palp
{
namespace
{

using Eigen::Vector3d;
using gdcm::DataSet;
using gdcm::Tag;

constexpr double kSameUnit = 1e-3; // of unit vectors, which are written in decimals

// the mask of one segment in one slice
struct SegmentFrame
{
  int segment = 0;
  Vector3d position = Vector3d::Zero(); // of the first voxel's middle, LPS [mm]
  int slice = 0;
};

// what all frames have in common
struct SegmentGrid
{
  int columns = 0;
  int rows = 0;
  int slices = 0;
  Vector3d alongRow = Vector3d::Zero(); // unit vectors, LPS
  Vector3d alongColumn = Vector3d::Zero();
  Vector3d first = Vector3d::Zero(); // middle of the first voxel [mm]
  double columnSpacing = 0.0;        // [mm]
  double rowSpacing = 0.0;
  double step = 0.0;

  [[nodiscard]] std::size_t pixels() const
  {
    return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  }
};

// for all slices at once or for each, where all have the same
std::optional<std::vector<double>> orientationOf(
  const std::filesystem::path& file, const DataSet& data, const DataSet& shared)
{
  const auto within = [](const DataSet& groups)
  { return decimalsOf(groupOf(groups, Tag(0x0020, 0x9116)), Tag(0x0020, 0x0037), 6); };
  auto orientation = within(shared);
  for (const DataSet& groups : itemsOf(data, Tag(0x5200, 0x9230)))
  {
    const auto own = within(groups);
    orientation = orientation ? orientation : own;
    const auto isAlike = [](double a, double b) { return std::abs(a - b) < kSameUnit; };
    if (own && !std::ranges::equal(*own, *orientation, isAlike))
    {
      refuse(file, "its slices have several Image Orientations; save it as .seg.nrrd");
    }
  }
  return orientation;
}

void readGrid(const std::filesystem::path& file, const DataSet& data, SegmentGrid& grid)
{
  const DataSet shared = groupOf(data, Tag(0x5200, 0x9229));
  const auto orientation = orientationOf(file, data, shared);
  const DataSet measures = groupOf(shared, Tag(0x0028, 0x9110));
  const auto spacing = decimalsOf(measures, Tag(0x0028, 0x0030), 2);
  if (!orientation || !spacing || !(spacing->front() > 0.0) || !(spacing->back() > 0.0))
  {
    refuse(file,
      std::string("has no ") + (orientation ? "Pixel Spacing" : "Image Orientation (Patient)") +
        " for all of its slices; save it as .seg.nrrd");
  }
  grid.columns = countOf(data, Tag(0x0028, 0x0011));
  grid.rows = countOf(data, Tag(0x0028, 0x0010));
  grid.alongRow = Vector3d::Map(orientation->data());
  grid.alongColumn = Vector3d::Map(orientation->data() + 3);
  if (std::abs(grid.alongRow.norm() - 1.0) > kSameUnit ||
    std::abs(grid.alongColumn.norm() - 1.0) > kSameUnit ||
    std::abs(grid.alongRow.dot(grid.alongColumn)) > kSameUnit)
  {
    refuse(file, "its Image Orientation makes no image; export it again");
  }
  grid.columnSpacing = spacing->back();
  grid.rowSpacing = spacing->front();
  grid.step = decimalOf(measures, Tag(0x0018, 0x0088), 0.0);
}

std::vector<SegmentFrame> framesOf(const std::filesystem::path& file, const DataSet& data)
{
  std::vector<SegmentFrame> frames;
  for (const DataSet& groups : itemsOf(data, Tag(0x5200, 0x9230)))
  {
    const auto position = decimalsOf(groupOf(groups, Tag(0x0020, 0x9113)), Tag(0x0020, 0x0032), 3);
    const int segment = countOf(groupOf(groups, Tag(0x0062, 0x000a)), Tag(0x0062, 0x000b));
    if (!position || segment == 0)
    {
      refuse(file,
        "its slice " + std::to_string(frames.size() + 1) + " has no " +
          (position ? "segment" : "Image Position (Patient)") + "; export it again");
    }
    frames.push_back({ .segment = segment, .position = Vector3d::Map(position->data()) });
  }
  if (frames.empty() || decimalOf(data, kFrames, 0.0) != static_cast<double>(frames.size()))
  {
    refuse(file, "its slices are not as many as their places; export it again");
  }
  return frames;
}

void checkOnce(const std::filesystem::path& file, const std::vector<SegmentFrame>& frames)
{
  std::set<std::pair<int, int>> there;
  for (const SegmentFrame& frame : frames)
  {
    if (!there.emplace(frame.segment, frame.slice).second)
    {
      refuse(file,
        "two slices of its segment " + std::to_string(frame.segment) +
          " stand in one place; export it again");
    }
  }
}

// which slice each frame is; slices of no segment may be missing, also before the first and after
// the last, so that no segment is cut there
void stackFrames(
  const std::filesystem::path& file, SegmentGrid& grid, std::vector<SegmentFrame>& frames)
{
  const Vector3d normal = grid.alongRow.cross(grid.alongColumn);
  const auto height = [&](const SegmentFrame& frame) { return normal.dot(frame.position); };
  const SegmentFrame lowest = *std::ranges::min_element(frames, {}, height);
  if (!(grid.step > 0.0))
  {
    constexpr double kSame = 1e-3; // [mm]
    grid.step = std::numeric_limits<double>::infinity();
    std::vector<double> heights;
    std::ranges::transform(frames, std::back_inserter(heights), height);
    std::ranges::sort(heights);
    for (std::size_t i = 1; i < heights.size(); ++i)
    {
      const double step = heights[i] - heights[i - 1];
      grid.step = step > kSame ? std::min(grid.step, step) : grid.step;
    }
  }
  if (!std::isfinite(grid.step))
  {
    refuse(file, "one slice alone, no volume; give all of the segmentation");
  }
  grid.first = lowest.position;
  constexpr double kMost = 10'000.0; // slices
  constexpr double kOff = 0.1;       // of a step or a pixel
  for (SegmentFrame& frame : frames)
  {
    const Vector3d from = frame.position - grid.first;
    const double slice = normal.dot(from) / grid.step;
    const Vector3d aside = from - std::round(slice) * grid.step * normal;
    if (!(slice < kMost) ||
      !(aside.norm() < kOff * std::min({ grid.step, grid.columnSpacing, grid.rowSpacing })))
    {
      refuse(file,
        "its slices are no even, straight stack of one place; resample it, or save it as "
        ".seg.nrrd");
    }
    frame.slice = static_cast<int>(std::lround(slice)) + 1;
    grid.slices = std::max(grid.slices, frame.slice + 2);
  }
  grid.first -= grid.step * normal;
  checkOnce(file, frames);
}

// bits one after the other across all frames, the lowest of a byte first
class Bits
{
public:
  Bits(const std::filesystem::path& file, const DataSet& data, std::size_t count)
  {
    const Tag voxels(0x7fe0, 0x0010);
    const gdcm::ByteValue* bytes =
      data.FindDataElement(voxels) ? data.GetDataElement(voxels).GetByteValue() : nullptr;
    if (bytes == nullptr)
    {
      refuse(file, "its voxels are compressed or missing; save it uncompressed, or as .seg.nrrd");
    }
    constexpr std::size_t kBits = 8;
    const std::size_t needed = (count + kBits - 1) / kBits;
    bytes_ = { bytes->GetPointer(), bytes->GetLength() };
    if (bytes_.size() != needed + needed % 2)
    {
      refuse(file,
        "its Pixel Data are " + std::to_string(bytes_.size()) + " bytes, its size asks for " +
          std::to_string(needed) + "; export it again");
    }
  }

  [[nodiscard]] bool operator[](std::size_t i) const
  {
    return (static_cast<unsigned char>(bytes_[i / 8]) >> i % 8 & 1) != 0;
  }

private:
  std::span<const char> bytes_;
};

using Layer = std::vector<std::uint16_t>;

// the first layer in which no other segment has a voxel of this one; a new one where none is
int layerOf(int segment, const std::vector<SegmentFrame>& frames, const Bits& bits,
  std::size_t pixels, const SegmentGrid& grid, std::vector<Layer>& layers)
{
  const auto eachVoxel = [&](auto use)
  {
    bool goesOn = true;
    for (std::size_t k = 0; k < frames.size() && goesOn; ++k)
    {
      const std::size_t to = static_cast<std::size_t>(frames[k].slice) * pixels;
      for (std::size_t i = 0; i < pixels && goesOn && frames[k].segment == segment; ++i)
      {
        goesOn = !bits[k * pixels + i] || use(to + i);
      }
    }
    return goesOn;
  };
  std::size_t layer = 0;
  while (layer < layers.size() && !eachVoxel([&](std::size_t i) { return layers[layer][i] == 0; }))
  {
    ++layer;
  }
  if (layer == layers.size())
  {
    layers.emplace_back(pixels * static_cast<std::size_t>(grid.slices));
  }
  eachVoxel(
    [&](std::size_t i)
    {
      layers[layer][i] = static_cast<std::uint16_t>(segment);
      return true;
    });
  return static_cast<int>(layer);
}

// name and number of each, in layers
std::vector<Layer> layersOf(const std::filesystem::path& file, const DataSet& data,
  const SegmentGrid& grid, const std::vector<SegmentFrame>& frames, PatientImage& result)
{
  const Bits bits(file, data, grid.pixels() * frames.size());
  std::vector<Layer> layers;
  const std::string characterSet = textOf(data, kCharacterSet);
  std::set<int> numbers;
  for (const DataSet& item : itemsOf(data, Tag(0x0062, 0x0002)))
  {
    const int number = countOf(item, Tag(0x0062, 0x0004));
    if (!numbers.insert(number).second)
    {
      refuse(file,
        "two of its segments have the number " + std::to_string(number) + "; export it again");
    }
    const std::string own = textOf(item, kCharacterSet);
    const std::string name = textOf(item, Tag(0x0062, 0x0005), own.empty() ? characterSet : own);
    const auto isOf = [&](const SegmentFrame& frame) { return frame.segment == number; };
    const bool isThere = std::ranges::any_of(frames, isOf);
    result.segments.push_back({ .name = name.empty() ? "segment " + std::to_string(number) : name,
      .value = static_cast<double>(number),
      .layer = isThere ? layerOf(number, frames, bits, grid.pixels(), grid, layers) : 0 });
  }
  const auto unlisted = std::ranges::find_if(
    frames, [&](const SegmentFrame& frame) { return !numbers.contains(frame.segment); });
  if (unlisted != frames.end())
  {
    refuse(file,
      "a slice of it is of segment " + std::to_string(unlisted->segment) +
        ", which it does not list; export it again");
  }
  return layers;
}

void checkKind(const std::filesystem::path& file, const DataSet& data)
{
  if (textOf(data, Tag(0x0008, 0x0016)) != kSegmentationClass)
  {
    const bool isImage = data.FindDataElement(Tag(0x0028, 0x0010));
    refuse(file,
      !isImage ? "no image, by its Modality " + inQuotes(textOf(data, Tag(0x0008, 0x0060))) +
          "; of contours, save the labels that they enclose"
        : decimalOf(data, kFrames, 1.0) > 1.0
        ? "several images in one file, and no binary segmentation; save it as .nrrd"
        : "one image of a series; give the folder that holds all of them");
  }
  const std::string type = textOf(data, Tag(0x0062, 0x0001));
  if (countOf(data, Tag(0x0028, 0x0100)) != 1 || type != "BINARY")
  {
    refuse(file, "a segmentation that is " + inQuotes(type) + ", no BINARY; save it as .seg.nrrd");
  }
}

} // namespace

PatientImage readDicomSegments(const std::filesystem::path& file)
{
  if (!checkElements(file))
  {
    refuse(file, "no DICOM file, whatever its name; rename or convert it");
  }
  blameForACrash(file); // by an assertion of GDCM
  gdcm::Reader reader;
  if (!readWhole(reader, file))
  {
    refuse(file, "cut off or damaged; export or copy it again");
  }
  const DataSet& data = reader.GetFile().GetDataSet();
  checkKind(file, data);
  SegmentGrid grid;
  readGrid(file, data, grid);
  std::vector<SegmentFrame> frames = framesOf(file, data);
  stackFrames(file, grid, frames);
  PatientImage result{ .image = vtkSmartPointer<vtkImageData>::New(), .toPatient = {} };
  const std::vector<Layer> layers = layersOf(file, data, grid, frames, result);
  blameForACrash({});
  result.image->SetDimensions(grid.columns, grid.rows, grid.slices);
  result.image->SetSpacing(grid.columnSpacing, grid.rowSpacing, grid.step);
  result.image->AllocateScalars(VTK_UNSIGNED_SHORT, static_cast<int>(layers.size()));
  auto* voxels = static_cast<std::uint16_t*>(result.image->GetScalarPointer());
  for (std::size_t layer = 0; layer < layers.size(); ++layer)
  {
    for (std::size_t i = 0; i < layers[layer].size(); ++i)
    {
      voxels[i * layers.size() + layer] = layers[layer][i];
    }
  }
  placeInPatient(
    result, { grid.alongRow, grid.alongColumn, grid.alongRow.cross(grid.alongColumn) }, grid.first);
  return result;
}

} // namespace palp
