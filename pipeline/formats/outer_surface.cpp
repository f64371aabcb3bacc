#include "pipeline/formats/outer_surface.h"

#include "haptics/error.h"
#include "pipeline/model/coincident_points.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <string_view>
#include <tuple>
#include <vector>
#include <vtkCellArray.h>
#include <vtkCellType.h>
#include <vtkCellTypes.h>
#include <vtkDataArray.h>
#include <vtkDataSetSurfaceFilter.h>
#include <vtkGenericCell.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>

namespace palp
{
namespace
{

using Eigen::Vector3d;

// of a cell of that kind; 0: it differs from cell to cell
vtkIdType pointsNeeded(int kind)
{
  constexpr std::array kFixed{ VTK_TETRA, VTK_VOXEL, VTK_HEXAHEDRON, VTK_WEDGE, VTK_PYRAMID,
    VTK_PENTAGONAL_PRISM, VTK_HEXAGONAL_PRISM, VTK_QUADRATIC_TETRA, VTK_QUADRATIC_HEXAHEDRON,
    VTK_QUADRATIC_WEDGE, VTK_QUADRATIC_PYRAMID, VTK_TRIQUADRATIC_HEXAHEDRON,
    VTK_QUADRATIC_LINEAR_WEDGE, VTK_BIQUADRATIC_QUADRATIC_WEDGE,
    VTK_BIQUADRATIC_QUADRATIC_HEXAHEDRON };
  if (std::ranges::find(kFixed, kind) == kFixed.end())
  {
    return 0;
  }
  vtkNew<vtkGenericCell> cell;
  cell->SetCellType(kind);
  return cell->GetNumberOfPoints();
}

// VTK reads past the end of a cell with too few points
void checkCells(vtkUnstructuredGrid& grid, const std::string& name)
{
  const auto refuse = [&](const std::string& what)
  { throw Error(ErrorCode::BadFile, name + ": " + what + "; export it again"); };
  vtkCellArray* cells = grid.GetCells();
  const vtkIdType points = grid.GetNumberOfPoints();
  vtkDataArray* corners = cells ? cells->GetConnectivityArray() : nullptr;
  for (vtkIdType i = 0; corners && i < corners->GetNumberOfValues(); ++i)
  {
    const double corner = corners->GetComponent(i, 0);
    if (!(corner >= 0.0 && corner < static_cast<double>(points)))
    {
      refuse("a cell names a point that is not there");
    }
  }
  std::map<int, vtkIdType> needed;
  for (vtkIdType i = 0; i < grid.GetNumberOfCells(); ++i)
  {
    const int kind = grid.GetCellType(i);
    const auto [known, isNew] = needed.try_emplace(kind, 0);
    if (isNew)
    {
      if (std::string_view(vtkCellTypes::GetClassNameFromTypeId(kind)) == "UnknownClass")
      {
        refuse("a cell is of kind " + std::to_string(kind) + ", which is none of VTK's");
      }
      known->second = pointsNeeded(kind);
    }
    const vtkIdType most = known->second;
    if (const vtkIdType size = cells->GetCellSize(i); most > 0 && size != most)
    {
      refuse("a cell of " + std::to_string(size) + " points, where its kind has " +
        std::to_string(most));
    }
  }
}

// a face of a cell; faces of the same corners are the same, whatever their order
struct Face
{
  static constexpr std::size_t kTold = 4; // corners, the smallest, tell a face from others

  std::array<int, kTold> corners{ -1, -1, -1, -1 };
  int count = 0;
  int number = 0; // in its cell
  vtkIdType cell = 0;
  std::uint64_t cellMark = 0; // the same for cells of the same points

