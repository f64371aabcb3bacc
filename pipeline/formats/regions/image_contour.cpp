#include "pipeline/formats/regions/image_contour.h"

#include "haptics/surface/area_and_volume.h"
#include "haptics/surface/edges.h"
#include "pipeline/formats/regions/contour_pieces.h"
#include "pipeline/formats/regions/image_grids.h"
#include "pipeline/formats/regions/least_bending.h"
#include "pipeline/model/poly_data.h"

#include <Eigen/Geometry>
#include <cmath>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSynchronizedTemplates3D.h>
#include <vtkWindowedSincPolyDataFilter.h>

namespace palp
{
namespace
{

constexpr double kLeastHollow = 100.0; // [voxels]

ImageContour contourOf(vtkImageData& image, double level)
{
  vtkNew<vtkSynchronizedTemplates3D> templates; // starts no thread, unlike its newer kin
  templates->SetInputData(&image);
  templates->SetValue(0, level);
  templates->ComputeNormalsOff();
  templates->ComputeScalarsOff();
  templates->Update();
  return { .points = pointsOf(*templates->GetOutput()),
    .triangles = trianglesOf(*templates->GetOutput()),
    .from = {} };
}

double areaOf(const ImageContour& contour)
{
  double area = 0.0;
  for (const auto& [a, b, c] : contour.triangles)
  {
    const Eigen::Vector3d& from = contour.points[at(a)];
    area += 0.5 * (contour.points[at(b)] - from).cross(contour.points[at(c)] - from).norm();
  }
  return area;
}

void drop(ImageContour& contour, const std::vector<bool>& isKept)
{
  std::vector<int> number(contour.points.size(), -1);
  std::vector<Eigen::Vector3d> points;
  std::vector<Triangle> triangles;
  for (std::size_t i = 0; i < contour.triangles.size(); ++i)
  {
    if (!isKept[i])
    {
      continue;
    }
    Triangle& triangle = triangles.emplace_back(contour.triangles[i]);
    for (int& corner : triangle)
    {
      int& known = number[at(corner)];
      if (known < 0)
      {
        known = static_cast<int>(points.size());
        points.push_back(contour.points[at(corner)]);
      }
      corner = known;
    }
  }
  contour.points = std::move(points);
  contour.triangles = std::move(triangles);
}

void smoothStairs(ImageContour& contour)
{
  vtkNew<vtkWindowedSincPolyDataFilter> smooth;
  smooth->SetInputData(makePolyData(contour.points, contour.triangles));
  smooth->SetNumberOfIterations(20);
  smooth->SetPassBand(0.1); // a stair of one voxel goes, what is larger stays
  smooth->NormalizeCoordinatesOn();
  smooth->BoundarySmoothingOff();
  smooth->Update();
  contour.points = pointsOf(*smooth->GetOutput());
}

// drops what is not asked for
Edges keepPieces(ImageContour& contour, std::size_t components, double leastHollow,
  std::vector<std::string>& notes)
{
  Edges edges = edgesOf(contour.points.size(), contour.triangles);
  const ContourPieces pieces = contourPieces(
    contour.points, contour.triangles, piecesOf(edges.across), components, leastHollow);
  if (!pieces.note.empty())
  {
    notes.push_back(pieces.note);
  }
  if (pieces.areAll)
  {
    return edges;
  }
  drop(contour, pieces.isKept);
  return edgesOf(contour.points.size(), contour.triangles);
}

} // namespace

ImageContour imageContour(vtkImageData& image, double level, double mask, std::size_t components,
  std::vector<std::string>& notes)
{
  ImageContour contour = contourOf(image, level);
  if (contour.triangles.empty())
  {
    return contour;
  }
  const Eigen::Array3d spacing = Eigen::Array3d(image.GetSpacing()).abs();
  // what a contour, which cuts the corners of voxels, lacks of their volume for each area of it
  const double cut = std::abs(enclosedVolume(contour.points, contour.triangles));
  const double bevel = mask > 0.0 ? (mask - cut) / areaOf(contour) : 0.0;
  const Edges edges = keepPieces(contour, components, kLeastHollow * spacing.prod(), notes);
  contour.from = contour.points;
  const double volume = enclosedVolume(contour.points, contour.triangles);
  contour.enclosed = volume + std::copysign(bevel * areaOf(contour), volume);
  if (mask > 0.0)
  {
    bendLeast(contour.points, contour.triangles, edges, 0.5 * spacing, contour.enclosed);
  }
  else
  {
    smoothStairs(contour);
  }
  return contour;
}

} // namespace palp
