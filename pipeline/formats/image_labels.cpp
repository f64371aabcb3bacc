#include "pipeline/formats/image_labels.h"

#include "haptics/error.h"
#include "haptics/files/csv_text.h"
#include "haptics/files/input_text.h"
#include "pipeline/formats/image_values.h"

#include <Eigen/Dense>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <sstream>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkPointData.h>

namespace palp
{
namespace
{

// one layer of an image, as an image of its own
vtkSmartPointer<vtkImageData> layerOf(vtkImageData& image, int layer)
{
  vtkDataArray& voxels = *image.GetPointData()->GetScalars();
  if (voxels.GetNumberOfComponents() == 1)
  {
    return &image;
  }
  auto one = vtkSmartPointer<vtkImageData>::New();
  one->CopyStructure(&image);
  one->AllocateScalars(voxels.GetDataType(), 1);
  one->GetPointData()->GetScalars()->CopyComponent(0, &voxels, layer);
  return one;
}

// a label, and what is known of it
struct Label
{
  Segment segment;
  double shown = 0.0; // its value, as the header scales it
  vtkIdType voxels = 0;
};

// all that have voxels
std::vector<Label> labelsOf(const PatientImage& volume)
{
  std::vector<Label> labels;
  const int layers = volume.image->GetNumberOfScalarComponents();
  for (int layer = 0; layer < layers; ++layer)
  {
    const ImageValues values = valuesOf(*layerOf(*volume.image, layer));
    const auto namedOf = [&](double value)
    {
      return std::ranges::find_if(volume.segments,
        [&](const Segment& one) { return one.layer == layer && one.value == value; });
    };
    for (std::size_t i = 0; i < values.distinct.size(); ++i)
    {
      const double value = values.distinct[i];
      const auto named = namedOf(value);
      labels.push_back({ .segment = named != volume.segments.end()
          ? *named
          : Segment{ .name = {}, .value = value, .layer = layer },
        .shown = volume.slope * value + volume.intercept,
        .voxels = values.often[i] });
    }
  }
  return labels;
}

// of a voxel, where the file tells its unit [ml]
std::optional<double> voxelVolume(const PatientImage& volume)
{
  const Eigen::Matrix<double, 4, 4, Eigen::RowMajor> form(volume.toPatient);
  const Eigen::Vector3d spacing(volume.image->GetSpacing());
  const std::string& unit = volume.unit;
  const double cm = unit == "um" ? 1e-4 : unit == "mm" ? 0.1 : unit == "cm" ? 1.0 : 100.0;
  return unit.empty() ? std::nullopt
                      : std::optional(std::pow(cm, 3) *
                          std::abs(form.topLeftCorner<3, 3>().determinant() * spacing.prod()));
}

std::string inWords(const std::vector<Label>& labels, const PatientImage& volume)
{
  const std::optional<double> voxel = voxelVolume(volume);
  std::ostringstream text;
  text.precision(3);
  for (const Label& label : labels)
  {
    if (label.segment.name.empty() && (label.shown == 0.0 || label.segment.layer > 0))
    {
      continue; // what lies around, and what no segment is
    }
    text << (text.tellp() > 0 ? ", " : "") << shortest(label.shown)
         << (label.segment.name.empty() ? "" : " " + printable(label.segment.name)) << " ("
         << label.voxels << (label.voxels == 1 ? " voxel" : " voxels");
    voxel ? text << ", " << *voxel * static_cast<double>(label.voxels) << " ml)" : text << ')';
  }
  return text.tellp() > 0 ? "its labels are " + text.str()
    : labels.empty()      ? "it has more values than a label map"
                          : "all its voxels are 0";
}

// a number names the value next to it that a voxel can have, to the rounding of the scale
bool isNamed(const Label& label, double step, const std::string& text)
{
  double value = 0.0;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool isNumber = failure == std::errc() && end == text.data() + text.size();
  constexpr double kRounding = 1e-15;
  return isNumber
    ? std::abs(label.shown - value) <= 1e-6 * std::abs(step) + kRounding * std::abs(value)
    : lowered(label.segment.name) == lowered(text);
}

} // namespace

std::string labelsInWords(const PatientImage& volume)
{
  return inWords(labelsOf(volume), volume);
}

vtkSmartPointer<vtkImageData> maskOfLabels(
  const PatientImage& volume, const std::vector<std::string>& labels, const std::string& name)
{
  const std::vector<Label> known = labelsOf(volume);
  constexpr double kWhole = 9'007'199'254'740'992.0; // beyond it doubles are not all whole numbers
  if (std::ranges::any_of(
        known, [](const Label& one) { return std::abs(one.segment.value) >= kWhole; }))
  {
    throw Error(ErrorCode::BadMesh,
      name + ": labels beyond 2^53, which are not told apart here; number them anew");
  }
  const int layers = volume.image->GetNumberOfScalarComponents();
  std::vector<std::vector<double>> chosen(static_cast<std::size_t>(layers)); // of each layer
  for (const std::string& label : labels)
  {
    const auto isMeant = [&](const Label& one) { return isNamed(one, volume.slope, label); };
    const auto found = std::ranges::find_if(known, isMeant);
    const auto count = std::ranges::count_if(known, isMeant);
    if (count != 1)
    {
      throw Error(ErrorCode::BadMesh,
        name + ": " + (count == 0 ? "no" : "more than one") + " label " + printable(label) +
          " in it; " + inWords(known, volume));
    }
    chosen[static_cast<std::size_t>(found->segment.layer)].push_back(found->segment.value);
  }
  auto mask = vtkSmartPointer<vtkImageData>::New();
  mask->CopyStructure(volume.image);
  mask->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
  auto* inside = static_cast<std::uint8_t*>(mask->GetScalarPointer());
  std::fill_n(inside, mask->GetNumberOfPoints(), std::uint8_t{ 0 });
  for (int layer = 0; layer < layers; ++layer)
  {
    if (const auto& values = chosen[static_cast<std::size_t>(layer)]; !values.empty())
    {
      const auto of = indicator(*layerOf(*volume.image, layer), values);
      std::ranges::transform(of, std::span(inside, of.size()), inside, std::bit_or());
    }
  }
  constexpr std::ptrdiff_t kFewest = 8;
  const std::span voxels(inside, static_cast<std::size_t>(mask->GetNumberOfPoints()));
  if (const auto count = std::ranges::count(voxels, 1); count < kFewest)
  {
    throw Error(ErrorCode::BadMesh,
      name + ": what is labeled so has " + counted(static_cast<std::size_t>(count), "voxel") +
        ", too few for a surface; take finer voxels");
  }
  return mask;
}

} // namespace palp
