#include "pipeline/formats/meshes/surface_readers.h"

#include "haptics/error.h"
#include "haptics/files/input_text.h"
#include "pipeline/formats/meshes/text_lines.h"

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>
#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

namespace palp
{
namespace
{

// the keyword, which may share its line with the counts; texture, colors and
// normals of points are skipped
void readKeyword(TextLines& lines)
{
  std::string word(lines.word());
  std::ranges::transform(
    word, word.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  std::string_view kind = word;
  for (const std::string_view prefix : { "ST", "C", "N" })
  {
    kind.remove_prefix(kind.starts_with(prefix) ? prefix.size() : 0);
  }
  if (kind == "4OFF" || kind == "NOFF" || kind == "4NOFF")
  {
    lines.refuse("expected points of three coordinates, not of other dimensions");
  }
  if (kind != "OFF")
  {
    lines.refuse("expected OFF, COFF, NOFF, STOFF or what is made of these");
  }
  if (lines.rest().starts_with("BINARY"))
  {
    lines.refuse("expected an OFF file in text form");
  }
}

void refuseMore(TextLines& lines, int faceCount)
{
  if (lines.next())
  {
    lines.refuse(
      "the file goes on behind the " + std::to_string(faceCount) + " faces that its head counts");
  }
}

} // namespace

vtkSmartPointer<vtkPolyData> readOff(const std::filesystem::path& file)
{
  TextLines lines(file, '#');
  const auto next = [&](const char* before)
  {
    if (!lines.next())
    {
      lines.refuseEnd(before);
    }
  };
  next("the word OFF");
  readKeyword(lines);
  if (lines.rest().empty())
  {
    next("the numbers of points and faces");
  }
  const int pointCount = lines.number<int>("the number of points");
  const int faceCount = lines.number<int>("the number of faces");

  // nothing is reserved: the counts may be wrong
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (int i = 0; i < pointCount; ++i)
  {
    next("the last point; each stands in a line of its own");
    double p[3];
    for (double& coordinate : p)
    {
      coordinate = lines.number<double>("three coordinates");
    }
    points->InsertNextPoint(p);
  }
  vtkNew<vtkCellArray> faces;
  for (int i = 0; i < faceCount; ++i)
  {
    next("the last face; each stands in a line of its own");
    const int corners = lines.number<int>("the number of corners of a face");
    corners < 0 ? lines.refuse("a face has " + std::to_string(corners) + " corners") : void();
    if (corners < 3)
    {
      continue; // a point or a line
    }
    faces->InsertNextCell(0);
    for (int k = 0; k < corners; ++k)
    {
      const int corner = lines.number<int>("the corners of a face");
      if (corner < 0 || corner >= pointCount)
      {
        lines.refuse("a face refers to vertex " + std::to_string(corner) + ", out of range (0 to " +
          std::to_string(pointCount - 1) + ")");
      }
      faces->InsertCellPoint(corner);
    }
    faces->UpdateCellCount(corners);
  }
  refuseMore(lines, faceCount);
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->SetPoints(points);
  mesh->SetPolys(faces);
  return mesh;
}

} // namespace palp
