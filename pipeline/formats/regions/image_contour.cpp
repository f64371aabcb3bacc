#include "pipeline/formats/regions/image_contour.h"

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

// a contour with what hangs together of it
struct Linked
{
  explicit Linked(const ImageContour& contour)
    : edges(edgesOf(contour.points.size(), contour.triangles))
    , pieces(piecesOf(edges.across))
    , sizes(pieceSizes(contour.points, contour.triangles, pieces))
  {
  }

  Edges edges;
  std::vector<int> pieces; // of each triangle
  std::vector<PieceSize> sizes;
};

// What a contour, which cuts the corners of voxels, lacks of their volume for each area of it.
double bevelOf(const Linked& linked, double mask)
{
  double volume = 0.0;
  double area = 0.0;
  for (const PieceSize& piece : linked.sizes)
  {
    volume += piece.volume;
    area += std::copysign(piece.area, piece.volume); // hollows lack it, too
  }
  return (mask - std::abs(volume)) / std::abs(area);
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
  Linked linked(contour);
  const double bevel = mask > 0.0 ? bevelOf(linked, mask) : 0.0;
  const ContourPieces pieces = contourPieces(
    contour.points, contour.triangles, linked.pieces, components, kLeastHollow * spacing.prod());
  if (!pieces.note.empty())
  {
    notes.push_back(pieces.note);
  }
  if (!pieces.areAll)
  {
    drop(contour, pieces.isKept);
    linked = Linked(contour);
  }
  contour.from = contour.points;
  for (PieceSize& piece : linked.sizes)
  {
    piece.volume += std::copysign(bevel * piece.area, piece.volume);
    contour.enclosed += piece.volume;
  }
  if (mask > 0.0)
  {
    bendLeast(
      contour.points, contour.triangles, linked.edges, 0.5 * spacing, linked.pieces, linked.sizes);
  }
  else
  {
    smoothStairs(contour);
  }
  return contour;
}

} // namespace palp
