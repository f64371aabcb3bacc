#include "pipeline/formats/off_format.h"

#include "haptics/error.h"

#include <charconv>
#include <fstream>
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

// lines that hold something, and the numbers in them
class OffLines
{
public:
  explicit OffLines(const std::filesystem::path& file)
    : file_(file.string())
    , in_(file)
  {
  }

  // what: the line that is expected, for the message
  void next(const char* what)
  {
    do
    {
      if (!std::getline(in_, line_))
      {
        throw Error(ErrorCode::BadFile,
          file_ + ": ends after line " + std::to_string(number_) + ", before " + what +
            "; export or copy it again");
      }
      ++number_;
      rest_ = std::string_view(line_).substr(0, line_.find('#'));
      skipBlanks();
    } while (rest_.empty());
  }

  template <typename Number>
  Number number(const char* what)
  {
    Number value{};
    skipBlanks();
    const auto [end, failure] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
    if (failure != std::errc{})
    {
      refuse(what);
    }
    rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
    return value;
  }

  // the keyword OFF may share its line with the counts
  void keyword()
  {
    const std::string_view word = rest_.substr(0, rest_.find_first_of(" \t\r"));
    if (word != "OFF" && word != "COFF" && word != "NOFF" && word != "CNOFF")
    {
      refuse("OFF, COFF, NOFF or CNOFF");
    }
    rest_.remove_prefix(word.size());
    skipBlanks();
    if (rest_.starts_with("BINARY"))
    {
      refuse("an OFF file in text form");
    }
    if (rest_.empty())
    {
      next("the numbers of points and faces");
    }
  }

  [[noreturn]] void refuse(const char* what) const
  {
    throw Error(ErrorCode::BadFile,
      file_ + ":" + std::to_string(number_) + ": expected " + what + "; export it again");
  }

private:
  void skipBlanks()
  {
    rest_.remove_prefix(std::min(rest_.find_first_not_of(" \t\r"), rest_.size()));
  }

  std::string file_;
  std::ifstream in_;
  std::string line_;
  std::string_view rest_;
  int number_ = 0;
};

} // namespace

vtkSmartPointer<vtkPolyData> readOff(const std::filesystem::path& file)
{
  OffLines lines(file);
  lines.next("the word OFF");
  lines.keyword();
  const int pointCount = lines.number<int>("the number of points");
  const int faceCount = lines.number<int>("the number of faces");

  // nothing is reserved: the counts may be wrong
  vtkNew<vtkPoints> points;
  for (int i = 0; i < pointCount; ++i)
  {
    lines.next("the last point");
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
    lines.next("the last face");
    const int corners = lines.number<int>("the number of corners of a face");
    if (corners < 3)
    {
      continue; // a point or a line
    }
    faces->InsertNextCell(corners);
    for (int k = 0; k < corners; ++k)
    {
      faces->InsertCellPoint(lines.number<int>("the corners of a face"));
    }
  }
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->SetPoints(points);
  mesh->SetPolys(faces);
  return mesh;
}

} // namespace palp
