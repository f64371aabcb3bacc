#include "pipeline/formats/regions/image_body.h"

#include "haptics/error.h"
#include "haptics/files/input_text.h"
#include "haptics/surface/area_and_volume.h"
#include "pipeline/formats/regions/contour_pieces.h"
#include "pipeline/formats/regions/image_contour.h"
#include "pipeline/formats/regions/image_grids.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <sstream>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkPointData.h>

namespace palp
{
namespace
{

using Form = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;

// axes that lie in a plane, or are not numbers, would make a flat body
void checkPosition(const PatientImage& volume, const std::string& name)
{
  using Eigen::Vector3d;
  const Form form(volume.toPatient);
  const Vector3d spacing(volume.image->GetSpacing());
  const Eigen::Matrix3d axes = form.topLeftCorner<3, 3>() * spacing.asDiagonal();
  constexpr double kFlattest = 1e-6; // of a box with such edges
  if (!(std::abs(axes.determinant()) > kFlattest * axes.colwise().norm().prod()))
  {
    refuseImage(name, "the axes in its header do not span space; export it again");
  }
  if (!form.allFinite() || !Vector3d(volume.image->GetOrigin()).allFinite())
  {
    refuseImage(name, "the origin in its header is not a number; export it again");
  }
  constexpr double kFarthest = 1e6; // voxels: single precision tells one from the next
  const double off = std::max(form.topRightCorner<3, 1>().lpNorm<Eigen::Infinity>(),
    Vector3d(volume.image->GetOrigin()).lpNorm<Eigen::Infinity>());
  if (off > kFarthest * axes.colwise().norm().minCoeff())
  {
    refuseImage(name,
      "the origin in its header is " + inWords(off) +
        " away, where one voxel is not told from the next; export it again");
  }
}

// of a mask, what is known of its surface
void noteVoxels(const PatientImage& volume, std::vector<std::string>& notes)
{
  constexpr double kThick = 2.0; // of the shortest side
  const Eigen::Array3d spacing = Eigen::Array3d(volume.image->GetSpacing()).abs();
  notes.emplace_back(
    "of a mask the surface is known to half a voxel, and how it curves to what moves "
    "the force of the corrected law by up to 10 % at a depth of one voxel, less deeper");
  if (spacing.maxCoeff() > kThick * spacing.minCoeff())
  {
    notes.push_back("warning: its voxels are " + inWords(spacing.maxCoeff() / spacing.minCoeff()) +
      " times as long as they are wide; between them the surface is a guess: take thinner slices "
      "where force matters");
  }
}

constexpr const char* kCutByBorder =
  "warning: it reaches the border of the image, and is closed there by a flat face that no organ "
  "has";

// about the middles of all voxels, in an image's own axes
Eigen::AlignedBox3d fieldBox(vtkImageData& image)
{
  std::array<double, 6> bounds{};
  image.GetBounds(bounds.data());
  return { Eigen::Vector3d(bounds[0], bounds[2], bounds[4]),
    Eigen::Vector3d(bounds[1], bounds[3], bounds[5]) };
}

void toPatient(const PatientImage& volume, std::vector<Eigen::Vector3d>& points)
{
  const Form form(volume.toPatient);
  for (Eigen::Vector3d& point : points)
  {
    point = form.topLeftCorner<3, 3>() * point + form.topRightCorner<3, 1>();
  }
}

// of a voxel [unit]
Eigen::Array3d sidesOf(const PatientImage& volume)
{
  const Eigen::Vector3d spacing(volume.image->GetSpacing());
  return (Form(volume.toPatient).topLeftCorner<3, 3>() * spacing.asDiagonal())
    .colwise()
    .norm()
    .transpose();
}

// in the patient's axes, facing outward also in a mirror and of a body below its level
FileSurface placed(const PatientImage& volume, ImageContour& contour)
{
  toPatient(volume, contour.points);
  if (enclosedVolume(contour.points, contour.triangles) < 0.0)
  {
    for (Triangle& triangle : contour.triangles)
    {
      std::swap(triangle[0], triangle[2]);
    }
  }
  return { .points = std::move(contour.points),
    .triangles = std::move(contour.triangles),
    .unit = volume.unit,
    .notes = {},
    .space = volume.space,
    .field = fieldOf(volume) };
}

} // namespace

Eigen::AlignedBox3d boxInPatient(const PatientImage& volume, const VoxelBox& box)
{
  using Eigen::Array3d;
  const int* extent = volume.image->GetExtent(); // whose first voxel may be any
  const Array3d first(extent[0], extent[2], extent[4]);
  const auto placeOf = [&](const std::array<int, 3>& voxel, double beyond)
  {
    const Array3d index = first + Eigen::Array3i(voxel.data()).cast<double>() + beyond;
    return (Array3d(volume.image->GetOrigin()) + Array3d(volume.image->GetSpacing()) * index)
      .eval();
  };
  const Array3d low = placeOf(box.low, -0.5);
  const Array3d high = placeOf(box.high, 0.5);
  std::vector<Eigen::Vector3d> corners;
  for (int corner = 0; corner < 8; ++corner)
  {
    const Eigen::Array3i isHigh(corner & 1, corner >> 1 & 1, corner >> 2);
    corners.emplace_back((isHigh == 1).select(high, low));
  }
  toPatient(volume, corners);
  return boxAbout(corners);
}

double fieldOf(const PatientImage& volume)
{
  const Eigen::Array3i size(volume.image->GetDimensions());
  return (sidesOf(volume) * size.cast<double>()).maxCoeff();
}

std::string inWords(double value)
{
  std::ostringstream text;
  text << value;
  return text.str();
}

void refuseImage(const std::string& name, const std::string& what, ErrorCode code)
{
  throw Error(code, name + ": " + what);
}

void checkVolume(const PatientImage& volume, const std::string& name)
{
  const int* size = volume.image->GetDimensions();
  vtkDataArray* voxels = volume.image->GetPointData()->GetScalars();
  if (std::min({ size[0], size[1], size[2] }) < 2)
  {
    refuseImage(name, "no volume in it; give an image of two slices or more");
  }
  if (!voxels)
  {
    refuseImage(name, "no values at its voxels; export it again");
  }
  if (voxels->GetNumberOfComponents() != 1 && volume.segments.empty())
  {
    refuseImage(name, "several values at each voxel; give an image of one");
  }
  checkPosition(volume, name);
}

void checkNumbers(const ImageValues& values, const std::string& name)
{
  if (values.notFinite > 0)
  {
    const auto& [x, y, z] = values.firstOf;
    refuseImage(name,
      "voxels that are no numbers (NaN or infinite): " + std::to_string(values.notFinite) +
        ", the first at " + std::to_string(x) + ", " + std::to_string(y) + ", " +
        std::to_string(z) + " counted from 0; give them the value of what lies around the body");
  }
}

ImageRegion regionOfLabels(const PatientImage& volume, std::span<const Label> labels)
{
  ImageRegion region{ .image = maskOfLabels(volume, labels) };
  noteVoxels(volume, region.notes);
  return region;
}

ImageRegion regionOfBand(
  const PatientImage& volume, const std::array<double, 2>& band, const std::string& name)
{
  const auto isWithin = [&](double stored)
  {
    const double value = volume.slope * stored + volume.intercept;
    return value >= band[0] && value <= band[1];
  };
  const int type = volume.image->GetScalarType();
  if (type == VTK_FLOAT || type == VTK_DOUBLE) // of which one that is no number would be a hollow
  {
    checkNumbers(valuesOf(*volume.image), name);
  }
  const VoxelBox box = boxWhere(*volume.image, isWithin);
  if (box.empty())
  {
    const ImageValues values = valuesOf(*volume.image);
    refuseImage(name,
      "no voxel has a value from " + inWords(band[0]) + " to " + inWords(band[1]) +
        "; its values are stored from " + inWords(values.low) + " to " + inWords(values.high));
  }
  ImageRegion region{ .image = maskAbout(*volume.image, box) };
  mark(*region.image, *volume.image, box, isWithin);
  noteVoxels(volume, region.notes);
  return region;
}

ImageRegion regionOfLevel(
  const PatientImage& volume, double asked, const ImageValues& values, const std::string& name)
{
  const auto scaled = [&](double stored) { return volume.slope * stored + volume.intercept; };
  const double low = std::min(scaled(values.low), scaled(values.high));
  const double high = std::max(scaled(values.low), scaled(values.high));
  checkNumbers(values, name);
  if (!(asked > low && asked < high))
  {
    refuseImage(name,
      "no surface at level " + inWords(asked) + "; its values go from " + inWords(low) + " to " +
        inWords(high));
  }
  ImageRegion region{ .image = volume.image,
    .level = (asked - volume.intercept) / volume.slope,
    .mask = values.distinct.size() == 2,
    .below = volume.slope < 0.0 };
  if (region.mask)
  {
    const double middle = 0.5 * (values.low + values.high);
    if (std::abs(region.level - middle) > 1e-6 * (values.high - values.low))
    {
      region.notes.push_back("a mask of " + inWords(scaled(values.distinct[0])) + ", " +
        inWords(scaled(values.distinct[1])) + "; its surface is taken at " +
        inWords(scaled(middle)) + ", their middle");
    }
    region.level = middle;
    noteVoxels(volume, region.notes);
  }
  // what is above the level is the body, or what is around it; the border is the same all around
  region.image = closedAtBorder(*volume.image, region.level, values.low);
  return region;
}

FileOrgan bodyOf(
  const PatientImage& volume, ImageRegion region, std::size_t components, const std::string& name)
{
  FileOrgan organ;
  const bool isAround = isAboveAround(*region.image, region.level);
  const vtkIdType above = voxelsAbove(*region.image, region.level);
  const vtkIdType voxels = isAround ? region.image->GetNumberOfPoints() - above : above;
  if (region.mask && voxels < kFewestVoxels)
  {
    refuseImage(name,
      "what is chosen has " + counted(static_cast<std::size_t>(voxels), "voxel") +
        ", too few for a surface; take finer voxels");
  }
  constexpr std::uintmax_t most = 10'000'000;
  if (const std::uintmax_t triangles = 2 * crossings(*region.image, region.level); triangles > most)
  {
    refuseImage(name,
      "its surface would have " + std::to_string(triangles / 1'000'000) +
        (region.mask ? " million triangles, for its voxels lie scattered; give one of whole bodies"
                     : " million triangles, noise at that level; smooth the image, or take fewer "
                       "voxels"));
  }
  const Eigen::AlignedBox3d field = fieldBox(*volume.image);
  ImageContour contour =
    imageContour(*region.image, region.level, region.mask, field, components, region.notes);
  if (const double voxel = Eigen::Array3d(region.image->GetSpacing()).abs().prod();
      region.mask && contour.largest < leastPiece(voxel))
  {
    refuseImage(name,
      "what hangs together of it has less than eight voxels, too few for a surface; give a label "
      "of whole bodies");
  }
  if (isAround != region.below)
  {
    region.notes.emplace_back(
      "warning: the body is what is below the level, as a distance is; what "
      "is above it reaches the border of the image all around");
  }
  if (!field.contains(boxAbout(contour.from)))
  {
    region.notes.emplace_back(kCutByBorder);
  }
  const double grown = std::abs(Form(volume.toPatient).topLeftCorner<3, 3>().determinant());
  organ.voxels = static_cast<std::uint64_t>(voxels);
  organ.voxelVolume = static_cast<double>(voxels) * voxelVolume(volume);
  organ.enclosed = grown * std::abs(contour.enclosed);
  organ.voxel = sidesOf(volume).maxCoeff();
  toPatient(volume, contour.from);
  organ.from = std::move(contour.from);
  organ.surface = placed(volume, contour);
  organ.surface.notes = std::move(region.notes);
  const Eigen::AlignedBox3d box = boxAbout(organ.surface.points);
  organ.corners = { box.min(), box.max() };
  return organ;
}

} // namespace palp
