#include "pipeline/formats/meshes/surface_readers.h"

#include "haptics/error.h"
#include "haptics/files/input_text.h"
#include "pipeline/formats/meshes/refuse.h"
#include "pipeline/formats/meshes/stated_space.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <numeric>
#include <string>
#include <string_view>
#include <vtkCellArray.h>
#include <vtkIdTypeArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

namespace palp
{
namespace
{

// words of a text in small letters, with the line of the last
class Words
{
public:
  explicit Words(const std::filesystem::path& file)
    : in_(file, std::ios::binary)
  {
  }

  // false at the end
  bool next(std::string& word)
  {
    word.clear();
    constexpr std::size_t most = 4096; // no word of an STL
    for (int c = in_.get(); c != std::char_traits<char>::eof() && word.size() < most; c = in_.get())
    {
      line_ += c == '\n';
      if (std::isspace(c) == 0)
      {
        word += static_cast<char>(std::tolower(c));
      }
      else if (!word.empty())
      {
        break;
      }
    }
    return !word.empty();
  }

  // the file ends with the last word, which may not be whole
  [[nodiscard]] bool atEnd() const
  {
    return in_.eof();
  }

  [[nodiscard]] std::string position(const std::filesystem::path& file) const
  {
    return file.string() + ":" + std::to_string(line_);
  }

private:
  std::ifstream in_;
  int line_ = 1;
};

// of one coordinate; 0 where the file ends in it
double readCoordinate(Words& words, const std::filesystem::path& file)
{
  std::string word;
  double x = 0.0;
  const bool more = words.next(word);
  const char* begin = word.data() + (word.starts_with('+') ? 1 : 0);
  const auto [end, failure] = std::from_chars(begin, word.data() + word.size(), x);
  if (more && !words.atEnd() &&
    (failure != std::errc{} || end != word.data() + word.size() || !std::isfinite(x)))
  {
    throw Error(ErrorCode::BadMesh,
      words.position(file) + ": " + inQuotes(word) +
        " is not a usable number; repair or export the surface again");
  }
  return x;
}

vtkSmartPointer<vtkPolyData> readText(const std::filesystem::path& file)
{
  Words words(file);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> triangles;
  bool ended = false;
  bool facets = false;
  vtkIdType corners = 0; // of the facet that is open
  for (std::string word; words.next(word);)
  {
    ended = word == "endsolid" || (ended && word != "facet");
    facets = facets || word == "facet";
    if (word == "end") // some write "end solid"
    {
      ended = words.next(word) && word == "solid";
    }
    if (word == "facet")
    {
      corners = 0;
    }
    if (word == "vertex" && facets && !ended)
    {
      double p[3];
      for (double& x : p)
      {
        x = readCoordinate(words, file);
      }
      points->InsertNextPoint(p);
      ++corners;
    }
    if (word == "endloop")
    {
      if (corners < 3)
      {
        refuse(file,
          "its facet " + std::to_string(triangles->GetNumberOfCells() + 1) + " has " +
            counted(static_cast<std::size_t>(corners), "vertex", "vertices") +
            "; export the surface again");
      }
      const vtkIdType first = points->GetNumberOfPoints() - corners;
      triangles->InsertNextCell(static_cast<int>(corners));
      for (vtkIdType k = 0; k < corners; ++k)
      {
        triangles->InsertCellPoint(first + k);
      }
    }
  }
  if (!facets && !ended)
  {
    refuse(file, "not an STL file, whatever its name; rename or convert it");
  }
  if (!ended)
  {
    refuse(file,
      "cut off, it ends without endsolid behind " + std::to_string(triangles->GetNumberOfCells()) +
        " triangles; export or copy it again");
  }
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->SetPoints(points);
  mesh->SetPolys(triangles);
  return mesh;
}

constexpr std::size_t kHeader = 84; // [bytes], the last four are the number of triangles
constexpr std::size_t kFacet = 50;  // [bytes]
constexpr std::size_t kCorners = 9; // coordinates of a facet

vtkSmartPointer<vtkPolyData> readBinary(const std::filesystem::path& file, std::uint32_t count)
{
  std::ifstream in(file, std::ios::binary);
  in.seekg(kHeader);
  vtkNew<vtkPoints> points; // single precision, as the file's
  points->SetNumberOfPoints(3 * static_cast<vtkIdType>(count));
  auto* coordinates = static_cast<float*>(points->GetVoidPointer(0));
  std::string facets;
  for (std::size_t left = count; left > 0;)
  {
    constexpr std::size_t kAtOnce = 4096;
    const std::size_t next = std::min(left, kAtOnce);
    facets.resize(next * kFacet);
    in.read(facets.data(), static_cast<std::streamsize>(facets.size()));
    for (std::size_t i = 0; i < next; ++i, coordinates += kCorners)
    {
      constexpr std::size_t normal = 3 * sizeof(float);
      std::memcpy(coordinates, facets.data() + i * kFacet + normal, kCorners * sizeof(float));
    }
    left -= next;
  }
  vtkNew<vtkIdTypeArray> corners;
  corners->SetNumberOfValues(points->GetNumberOfPoints());
  std::iota(corners->Begin(), corners->End(), 0);
  vtkNew<vtkCellArray> triangles;
  triangles->SetData(3, corners);
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->SetPoints(points);
  mesh->SetPolys(triangles);
  return mesh;
}

// "solid" in any letters, behind blanks or a mark of UTF-8
bool beginsSolid(std::string_view start)
{
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  start.remove_prefix(start.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0);
  start.remove_prefix(std::min(start.find_first_not_of(" \t\r\n"), start.size()));
  constexpr std::string_view solid = "solid";
  return start.size() >= solid.size() &&
    std::equal(solid.begin(), solid.end(), start.begin(),
      [](char a, char b)
      { return a == static_cast<char>(std::tolower(static_cast<unsigned char>(b))); });
}

} // namespace

vtkSmartPointer<vtkPolyData> readStl(const std::filesystem::path& file)
{
  const std::size_t size = std::filesystem::file_size(file);
  std::string start(std::min<std::size_t>(size, 512), '\0');
  std::ifstream(file, std::ios::binary)
    .read(start.data(), static_cast<std::streamsize>(start.size()));
  if (start.starts_with("\xFF\xFE") || start.starts_with("\xFE\xFF"))
  {
    refuse(file, "text in UTF-16; save it as UTF-8 or export the surface again");
  }
  std::uint32_t count = 0;
  if (size >= kHeader)
  {
    std::memcpy(&count, start.data() + kHeader - sizeof count, sizeof count);
  }
  // a binary header may say solid as well: its count tells
  const bool fits = size >= kHeader && size - kHeader == kFacet * static_cast<std::size_t>(count);
  const bool text =
    std::ranges::all_of(start, [](unsigned char c) { return c >= ' ' || std::isspace(c) != 0; });
  if (!fits && (text || (beginsSolid(start) && start.find('\0') == start.npos)))
  {
    auto mesh = readText(file);
    stateSpace(*mesh, std::string_view(start).substr(0, start.find_first_of("\r\n")));
    return mesh;
  }
  if (size < kHeader + kFacet)
  {
    refuse(file, "too short for a binary STL file; export the surface again");
  }
  const std::size_t held = (size - kHeader) / kFacet;
  if (held < count)
  {
    refuse(file,
      "cut off, it holds " + std::to_string(held) + " of " + std::to_string(count) +
        " triangles, or no STL file; export or copy it again");
  }
  if (held > count)
  {
    refuse(file,
      "it holds " + std::to_string(held) + " triangles where its header counts " +
        std::to_string(count) + "; export it again");
  }
  auto mesh = readBinary(file, count);
  stateSpace(*mesh, std::string_view(start).substr(0, kHeader - sizeof count));
  return mesh;
}

} // namespace palp
