#include "tests/pipeline/formats/fuzzed_parts.h"
#include "tests/pipeline/formats/msh_text.h"

#include "tests/pipeline/sample_files.h"

#include <algorithm>
#include <iterator>
#include <vtkPLYWriter.h>
#include <vtkPolyData.h>
#include <vtkPolyDataWriter.h>
#include <vtkSTLWriter.h>
#include <vtkXMLPolyDataWriter.h>

namespace palp::test
{
namespace
{

std::vector<Fuzzed> stlKinds()
{
  const auto data = ballData();
  const std::string text = written<vtkSTLWriter>("a.stl", *data, [](auto&) {});
  const std::string binary =
    written<vtkSTLWriter>("a.stl", *data, [](auto& w) { w.SetFileTypeToBinary(); });
  return { surface("text.stl", { text },
             { cutOff(kCut, 120), replaced("no number", "(vertex )[^ ]*", "$1nan", kNumber),
               replaced("a word for a number", "(vertex )[^ ]*", "$01.2.3", kNumber),
               foreign(offText(), kKind) }),
    surface("binary.stl", { binary },
      { cutOff(kCut, 90), overwritten("NaN", 96, 50, 80, bytesOf(kNan), kNumber),
        overwritten("infinite", 104, 50, 80, bytesOf(1e30F), kNumber),
        overwritten("count", 80, 4, 1, bytesOf(100'000), kCount),
        foreign(voxelBytes(), "not an STL|no STL") }) };
}

std::vector<Fuzzed> textKinds()
{
  const std::string obj = ballText("# a ball\n", "v ", "f ", 1);
  return { surface("ball.obj", { obj },
             { replaced("NaN", "(v )[^ ]*", "$1nan", kNumber),
               replaced("a word", "(v [^ ]* )[^ ]*", "$1x1", kNumber),
               replaced("index", "(f )[0-9]+", "$019999", kIndex),
               replaced("index zero", "(f )[0-9]+", "$010", kIndex + "|counts from 1"),
               replaced("index below", "(f )[0-9]+", "$01-9999", kIndex),
               replaced("a word for a corner", "(f )[0-9]+", "$01x", "corner"),
               foreign(offText(), kKind) }),
    surface("ball.off", { offText() },
      { cutOff(kCut, 20),
        replaced("NaN", "(\n)[^ ]*( [^ ]* [^ ]*\n)", "$1nan$2", kNumber + "|expected"),
        replaced("index", "(\n3 )[0-9]+", "$019999", kIndex),
        replaced("index below", "(\n3 )[0-9]+", "$01-1", kIndex),
        replaced("count", "^(OFF\n)[0-9]+", "$019999", kCount + "|expected"),
        replaced("few points", "^(OFF\n)[0-9]+", "$0140", kIndex + "|expected"),
        replaced("corners", "(\n)3( [0-9]+ [0-9]+ [0-9]+)", "$019$2", "corners"),
        foreign(obj, kKind) }) };
}

std::vector<Fuzzed> plyKinds()
{
  const auto data = ballData();
  const std::string text =
    written<vtkPLYWriter>("a.ply", *data, [](auto& w) { w.SetFileTypeToASCII(); });
  const std::string binary =
    written<vtkPLYWriter>("a.ply", *data, [](auto& w) { w.SetFileTypeToBinary(); });
  const std::size_t begin = binary.find("end_header") + 11;
  const std::size_t faces = begin + 12 * ball().points.size();
  const std::vector<Fault> header{ cutOff(kCut, 10),
    replaced("count of points", "(element vertex )[0-9]+", "$019999", kCount),
    replaced("count of faces", "(element face )[0-9]+", "$019999", kCount),
    replaced("type", "(property )float", "$1real", "property|type|header"),
    replaced("format", "(format )[a-z_]+", "$1asci", "format|header"), foreign(offText(), kKind) };
  std::vector<Fault> ofText = header;
  ofText.push_back(replaced("NaN", "(\n)-?[0-9.]+( -?[0-9.]+ -?[0-9.]+ ?\n)", "$1nan$2", kNumber));
  ofText.push_back(replaced("index", "(\n3 )[0-9]+", "$019999", kIndex));
  ofText.push_back(replaced("index below", "(\n3 )[0-9]+", "$01-1", kIndex));
  ofText.push_back(replaced("corners", "(\n)3( [0-9]+ [0-9]+ [0-9]+)", "$019$2", "corners"));
  std::vector<Fault> ofBinary = header;
  ofBinary.push_back(overwritten("NaN", begin, 12, 42, bytesOf(kNan), kNumber));
  ofBinary.push_back(overwritten("index", faces + 1, 13, 80, bytesOf(9999), kIndex));
  ofBinary.push_back(overwritten("index below", faces + 5, 13, 80, bytesOf(-1), kIndex));
  ofBinary.push_back(overwritten("corners", faces, 13, 80, "\xC8", kCount + "|corners"));
  return { surface("text.ply", { text }, ofText), surface("binary.ply", { binary }, ofBinary) };
}

std::vector<Fuzzed> vtkKinds()
{
  const auto data = ballData();
  const std::string legacy = written<vtkPolyDataWriter>("a.vtk", *data, [](auto&) {});
  const std::string legacyBinary =
    written<vtkPolyDataWriter>("a.vtk", *data, [](auto& w) { w.SetFileTypeToBinary(); });
  const std::string older = ballText(
    "# vtk DataFile Version 3.0\nball\nASCII\nDATASET POLYDATA\nPOINTS 42 float\n", "", "3 ", 0);
  const std::size_t after = older.find("\n3 ") + 1; // no point begins so
  const std::string old = std::string(older).insert(after, "POLYGONS 80 320\n");
  const auto xml = [&](auto set) { return written<vtkXMLPolyDataWriter>("a.vtp", *data, set); };
  const std::string ascii = xml([](auto& w) { w.SetDataModeToAscii(); });
  const std::string index = kIndex + "|connectivity";
  return { surface("ball.vtk", { legacy, legacyBinary, old },
             { cutOff(kCut, 60), replaced("count of points", "(POINTS )[0-9]+", "$019999", kCount),
               replaced("keyword", "DATASET [A-Z]+", "DATASET POLYDOTO", "[Dd]ata ?set|DATASET"),
               replaced("version", "^# vtk", "# vkt", kKind),
               replaced("type", "(POINTS [0-9]+ )[a-z]+", "$1real", "type|real"),
               foreign(offText(), kKind) }),
    surface("ball.vtp",
      { ascii, xml([](auto& w) { w.SetDataModeToBinary(); }),
        xml([](auto& w) { w.SetDataModeToAppended(); }),
        xml([](auto& w) { w.SetCompressorTypeToNone(); }) },
      { cutOff(kCut, 40),
        replaced("count of points", "(NumberOfPoints=\")[0-9]+", "$019999", kCount),
        replaced("count of polygons", "(NumberOfPolys=\")[0-9]+", "$019999", kCount),
        replaced("tag", "</Points>", "</Pints>", "tag|XML|mismatch"),
        replaced(
          "kind", "type=\"PolyData\"", "type=\"UnstructuredGrid\"", "PolyData|not a VTP", false),
        foreign(offText(), kKind) }),
    surface("text.vtp", { ascii },
      { replaced("index", "( )[0-9]+( [0-9]+ [0-9]+ [0-9]+ [0-9]+ [0-9]+\n *[0-9]+ [0-9]+ )",
          "$019999$2", index),
        replaced("NaN", R"((NumberOfComponents="3"[^>]*>\s*)[^ ]+)", "$1nan", kNumber) }),
    surface("tetra.vtu", { kTetraVtu },
      { cutOff(kCut, 40),
        replaced("count of points", "(NumberOfPoints=\")[0-9]+", "$019999", kCount),
        replaced("count of cells", "(NumberOfCells=\")[0-9]+", "$019999", kCount),
        replaced("index", "2 3 4<", "2 3 9<", index),
        replaced("index below", "2 3 4<", "2 3 -1<", index),
        replaced("NaN", "100 0 0", "100 nan 0", kNumber),
        replaced("tag", "</Points>", "</Pints>", "tag|XML|mismatch"),
        foreign(offText(), kKind) }) };
}

std::vector<Fuzzed> mshKinds()
{
  MshBlock block;
  return { surface("block.msh",
    { block.write(2.2, false), block.write(2.2, true), block.write(4.1, false),
      block.write(4.1, true), block.write(4.1, true, true, 2) },
    { cutOff("cut off", 14), replaced("version", "(MeshFormat\n)[24]", "$019", "version"),
      replaced("count of nodes", "(Nodes\n)[0-9]+", "$01999999999", kCount),
      replaced("section", "\\$Elements", "$Nothing", "missing"), foreign(offText(), kKind) }) };
}

} // namespace

std::vector<FuzzedGroup> fuzzedMeshes()
{
  return { { { "text.stl", "binary.stl" }, stlKinds }, { { "ball.obj", "ball.off" }, textKinds },
    { { "text.ply", "binary.ply" }, plyKinds },
    { { "ball.vtk", "ball.vtp", "text.vtp", "tetra.vtu" }, vtkKinds },
    { { "block.msh" }, mshKinds } };
}

} // namespace palp::test
