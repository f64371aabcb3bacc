#include "pipeline/formats/image_contour.h"

#include "haptics/files/input_text.h"
#include "haptics/surface/edges.h"
#include "haptics/surface/winding.h"
#include "pipeline/formats/image_values.h"
#include "pipeline/model/poly_data.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataConnectivityFilter.h>
#include <vtkSynchronizedTemplates3D.h>
#include <vtkWindowedSincPolyDataFilter.h>

namespace palp
{
namespace
{

constexpr double kLeastHollow = 100.0; // [voxels]

// of a contour, what hangs together
struct Piece
{
  std::vector<Triangle> triangles;
  double volume = 0.0; // negative where it faces the other way [unit^3]
};

// numbered as the filter numbers them
std::vector<Piece> piecesOf(vtkPolyData& colored, std::span<const Eigen::Vector3d> points)
{
  std::vector<Piece> pieces;
  vtkDataArray& colors = *colored.GetPointData()->GetScalars();
  for (const Triangle& triangle : trianglesOf(colored))
  {
    const auto [a, b, c] = triangle;
    const auto color = static_cast<std::size_t>(colors.GetTuple1(a));
    pieces.resize(std::max(pieces.size(), color + 1));
    pieces[color].triangles.push_back(triangle);
    pieces[color].volume += points[at(a)].dot(points[at(b)].cross(points[at(c)])) / 6.0;
  }
  return pieces;
}

// the largest piece, and the walls of its hollows
vtkSmartPointer<vtkPolyData> bodyOf(
  vtkPolyData& contour, double voxel, std::vector<std::string>& notes)
{
  vtkNew<vtkPolyDataConnectivityFilter> filter;
  filter->SetInputData(&contour);
  filter->SetExtractionModeToAllRegions();
  filter->ColorRegionsOn();
  filter->Update();
  if (filter->GetNumberOfExtractedRegions() < 2)
  {
    return filter->GetOutput();
  }
  const std::vector<Eigen::Vector3d> points = pointsOf(*filter->GetOutput());
  const std::vector<Piece> pieces = piecesOf(*filter->GetOutput(), points);
  const auto largest =
    std::ranges::max_element(pieces, {}, [](const Piece& piece) { return piece.triangles.size(); });
  const double side = std::copysign(1.0, largest->volume);
  const Winding winding(BoxTree(points, largest->triangles));
  std::size_t kept = 0;
  std::size_t filled = 0;
  filter->SetExtractionModeToSpecifiedRegions();
  for (std::size_t i = 0; i < pieces.size(); ++i)
  {
    const Piece& piece = pieces[i];
    const bool isHollow =
      piece.volume * side < 0.0 && side * winding(points[at(piece.triangles.front()[0])]) > 0.5;
    const bool isLarge = std::abs(piece.volume) >= kLeastHollow * voxel;
    kept += isHollow && isLarge ? 1 : 0;
    filled += isHollow && !isLarge ? 1 : 0;
    if (&piece == &*largest || (isHollow && isLarge))
    {
      filter->AddSpecifiedRegion(static_cast<int>(i));
    }
  }
  filter->Update();
  notes.push_back("the largest of its " + std::to_string(pieces.size()) + " pieces is taken" +
    (kept > 0 ? ", with " + counted(kept, "hollow") : "") +
    (filled > 0 ? ", and " + counted(filled, "hollow") + " of less than 100 voxels filled" : ""));
  return filter->GetOutput();
}

// The mean of the neighbors less the point itself; 0 at an open edge, which stays.
class Laplacian
{
public:
  explicit Laplacian(const Edges& edges, std::size_t points)
    : edges_(edges.all)
    , weights_(Eigen::RowVectorXd::Zero(static_cast<Eigen::Index>(points)))
  {
    for (const auto& [a, b] : edges_)
    {
      weights_[a] += 1.0;
      weights_[b] += 1.0;
    }
    weights_ = (weights_.array() > 0.0).select(weights_.cwiseInverse(), 0.0);
    for (const auto& [a, b] : edges.unpaired)
    {
      weights_[a] = weights_[b] = 0.0;
    }
  }

