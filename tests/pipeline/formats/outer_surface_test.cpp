#include "tests/pipeline/surface_files.h"

#include <sstream>

namespace palp::test
{
namespace
{

struct Cell
{
  int kind; // as VTK numbers them
  std::vector<int> corners;
};

constexpr int kVertex = 1;
constexpr int kLine = 3;
constexpr int kTriangle = 5;
constexpr int kTetrahedron = 10;
constexpr int kHexahedron = 12;
constexpr int kQuadraticTetrahedron = 24;

std::string numbers(const auto& values)
{
  std::ostringstream text;
  for (const auto& value : values)
  {
    text << value << ' ';
  }
  return text.str();
}

std::string legacy(const std::vector<double>& points, const std::vector<Cell>& cells)
{
  std::ostringstream text;
  text << "# vtk DataFile Version 3.0\nmesh\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS "
       << points.size() / 3 << " double\n"
       << numbers(points) << "\nCELLS " << cells.size() << ' ';
  std::size_t size = 0;
  std::string corners;
  std::string kinds;
  for (const Cell& cell : cells)
  {
    size += 1 + cell.corners.size();
    corners += std::to_string(cell.corners.size()) + ' ' + numbers(cell.corners) + '\n';
    kinds += std::to_string(cell.kind) + '\n';
  }
  text << size << '\n' << corners << "CELL_TYPES " << cells.size() << '\n' << kinds;
  return text.str();
}

std::string piece(const std::vector<double>& points, const std::vector<Cell>& cells)
{
  std::vector<int> corners;
  std::vector<std::size_t> ends;
  std::vector<int> kinds;
  for (const Cell& cell : cells)
  {
    corners.insert(corners.end(), cell.corners.begin(), cell.corners.end());
    ends.push_back(corners.size());
    kinds.push_back(cell.kind);
  }
  return "<Piece NumberOfPoints=\"" + std::to_string(points.size() / 3) + "\" NumberOfCells=\"" +
    std::to_string(cells.size()) +
    "\"><Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">" +
    numbers(points) +
    "</DataArray></Points><Cells><DataArray type=\"Int32\" Name=\"connectivity\" "
    "format=\"ascii\">" +
    numbers(corners) + "</DataArray><DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">" +
    numbers(ends) + "</DataArray><DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">" +
    numbers(kinds) + "</DataArray></Cells></Piece>";
}

std::string vtu(const std::string& pieces)
{
  return "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\">"
         "<UnstructuredGrid>" +
    pieces + "</UnstructuredGrid></VTKFile>\n";
}

// two tetrahedra with one face in common: by determinants 1/6 and 2/6 of (100 mm)^3
const std::vector<double> kPoints{ 0, 0, 0, 100, 0, 0, 0, 100, 0, 0, 0, 100, 100, 100, 100 };
const std::vector<Cell> kTetrahedra{ { kTetrahedron, { 0, 1, 2, 3 } },
  { kTetrahedron, { 1, 2, 3, 4 } } };
constexpr double kVolume = 0.1 * 0.1 * 0.1 / 6.0 * 3.0; // [m^3]

void expectBoth(const LoadedSurface& surface)
{
  EXPECT_TRUE(surface.closed);
  EXPECT_EQ(meshOf(surface).points.size(), 5u);
  EXPECT_EQ(meshOf(surface).triangles.size(), 6u);
  EXPECT_NEAR(volume(meshOf(surface)), kVolume, 1e-9);
}

// as mesh generators write it: corners, edges and boundary of the volume in the same file
TEST_F(SurfaceFile, OfAVolumeMeshWithItsBoundaryHasEachTriangleOnce)
{
  for (const bool turned : { false, true })
  {
    std::vector<Cell> cells{ { kVertex, { 0 } }, { kLine, { 0, 1 } } };
    for (std::vector<int> t :
      { std::vector{ 0, 2, 1 }, { 0, 1, 3 }, { 0, 3, 2 }, { 1, 2, 4 }, { 2, 3, 4 }, { 3, 1, 4 } })
    {
      if (turned)
      {
        std::ranges::reverse(t);
      }
      cells.push_back({ kTriangle, t });
    }
    cells.insert(turned ? cells.begin() : cells.end(), kTetrahedra.begin(), kTetrahedra.end());
    expectBoth(load("both.vtk", legacy(kPoints, cells), LengthUnit::Millimeter));
    expectBoth(load("both.vtu", vtu(piece(kPoints, cells)), LengthUnit::Millimeter));
  }
}

TEST_F(SurfaceFile, OfAVolumeMeshHasNoWallWhereItsPartsHavePointsOfTheirOwn)
{
  std::vector<double> doubled = kPoints;
  doubled.insert(doubled.end(), { 0, 100, 0, -0.0, 0, 100, 100, 0, -0.0 });
  const std::vector<Cell> cells{ kTetrahedra[0], { kTetrahedron, { 7, 5, 6, 4 } } };
  expectBoth(load("doubled.vtk", legacy(doubled, cells), LengthUnit::Millimeter));
  expectBoth(load("doubled.vtu", vtu(piece(doubled, cells)), LengthUnit::Millimeter));
  expectBoth(
    load("pieces.vtu", vtu(piece(kPoints, { kTetrahedra[0] }) + piece(kPoints, { kTetrahedra[1] })),
      LengthUnit::Millimeter));
}

// as pieces of a parallel run have it, which repeat cells of their neighbors
TEST_F(SurfaceFile, OfAVolumeMeshTakesACellThatIsThereTwiceAsOne)
{
  expectBoth(load("pieces.vtu",
    vtu(piece(kPoints, kTetrahedra) + piece(kPoints, { kTetrahedra[1] })), LengthUnit::Millimeter));
}

// two that share but an edge, which is not a manifold, so that nothing else would turn them
TEST_F(SurfaceFile, OfAVolumeMeshFacesAwayFromItsCellsHoweverTheyAreTurned)
{
  const std::vector<double> points{ 0, 0, 0, 100, 0, 0, 0, 100, 0, 0, 0, 100, 0, -100, 0, 0, 0,
    -100 };
  for (const bool first : { false, true })
  {
    for (const bool second : { false, true })
    {
      const std::vector<Cell> cells{
        { kTetrahedron, first ? std::vector{ 1, 0, 2, 3 } : std::vector{ 0, 1, 2, 3 } },
        { kTetrahedron, second ? std::vector{ 1, 0, 4, 5 } : std::vector{ 0, 1, 4, 5 } }
      };
      const LoadedSurface surface =
        load("turned.vtk", legacy(points, cells), LengthUnit::Millimeter);
      EXPECT_FALSE(surface.closed);
      EXPECT_EQ(meshOf(surface).triangles.size(), 8u);
      EXPECT_NEAR(volume(meshOf(surface)), 0.1 * 0.1 * 0.1 / 6.0 * 2.0, 1e-9);
    }
  }
}

// a hexahedron whose far edges are one is a wedge, and a tetrahedron fits on its triangle
TEST_F(SurfaceFile, OfAVolumeMeshHasNoWallAtACollapsedFace)
{
  const std::vector<double> points{ 0, 0, 0, 100, 0, 0, 0, 100, 0, 0, 0, 100, 100, 0, 100, 0, 100,
    100, 0, 0, -100 };
  const LoadedSurface surface = load("wedge.vtk",
    legacy(
      points, { { kHexahedron, { 0, 1, 2, 2, 3, 4, 5, 5 } }, { kTetrahedron, { 0, 2, 1, 6 } } }),
    LengthUnit::Millimeter);
  EXPECT_TRUE(surface.closed);
  EXPECT_EQ(meshOf(surface).triangles.size(), 1u + 3u * 2u + 3u);
  EXPECT_NEAR(volume(meshOf(surface)), 0.1 * 0.1 * 0.1 * (1.0 / 2.0 + 1.0 / 6.0), 1e-9);
}

// each face in four pieces
TEST_F(SurfaceFile, OfACurvedCellGoesThroughThePointsOnItsEdges)
{
  const std::vector<double> points{ 0, 0, 0, 100, 0, 0, 0, 100, 0, 0, 0, 100, 50, 0, 0, 50, 50, 0,
    0, 50, 0, 0, 0, 50, 50, 0, 50, 0, 50, 50 };
  const LoadedSurface surface = load("curved.vtk",
    legacy(points, { { kQuadraticTetrahedron, { 0, 1, 2, 3, 4, 5, 6, 7, 8, 9 } } }),
    LengthUnit::Millimeter);
  EXPECT_TRUE(surface.closed);
  EXPECT_EQ(meshOf(surface).points.size(), 10u);
  EXPECT_EQ(meshOf(surface).triangles.size(), 16u);
  EXPECT_NEAR(volume(meshOf(surface)), 0.1 * 0.1 * 0.1 / 6.0, 1e-9);
}

TEST_F(SurfaceFile, OfCellsWithTooManyOrTooFewPointsIsRefusedByTheirNumber)
{
  for (const auto& [cell, words] :
    { std::pair{ Cell{ kTetrahedron, { 0, 1, 2, 3, 4 } }, "of 5 points, where its kind has 4" },
      { Cell{ kHexahedron, { 0, 1, 2, 3 } }, "of 4 points, where its kind has 8" },
      { Cell{ 99, { 0, 1, 2, 3 } }, "of kind 99, which is none of VTK's" } })
  {
    const std::string refusal = refusalOf(
      write("bad.vtk", legacy(kPoints, { kTetrahedra[0], cell })), LengthUnit::Millimeter);
    EXPECT_NE(refusal.find(words), std::string::npos) << refusal;
  }
}

} // namespace
} // namespace palp::test
