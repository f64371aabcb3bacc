#include "pipeline/formats/regions/image_contour.h"

#include "haptics/surface/area_and_volume.h"
#include "haptics/surface/edges.h"
#include "pipeline/formats/regions/contour_pieces.h"
#include "pipeline/formats/regions/image_grids.h"
#include "pipeline/formats/regions/least_bending.h"
#include "pipeline/formats/regions/piece_volumes.h"
#include "pipeline/model/poly_data.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vtkFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkWindowedSincPolyDataFilter.h>

namespace palp
{
namespace
{

ImageContour contourOf(vtkImageData& image, double level)
{
  vtkNew<vtkFlyingEdges3D> flying; // starts no thread where VTK is told so
  flying->SetInputData(&image);
  flying->SetValue(0, level);
  flying->ComputeNormalsOff();
  flying->ComputeScalarsOff();
  flying->Update();
  ImageContour contour{ .points = pointsOf(*flying->GetOutput()),
    .triangles = trianglesOf(*flying->GetOutput()),
    .from = {} };
  groupByTriangles(contour.points, contour.triangles);
  return contour;
}

void drop(ImageContour& contour, const std::vector<bool>& isKept)
{
  std::vector<bool> isUsed(contour.points.size(), false);
  std::vector<Triangle> triangles;
  for (std::size_t i = 0; i < contour.triangles.size(); ++i)
  {
    if (isKept[i])
    {
      const Triangle& triangle = triangles.emplace_back(contour.triangles[i]);
      std::ranges::for_each(triangle, [&](int corner) { isUsed[at(corner)] = true; });
    }
  }
  std::vector<int> number(contour.points.size(), -1);
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i < contour.points.size(); ++i)
  {
    if (isUsed[i])
    {
      number[i] = static_cast<int>(points.size());
      points.push_back(contour.points[i]);
    }
  }
  for (Triangle& triangle : triangles)
  {
    std::ranges::for_each(triangle, [&](int& corner) { corner = number[at(corner)]; });
  }
  contour.points = std::move(points);
  contour.triangles = std::move(triangles);
}

std::vector<Eigen::Vector3d> smoothed(
  const std::vector<Eigen::Vector3d>& points, const std::vector<Triangle>& triangles)
{
  vtkNew<vtkWindowedSincPolyDataFilter> smooth;
  smooth->SetInputData(makePolyData(points, triangles));
  smooth->SetNumberOfIterations(20);
  smooth->SetPassBand(0.1); // a stair of one voxel goes, what is larger stays
  smooth->BoundarySmoothingOff();
  smooth->Update();
  return pointsOf(*smooth->GetOutput());
}

// Of a place that all its neighbors share, the filter leaves a little less than all of it: 0.9984.
// Without that a body would shrink by as much.
void smoothStairs(ImageContour& contour)
{
  static const double share = smoothed(std::vector<Eigen::Vector3d>(4, Eigen::Vector3d::UnitX()),
    { { 0, 1, 2 }, { 0, 3, 1 }, { 1, 3, 2 }, { 2, 3, 0 } })
                                .front()
                                .x();
  const Eigen::Vector3d middle = boxAbout(contour.points).center(); // for the sake of rounding
  for (Eigen::Vector3d& x : contour.points)
  {
    x -= middle;
  }
  contour.points = smoothed(contour.points, contour.triangles);
  for (Eigen::Vector3d& x : contour.points)
  {
    x = middle + x / share;
  }
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

// The volume of the voxels in each piece, not of what a contour leaves of them where it cuts their
// corners: by Gauss's theorem, as each point of a mask's contour is the middle of a voxel's face.
void countVoxels(vtkImageData& image, const ImageContour& contour, Linked& linked)
{
  std::vector<double> outward(contour.points.size(), 0.0); // along the first axis
  std::vector<std::size_t> pieceOf(contour.points.size(), 0);
  for (std::size_t i = 0; i < contour.triangles.size(); ++i)
  {
    const auto& [a, b, c] = contour.triangles[i];
    const Eigen::Vector3d& from = contour.points[at(a)];
    const double along = (contour.points[at(b)] - from).cross(contour.points[at(c)] - from).x();
    for (const int corner : contour.triangles[i])
    {
      outward[at(corner)] += along;
      pieceOf[at(corner)] = at(linked.pieces[i]);
    }
  }
  const Eigen::Array3d spacing(image.GetSpacing());
  const double face = std::abs(spacing[1] * spacing[2]);
  std::ranges::for_each(linked.sizes, [](PieceSize& piece) { piece.volume = 0.0; });
  for (std::size_t i = 0; i < contour.points.size(); ++i)
  {
    const double index = (contour.points[i].x() - image.GetOrigin()[0]) / spacing[0];
    constexpr double kOff = 0.25; // from voxels: else the face is along the first axis
    linked.sizes[pieceOf[i]].volume += std::abs(index - std::round(index)) > kOff
      ? std::copysign(face, outward[i]) * index * spacing[0]
      : 0.0;
  }
}

// to where the voxels say that points are; along an axis on which one is out of the field, to its
// very place
void takeBack(ImageContour& contour, const Eigen::Array3d& most, const Eigen::AlignedBox3d* field)
{
  for (std::size_t i = 0; i < contour.points.size(); ++i)
  {
    const Eigen::Array3d from = contour.from[i].array();
    Eigen::Array3d reach = most;
    if (field != nullptr && !field->contains(contour.from[i]))
    {
      reach = (from < field->min().array() || from > field->max().array()).select(0.0, most);
    }
    contour.points[i] = contour.points[i].array().max(from - reach).min(from + reach).matrix();
  }
}

} // namespace

ImageContour imageContour(vtkImageData& image, double level, bool isMask,
  const Eigen::AlignedBox3d& field, std::size_t components, std::vector<std::string>& notes)
{
  ImageContour contour = contourOf(image, level);
  if (contour.triangles.empty())
  {
    return contour;
  }
  const Eigen::Array3d spacing = Eigen::Array3d(image.GetSpacing()).abs();
  Linked linked(contour);
  isMask ? countVoxels(image, contour, linked) : void();
  const ContourPieces pieces = contourPieces(
    contour.points, contour.triangles, linked.pieces, linked.sizes, components, spacing.prod());
  if (!pieces.note.empty())
  {
    notes.push_back(pieces.note);
  }
  if (!pieces.areAll)
  {
    drop(contour, pieces.isKept);
    linked = Linked(contour);
    isMask ? countVoxels(image, contour, linked) : void();
  }
  contour.from = contour.points;
  for (const PieceSize& piece : linked.sizes)
  {
    contour.enclosed += piece.volume;
    contour.largest = std::max(contour.largest, std::abs(piece.volume));
  }
  const Neighbors neighbors(contour.points.size(), linked.edges);
  isMask ? bendLeast(contour.points, neighbors, 0.5 * spacing) : smoothStairs(contour);
  const auto bound = [&] { takeBack(contour, 0.5 * spacing, isMask ? &field : nullptr); };
  bound();
  restoreVolumes(
    contour.points, contour.from, contour.triangles, neighbors, bound, linked.pieces, linked.sizes);
  return contour;
}

} // namespace palp
