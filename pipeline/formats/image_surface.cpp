#include "pipeline/formats/image_surface.h"

#include "haptics/error.h"
#include "pipeline/formats/image_contour.h"
#include "pipeline/formats/image_labels.h"
#include "pipeline/formats/image_values.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <sstream>
#include <vector>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkImageData.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

namespace palp
{
namespace
{

std::string inWords(double value)
{
  std::ostringstream text;
  text << value;
  return text.str();
}

// the two of a mask
std::string listed(const ImageValues& values, const PatientImage& volume)
{
  return inWords(volume.slope * values.distinct[0] + volume.intercept) + ", " +
    inWords(volume.slope * values.distinct[1] + volume.intercept);
}

void flip(vtkPolyData& surface)
{
  surface.BuildCells();
  for (vtkIdType i = 0; i < surface.GetNumberOfCells(); ++i)
  {
    surface.ReverseCell(i);
  }
}

// the part as a level of what is stored, and the image that has it
struct Contour
{
  vtkSmartPointer<vtkImageData> image;
  double level;
  bool mask = false; // of two values
};

Contour contourOf(const PatientImage& volume, const ImagePart& part, const std::string& name,
  std::vector<std::string>& notes)
{
  const auto refuse = [&](const std::string& what)
  { throw Error(ErrorCode::BadMesh, name + ": " + what); };
  if (!part.labels.empty())
  {
    auto mask = maskOfLabels(volume, part.labels, name);
    if (mask->GetScalarRange()[0] > 0.5)
    {
      refuse("what is labeled so fills the whole image, so there is no surface; give an image "
             "that goes on around the body");
    }
    return { mask, 0.5, true };
  }
  const auto refuseLevel = [&]
  {
    refuse("a label map, whose values have no order (" + labelsInWords(volume) +
      "); give one as the label, or several with commas, not a level");
  };
  volume.segments.empty() ? void() : refuseLevel();
  const ImageValues values = valuesOf(*volume.image);
  values.labels ? refuseLevel() : void();
  const auto scaled = [&](double stored) { return volume.slope * stored + volume.intercept; };
  const double low = std::min(scaled(values.low), scaled(values.high));
  const double high = std::max(scaled(values.low), scaled(values.high));
  const std::string known = "its values go from " + inWords(low) + " to " + inWords(high);
  if (!part.level)
  {
    refuse("an image; name the value of the surface with a level, " + known);
  }
  if (values.notFinite > 0)
  {
    const auto& [x, y, z] = values.firstOf;
    refuse("voxels that are no numbers (NaN or infinite): " + std::to_string(values.notFinite) +
      ", the first at " + std::to_string(x) + ", " + std::to_string(y) + ", " + std::to_string(z) +
      " counted from 0; give them the value of what lies around the body");
  }
  if (!(*part.level > low && *part.level < high))
  {
    refuse("no surface at level " + inWords(*part.level) + "; " + known);
  }
  double level = (*part.level - volume.intercept) / volume.slope;
  if (values.distinct.size() == 2)
  {
    const double middle = 0.5 * (values.low + values.high);
    if (std::abs(level - middle) > 1e-6 * (values.high - values.low))
    {
      notes.push_back("a mask of " + listed(values, volume) + "; its surface is taken at " +
        inWords(scaled(middle)) + ", their middle");
    }
    level = middle;
  }
  return { volume.image, level, values.distinct.size() == 2 };
}

// axes that lie in a plane, or are not numbers, would make a flat body
void checkPosition(const PatientImage& volume, const std::string& name)
{
  using Eigen::Vector3d;
  const Eigen::Matrix<double, 4, 4, Eigen::RowMajor> form(volume.toPatient);
  const Vector3d spacing(volume.image->GetSpacing());
  const Eigen::Matrix3d axes = form.topLeftCorner<3, 3>() * spacing.asDiagonal();
  constexpr double kFlattest = 1e-6; // of a box with such edges
  if (!(std::abs(axes.determinant()) > kFlattest * axes.colwise().norm().prod()))
  {
    throw Error(
      ErrorCode::BadMesh, name + ": the axes in its header do not span space; export it again");
  }
  if (!form.allFinite() || !Vector3d(volume.image->GetOrigin()).allFinite())
  {
    throw Error(
      ErrorCode::BadMesh, name + ": the origin in its header is not a number; export it again");
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

// the corners of a triangle
std::array<Eigen::Vector3d, 3> cornersOf(vtkPolyData& surface, vtkIdType triangle)
{
  vtkNew<vtkIdList> corners;
  surface.GetCellPoints(triangle, corners);
  std::array<Eigen::Vector3d, 3> points;
  for (int k = 0; k < 3; ++k)
  {
    surface.GetPoint(corners->GetId(k), points[static_cast<std::size_t>(k)].data());
  }
  return points;
}

// Whether a surface without an open edge faces its own inside. Its area vectors add up to nothing
// then, and its volume is the same seen from wherever.
bool facesInward(vtkPolyData& surface)
{
  Eigen::Vector3d open = Eigen::Vector3d::Zero();
  double area = 0.0;
  double volume = 0.0;
  for (vtkIdType i = 0; i < surface.GetNumberOfCells(); ++i)
  {
    const auto [a, b, c] = cornersOf(surface, i);
    const Eigen::Vector3d twice = (b - a).cross(c - a);
    open += twice;
    area += twice.norm();
    volume += a.dot(b.cross(c));
  }
  constexpr double rounding = 1e-9;
  return open.norm() <= rounding * area && volume < 0.0;
}

} // namespace

vtkSmartPointer<vtkPolyData> imageSurface(const PatientImage& volume, const ImagePart& part,
  const std::string& name, std::vector<std::string>& notes)
{
  const auto refuse = [&](const std::string& what)
  { throw Error(ErrorCode::BadMesh, name + ": " + what); };
  const int* size = volume.image->GetDimensions();
  vtkDataArray* voxels = volume.image->GetPointData()->GetScalars();
  if (std::min({ size[0], size[1], size[2] }) < 2)
  {
    refuse("no volume in it; give an image of two slices or more");
  }
  if (!voxels)
  {
    refuse("no values at its voxels; export it again");
  }
  if (voxels->GetNumberOfComponents() != 1 && volume.segments.empty())
  {
    refuse("several values at each voxel; give an image of one");
  }
  checkPosition(volume, name);
  const Contour contour = contourOf(volume, part, name, notes);
  constexpr std::uintmax_t most = 10'000'000;
  if (const std::uintmax_t triangles = 2 * crossings(*contour.image, contour.level);
      triangles > most)
  {
    refuse("its surface would have " + std::to_string(triangles / 1'000'000) +
      " million triangles, noise at that level; smooth the image, or take fewer voxels");
  }

  if (contour.mask)
  {
    noteVoxels(volume, notes);
  }
  vtkSmartPointer<vtkPolyData> surface =
    imageContour(*contour.image, contour.level, contour.mask, notes);
  vtkNew<vtkMatrix4x4> toPatient;
  toPatient->DeepCopy(volume.toPatient);
  for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i)
  {
    const double* p = surface->GetPoint(i);
    const double from[4] = { p[0], p[1], p[2], 1.0 };
    double to[4];
    toPatient->MultiplyPoint(from, to);
    surface->GetPoints()->SetPoint(i, to);
  }
  // towards lower values, also in a mirror and of a negative slope
  if ((toPatient->Determinant() < 0.0) != (part.labels.empty() && volume.slope < 0.0))
  {
    flip(*surface);
  }
  if (facesInward(*surface))
  {
    if (!part.labels.empty())
    {
      refuse(
        "the label reaches the border of the image all around, so that its outer surface is not "
        "in it; name the label that it surrounds");
    }
    notes.emplace_back("the body is what is below the level, as a distance is; what is above it "
                       "reaches the border of the image all around");
  }
  return surface;
}

} // namespace palp