  [[nodiscard]] auto key() const
  {
    return std::tie(corners, count);
  }
};

std::vector<int> sortedCorners(vtkCell& cell, const std::vector<int>& first)
{
  std::vector<int> corners(static_cast<std::size_t>(cell.GetNumberOfPoints()));
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    corners[i] = first[static_cast<std::size_t>(cell.GetPointId(static_cast<int>(i)))];
  }
  std::ranges::sort(corners);
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  return corners;
}

std::uint64_t markOf(const std::vector<int>& corners)
{
  std::uint64_t mark = corners.size();
  for (const int corner : corners)
  {
    constexpr std::uint64_t kPrime = 0x9E3779B97F4A7C15;
    mark = (mark ^ static_cast<std::uint64_t>(corner)) * kPrime;
    mark ^= mark >> 29U;
  }
  return mark;
}

// of all volume cells; those that have collapsed to a line are none
std::vector<Face> facesOf(vtkUnstructuredGrid& grid, const std::vector<int>& first)
{
  std::vector<Face> faces;
  vtkNew<vtkGenericCell> cell;
  for (vtkIdType i = 0; i < grid.GetNumberOfCells(); ++i)
  {
    grid.GetCell(i, cell);
    if (cell->GetCellDimension() != 3)
    {
      continue;
    }
    const std::uint64_t mark = markOf(sortedCorners(*cell, first));
    for (int number = 0; number < cell->GetNumberOfFaces(); ++number)
    {
      const std::vector<int> corners = sortedCorners(*cell->GetFace(number), first);
      if (corners.size() >= 3)
      {
        Face face{
          .count = static_cast<int>(corners.size()), .number = number, .cell = i, .cellMark = mark
        };
        std::copy_n(corners.begin(), std::min(corners.size(), Face::kTold), face.corners.begin());
        faces.push_back(face);
      }
    }
  }
  return faces;
}

// those of one cell only, in the order of the cells
std::vector<Face> outerOnes(std::vector<Face> faces)
{
  std::ranges::sort(faces, {},
    [](const Face& face)
    { return std::tuple(face.corners, face.count, face.cellMark, face.cell, face.number); });
  std::vector<Face> outer;
  for (auto begin = faces.begin(); begin != faces.end();)
  {
    const auto end = std::find_if(
      begin, faces.end(), [&](const Face& face) { return face.key() != begin->key(); });
    if (begin->cellMark == std::prev(end)->cellMark)
    {
      outer.push_back(*begin);
    }
    begin = end;
  }
  std::ranges::sort(outer, {}, [](const Face& face) { return std::tie(face.cell, face.number); });
  return outer;
}

// the corners of flat pieces, each once
std::vector<std::vector<int>> piecesOf(vtkCell& face, const std::vector<int>& first)
{
  vtkNew<vtkIdList> corners;
  vtkIdType size = face.GetNumberOfPoints();
  if (face.IsLinear() && face.GetCellType() != VTK_PIXEL)
  {
    corners->DeepCopy(face.GetPointIds());
  }
  else
  {
    vtkNew<vtkPoints> unused;
    face.Triangulate(0, corners, unused);
    size = 3;
  }
  std::vector<std::vector<int>> pieces;
  for (vtkIdType begin = 0; begin + size <= corners->GetNumberOfIds(); begin += size)
  {
    std::vector<int> piece;
    for (vtkIdType i = begin; i < begin + size; ++i)
    {
      const int corner = first[static_cast<std::size_t>(corners->GetId(i))];
      if (piece.empty() || (corner != piece.back() && corner != piece.front()))
      {
        piece.push_back(corner);
      }
    }
    if (piece.size() >= 3)
    {
      pieces.push_back(piece);
    }
  }
  return pieces;
}

Vector3d middleOf(vtkCell& cell)
{
  Vector3d sum = Vector3d::Zero();
  for (vtkIdType i = 0; i < cell.GetNumberOfPoints(); ++i)
  {
    sum += Vector3d(cell.GetPoints()->GetPoint(i));
  }
  return sum / static_cast<double>(cell.GetNumberOfPoints());
}

// six times the volume between a polygon and a point; positive: it faces away from there
double volumeTo(
  const Vector3d& from, const std::vector<int>& corners, const std::vector<Vector3d>& points)
{
  const auto at = [&](std::size_t i) -> Vector3d
  { return points[static_cast<std::size_t>(corners[i])] - from; };
  double volume = 0.0;
  for (std::size_t i = 1; i + 1 < corners.size(); ++i)
  {
    volume += at(0).dot(at(i).cross(at(i + 1)));
  }
  return volume;
}

vtkSmartPointer<vtkPolyData> polygonsOf(vtkUnstructuredGrid& grid, const std::vector<Face>& faces,
  const std::vector<int>& first, const std::vector<Vector3d>& points)
{
  std::vector<vtkIdType> number(points.size(), -1);
  vtkNew<vtkPoints> used;
  used->SetDataType(grid.GetPoints()->GetDataType());
  vtkNew<vtkCellArray> polygons;
  vtkNew<vtkGenericCell> cell;
  for (const Face& face : faces)
  {
    grid.GetCell(face.cell, cell);
    const Vector3d middle = middleOf(*cell);
    for (std::vector<int>& piece : piecesOf(*cell->GetFace(face.number), first))
    {
      if (volumeTo(middle, piece, points) < 0.0)
      {
        std::ranges::reverse(piece);
      }
      polygons->InsertNextCell(static_cast<int>(piece.size()));
      for (const int corner : piece)
      {
        vtkIdType& known = number[static_cast<std::size_t>(corner)];
        known = known < 0 ? used->InsertNextPoint(points[static_cast<std::size_t>(corner)].data())
                          : known;
        polygons->InsertCellPoint(known);
      }
    }
  }
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  surface->SetPoints(used);
  surface->SetPolys(polygons);
  surface->SetFieldData(grid.GetFieldData()); // its unit
  return surface;
}

} // namespace

vtkSmartPointer<vtkPolyData> outerSurface(vtkUnstructuredGrid& grid, const std::string& name)
{
  if (grid.GetNumberOfPoints() > std::numeric_limits<int>::max())
  {
    throw Error(ErrorCode::BadMesh, name + ": too many points; export a coarser mesh");
  }
  checkCells(grid, name);
  std::vector<Vector3d> points(static_cast<std::size_t>(grid.GetNumberOfPoints()));
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    grid.GetPoint(static_cast<vtkIdType>(i), points[i].data());
  }
  const std::vector<int> first = firstOfEach(points);
  const std::vector<Face> faces = facesOf(grid, first);
  if (faces.empty()) // corners, edges and faces alone
  {
    vtkNew<vtkDataSetSurfaceFilter> outside;
    outside->SetInputData(&grid);
    outside->Update();
    return outside->GetOutput();
  }
  return polygonsOf(grid, outerOnes(faces), first, points);
}

} // namespace palp
