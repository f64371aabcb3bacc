#pragma once

namespace palp::test
{

/// A corner cut off a cube, 100 mm along each axis, written by hand.
inline constexpr const char* kStl = R"(solid corner
facet normal 0 0 -1
outer loop
vertex 0 0 0
vertex 0 100 0
vertex 100 0 0
endloop
endfacet
facet normal 0 -1 0
outer loop
vertex 0 0 0
vertex 100 0 0
vertex 0 0 100
endloop
endfacet
facet normal -1 0 0
outer loop
vertex 0 0 0
vertex 0 0 100
vertex 0 100 0
endloop
endfacet
facet normal 0.577 0.577 0.577
outer loop
vertex 100 0 0
vertex 0 100 0
vertex 0 0 100
endloop
endfacet
endsolid corner
)";
inline constexpr const char* kObj = R"(# corner
v 0 0 0
v 100 0 0
v 0 100 0
v 0 0 100
f 1 3 2
f 1 2 4
f 1 4 3
f 2 3 4
)";
inline constexpr const char* kPly = R"(ply
format ascii 1.0
comment corner
element vertex 4
property float x
property float y
property float z
element face 4
property list uchar int vertex_indices
end_header
0 0 0
100 0 0
0 100 0
0 0 100
3 0 2 1
3 0 1 3
3 0 3 2
3 1 2 3
)";
inline constexpr const char* kOff = R"(OFF
# corner
4 4 6

0 0 0
1e2 0 0
0 1.0e+2 0
0 0 100   # with colors
3 0 2 1  255 0 0
3 0 1 3
3 0 3 2
3 1 2 3
)";
inline constexpr const char* kVtk = R"(# vtk DataFile Version 3.0
corner
ASCII
DATASET POLYDATA
POINTS 4 float
0 0 0 100 0 0 0 100 0 0 0 100
POLYGONS 4 16
3 0 2 1
3 0 1 3
3 0 3 2
3 1 2 3
)";
inline constexpr const char* kVtp = R"(<?xml version="1.0"?>
<VTKFile type="PolyData" version="0.1" byte_order="LittleEndian"><PolyData>
<Piece NumberOfPoints="4" NumberOfPolys="4">
<Points><DataArray type="Float32" NumberOfComponents="3" format="ascii">
0 0 0 100 0 0 0 100 0 0 0 100</DataArray></Points>
<Polys><DataArray type="Int32" Name="connectivity" format="ascii">
0 2 1 0 1 3 0 3 2 1 2 3</DataArray>
<DataArray type="Int32" Name="offsets" format="ascii">3 6 9 12</DataArray></Polys>
</Piece></PolyData></VTKFile>
)";

/// Two tetrahedra with one face in common.
inline constexpr const char* kTetraVtu = R"(<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian"><UnstructuredGrid>
<Piece NumberOfPoints="5" NumberOfCells="2">
<Points><DataArray type="Float32" NumberOfComponents="3" format="ascii">
0 0 0 100 0 0 0 100 0 0 0 100 100 100 100</DataArray></Points>
<Cells><DataArray type="Int32" Name="connectivity" format="ascii">0 1 2 3 1 2 3 4</DataArray>
<DataArray type="Int32" Name="offsets" format="ascii">4 8</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">10 10</DataArray></Cells>
</Piece></UnstructuredGrid></VTKFile>
)";

} // namespace palp::test
