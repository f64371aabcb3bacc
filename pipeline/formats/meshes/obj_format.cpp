#include "pipeline/formats/meshes/surface_readers.h"

#include "haptics/error.h"
#include "haptics/files/input_text.h"
#include "pipeline/formats/meshes/stated_space.h"
#include "pipeline/formats/meshes/text_lines.h"

#include <algorithm>
#include <string>
#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

namespace palp
{
namespace
{

class ObjReader
{
public:
  explicit ObjReader(const std::filesystem::path& file)
    : file_(file.string())
    , lines_(file, '#')
  {
    points_->SetDataTypeToDouble();
  }

  vtkSmartPointer<vtkPolyData> read()
  {
    const std::string_view comments = commentsAtStart(lines_.behind());
    while (lines_.next())
    {
      const std::string_view key = lines_.word();
      if (key == "v")
      {
        double p[3];
        for (double& x : p)
        {
          x = lines_.number<double>("three coordinates");
        }
        points_->InsertNextPoint(p);
      }
      else if (key == "f")
      {
        readFace();
      }
    }
    const auto count = static_cast<long long>(points_->GetNumberOfPoints());
    if (count == 0)
    {
      throw Error(ErrorCode::BadFile,
        file_ + ": not an OBJ file, whatever its name, no vertex is in it; rename or convert it");
    }
    if (farthest_ > count) // a face may stand before its vertices
    {
      refuseIndex(farthest_, farthestLine_);
    }
    auto mesh = vtkSmartPointer<vtkPolyData>::New();
    mesh->SetPoints(points_);
    mesh->SetPolys(faces_);
    stateSpace(*mesh, comments);
    return mesh;
  }

private:
  static std::string_view commentsAtStart(std::string_view text)
  {
    std::size_t end = 0;
    while (end < text.size() && text[end] == '#')
    {
      end = std::min(text.find('\n', end), text.size() - 1) + 1;
    }
    return text.substr(0, end);
  }

  void readFace()
  {
    faces_->InsertNextCell(0);
    int corners = 0;
    while (!lines_.rest().empty())
    {
      const std::string_view text = lines_.word();
      if (text == "\\") // goes on in the next line
      {
        if (!lines_.next())
        {
          lines_.refuseEnd("the corners of a face");
        }
        continue;
      }
      faces_->InsertCellPoint(corner(text));
      ++corners;
    }
    if (corners < 3)
    {
      lines_.refuse("expected three corners of a face or more");
    }
    faces_->UpdateCellCount(corners);
  }

  vtkIdType corner(std::string_view text)
  {
    long long index = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, failure] = std::from_chars(text.data(), end, index);
    if (failure != std::errc{} || (stop != end && *stop != '/'))
    {
      lines_.refuse("expected the corners of a face, not " + inQuotes(text));
    }
    const auto count = static_cast<long long>(points_->GetNumberOfPoints());
    const long long number = index < 0 ? count + 1 + index : index;
    if (number < 1)
    {
      refuseIndex(index, lines_.line());
    }
    if (number > farthest_)
    {
      farthest_ = number;
      farthestLine_ = lines_.line();
    }
    return number - 1;
  }

  [[noreturn]] void refuseIndex(long long index, int line) const
  {
    throw Error(ErrorCode::BadFile,
      file_ + ":" + std::to_string(line) + ": a face refers to vertex " + std::to_string(index) +
        ", out of range (1 to " + std::to_string(points_->GetNumberOfPoints()) +
        "); export it again");
  }

  std::string file_;
  TextLines lines_;
  vtkNew<vtkPoints> points_;
  vtkNew<vtkCellArray> faces_;
  long long farthest_ = 0;
  int farthestLine_ = 0;
};

} // namespace

vtkSmartPointer<vtkPolyData> readObj(const std::filesystem::path& file)
{
  return ObjReader(file).read();
}

} // namespace palp