  void operator()(const Eigen::Matrix3Xd& points, Eigen::Matrix3Xd& result) const
  {
    result = Eigen::Matrix3Xd::Zero(3, points.cols());
    for (const auto& [a, b] : edges_)
    {
      const Eigen::Vector3d along = points.col(b) - points.col(a);
      result.col(a) += along;
      result.col(b) -= along;
    }
    result.array().rowwise() *= weights_.array();
  }

private:
  std::span<const std::array<int, 2>> edges_;
  Eigen::RowVectorXd weights_;
};

struct Extent
{
  double volume = 0.0; // [unit^3]
  double area = 0.0;   // [unit^2]
};

Extent extentOf(const Eigen::Matrix3Xd& points, std::span<const Triangle> triangles)
{
  Extent extent;
  for (const auto& [a, b, c] : triangles)
  {
    extent.volume += points.col(a).dot(points.col(b).cross(points.col(c))) / 6.0;
    extent.area +=
      0.5 * (points.col(b) - points.col(a)).cross(points.col(c) - points.col(a)).norm();
  }
  return extent;
}

Eigen::Matrix3Xd matrixOf(const std::vector<Eigen::Vector3d>& points)
{
  return Eigen::Map<const Eigen::Matrix3Xd>(
    points.front().data(), 3, static_cast<Eigen::Index>(points.size()));
}

// What a contour, which cuts the corners of voxels, lacks of the volume of those that it encloses,
// for each area of it [unit]; 0 where it is open.
double bevelOf(vtkPolyData& contour, double enclosed)
{
  const std::vector<Eigen::Vector3d> points = pointsOf(contour);
  const std::vector<Triangle> triangles = trianglesOf(contour);
  if (!edgesOf(points.size(), triangles).unpaired.empty())
  {
    return 0.0;
  }
  const Extent extent = extentOf(matrixOf(points), triangles);
  return (enclosed - std::abs(extent.volume)) / extent.area;
}

// moves all points outward, by as much for each, so that a volume is added
void swell(Eigen::Matrix3Xd& points, std::span<const Triangle> triangles, double volume)
{
  Eigen::Matrix3Xd outward = Eigen::Matrix3Xd::Zero(3, points.cols());
  double area = 0.0;
  for (const auto& [a, b, c] : triangles)
  {
    const Eigen::Vector3d vector =
      0.5 * (points.col(b) - points.col(a)).cross(points.col(c) - points.col(a));
    area += vector.norm();
    outward.col(a) += vector;
    outward.col(b) += vector;
    outward.col(c) += vector;
  }
  for (Eigen::Index i = 0; i < points.cols(); ++i)
  {
    points.col(i) += volume / area * outward.col(i).normalized(); // one without a triangle stays
  }
}

// The surface that bends least among those that pass where the voxels say: the sum of the squared
// Laplacians, by projected gradients (Beck and Teboulle, SIAM J. Imaging Sci. 2(1), 2009).
// bevel: what the volume lacks for each area [unit]
void smoothTerraces(vtkPolyData& surface, const Eigen::Array3d& most, double bevel)
{
  const std::vector<Eigen::Vector3d> points = pointsOf(surface);
  const std::vector<Triangle> triangles = trianglesOf(surface);
  const auto count = static_cast<Eigen::Index>(points.size());
  const Edges edges = edgesOf(points.size(), triangles);
  const Laplacian laplacian(edges, points.size());
  const Eigen::Matrix3Xd from = matrixOf(points);
  const Eigen::Matrix3Xd low = from.array().colwise() - most;
  const Eigen::Matrix3Xd high = from.array().colwise() + most;
  Eigen::Matrix3Xd now = from;
  Eigen::Matrix3Xd ahead = from;
  Eigen::Matrix3Xd bend(3, count);
  Eigen::Matrix3Xd slope(3, count);
  constexpr Eigen::Index kWork = 100'000'000; // steps of a point, for half a minute at most
  const auto steps = std::clamp<Eigen::Index>(kWork / count, 10, 100); // terraces of ten voxels
  constexpr double kStep = 0.25; // the inverse of the largest value of the Laplacian, squared
  double pace = 1.0;
  for (Eigen::Index i = 0; i < steps; ++i)
  {
    laplacian(ahead, bend);
    laplacian(bend, slope);
    const Eigen::Matrix3Xd next = (ahead - kStep * slope).cwiseMax(low).cwiseMin(high);
    const double faster = 0.5 * (1.0 + std::sqrt(1.0 + 4.0 * pace * pace));
    ahead = next + (pace - 1.0) / faster * (next - now);
    now = next;
    pace = faster;
  }
  const Extent before = extentOf(from, triangles);
  const double volume = before.volume + std::copysign(bevel * before.area, before.volume);
  for (int i = 0; i < 4 && edges.unpaired.empty(); ++i) // the bounds take some of it back
  {
    swell(now, triangles, volume - extentOf(now, triangles).volume);
    now = now.cwiseMax(low).cwiseMin(high);
  }
  for (Eigen::Index i = 0; i < count; ++i)
  {
    surface.GetPoints()->SetPoint(i, now.col(i).data());
  }
}

} // namespace

vtkSmartPointer<vtkPolyData> imageContour(
  vtkImageData& image, double level, bool mask, std::vector<std::string>& notes)
{
  vtkNew<vtkSynchronizedTemplates3D> templates; // starts no thread, unlike its newer kin
  templates->SetInputData(&image);
  templates->SetValue(0, level);
  templates->ComputeNormalsOff();
  templates->ComputeScalarsOff();
  templates->Update();
  const Eigen::Array3d spacing = Eigen::Array3d(image.GetSpacing()).abs();
  auto body = bodyOf(*templates->GetOutput(), spacing.prod(), notes);
  if (mask && body->GetNumberOfPoints() > 0)
  {
    const double enclosed = spacing.prod() * static_cast<double>(voxelsAbove(image, level));
    smoothTerraces(*body, 0.5 * spacing, bevelOf(*templates->GetOutput(), enclosed));
    return body;
  }
  vtkNew<vtkWindowedSincPolyDataFilter> smooth;
  smooth->SetInputData(body);
  smooth->SetNumberOfIterations(20);
  smooth->SetPassBand(0.1); // a stair of one voxel goes, what is larger stays
  smooth->NormalizeCoordinatesOn();
  smooth->BoundarySmoothingOff();
  smooth->Update();
  return smooth->GetOutput();
}

} // namespace palp
