#include "pipeline/formats/msh_format.h"

#include "haptics/files/input_text.h"
#include "pipeline/formats/meshes/refuse.h"
#include "pipeline/formats/meshes/whole_file.h"
#include "pipeline/formats/outer_surface.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>
#include <vtkCellType.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>

namespace palp
{
namespace
{

// an element, its nodes, and the cell that its first ones are the corners of
struct MshElement
{
  int nodes = 0;
  int cell = VTK_EMPTY_CELL; // lines and points, which bound nothing
  int corners = 0;
};

// by their numbers from 1
constexpr std::array kMshElements{ MshElement{ 2 }, MshElement{ 3, VTK_TRIANGLE, 3 },
  MshElement{ 4, VTK_QUAD, 4 }, MshElement{ 4, VTK_TETRA, 4 }, MshElement{ 8, VTK_HEXAHEDRON, 8 },
  MshElement{ 6, VTK_WEDGE, 6 }, MshElement{ 5, VTK_PYRAMID, 5 }, MshElement{ 3 },
  MshElement{ 6, VTK_TRIANGLE, 3 }, MshElement{ 9, VTK_QUAD, 4 }, MshElement{ 10, VTK_TETRA, 4 },
  MshElement{ 27, VTK_HEXAHEDRON, 8 }, MshElement{ 18, VTK_WEDGE, 6 },
  MshElement{ 14, VTK_PYRAMID, 5 }, MshElement{ 1 }, MshElement{ 8, VTK_QUAD, 4 },
  MshElement{ 20, VTK_HEXAHEDRON, 8 }, MshElement{ 15, VTK_WEDGE, 6 },
  MshElement{ 13, VTK_PYRAMID, 5 }, MshElement{ 9, VTK_TRIANGLE, 3 },
  MshElement{ 10, VTK_TRIANGLE, 3 }, MshElement{ 12, VTK_TRIANGLE, 3 },
  MshElement{ 15, VTK_TRIANGLE, 3 }, MshElement{ 15, VTK_TRIANGLE, 3 },
  MshElement{ 21, VTK_TRIANGLE, 3 }, MshElement{ 4 }, MshElement{ 5 }, MshElement{ 6 },
  MshElement{ 20, VTK_TETRA, 4 }, MshElement{ 35, VTK_TETRA, 4 }, MshElement{ 56, VTK_TETRA, 4 } };

class MshReader
{
public:
  explicit MshReader(const std::filesystem::path& file)
    : file_(file)
    , text_(wholeFile(file))
  {
    points_->SetDataTypeToDouble();
    grid_->Allocate();
  }

  vtkSmartPointer<vtkPolyData> read()
  {
    if (text_.starts_with("$NOD")) // of version 1
    {
      refuseVersion();
    }
    find("$MeshFormat");
    readFormat();
    find("$Nodes");
    isNew_ ? readNodeBlocks() : readNodes();
    find("$Elements");
    isNew_ ? readElementBlocks() : readElements();
    find("$EndElements");
    grid_->SetPoints(points_);
    return outerSurface(*grid_, file_.string());
  }

private:
  [[noreturn]] void refuseCut() const
  {
    refuse(file_, "cut off, or it counts more than it holds; export or copy it again");
  }

  [[noreturn]] void refuseVersion() const
  {
    refuse(
      file_, "of a version that is not read here; save it by gmsh -save -format msh41, or as .vtk");
  }

  // goes behind the line of a section
  void find(std::string_view section)
  {
    const std::size_t found = text_.find(section, at_);
    if (found == text_.npos)
    {
      section == "$MeshFormat"
        ? refuse(file_, "not an MSH file, whatever its name; rename or convert it")
        : refuse(file_, "cut off, " + std::string(section) + " is missing; export it again");
    }
    at_ = std::min(text_.find('\n', found), text_.size() - 1) + 1;
  }

  void readFormat()
  {
    const double version = number<double>();
    isBinary_ = number<int>() != 0;
    const int size = number<int>();
    isNew_ = version == 4.1;
    if ((version != 2.2 && version != 4.1) || size != 8)
    {
      refuseVersion();
    }
    at_ = std::min(text_.find('\n', at_), text_.size() - 1) + 1;
    if (isBinary_) // followed by a 1, in the order of bytes of the machine that wrote it
    {
      constexpr int kSwappedOne = 1 << 24;
      const int one = value<int>();
      isSwapped_ = one == kSwappedOne;
      if (one != 1 && !isSwapped_)
      {
        refuse(file_, "damaged, it tells no order of bytes; export it again");
      }
    }
  }

  // in text
  template <typename Number>
  Number number()
  {
    constexpr std::string_view blanks = " \t\r\n";
    at_ = std::min(text_.find_first_not_of(blanks, at_), text_.size());
    Number result{};
    const char* const end = text_.data() + text_.size();
    const auto [stop, failure] = std::from_chars(text_.data() + at_, end, result);
    if (stop == end || at_ == text_.size())
    {
      refuseCut();
    }
    if (failure != std::errc{} || blanks.find(*stop) == blanks.npos)
    {
      refuse(file_,
        "damaged: expected a number, not " +
          inQuotes(std::string_view(text_).substr(at_, text_.find_first_of(blanks, at_) - at_)) +
          "; export it again");
    }
    at_ = static_cast<std::size_t>(stop - text_.data());
    return result;
  }

  // of bytes
  template <typename Number>
  Number value()
  {
    if (text_.size() - at_ < sizeof(Number))
    {
      refuseCut();
    }
    std::array<char, sizeof(Number)> bytes{};
    std::copy_n(text_.data() + at_, bytes.size(), bytes.begin());
    at_ += bytes.size();
    if (isSwapped_)
    {
      std::ranges::reverse(bytes);
    }
    return std::bit_cast<Number>(bytes);
  }

  template <typename Stored>
  std::int64_t integer()
  {
    return isBinary_ ? static_cast<std::int64_t>(value<Stored>()) : number<std::int64_t>();
  }

  // of things that take a byte each at least
  std::int64_t count(std::int64_t given) const
  {
    if (given < 0 || static_cast<std::size_t>(given) > text_.size() - at_)
    {
      refuseCut();
    }
    return given;
  }

  // the number before a section of the older form, which stands in text
  std::int64_t countLine()
  {
    const auto given = count(number<std::int64_t>());
    at_ = std::min(text_.find('\n', at_), text_.size() - 1) + 1;
    return given;
  }

  double coordinate()
  {
    return isBinary_ ? value<double>() : number<double>();
  }

  // parameters: of its place on a line or face of the model, behind it
  void addNode(std::int64_t tag, int parameters = 0)
  {
    std::array<double, 3> p{};
    std::ranges::generate(p, [this] { return coordinate(); });
    for (; parameters > 0; --parameters)
    {
      (void)coordinate();
    }
    places_[tag] = points_->InsertNextPoint(p.data());
  }

  template <typename Stored>
  void addElement(const MshElement& element)
  {
    std::array<vtkIdType, 8> corners{};
    for (int i = 0; i < element.nodes; ++i)
    {
      const auto node = places_.find(integer<Stored>());
      if (node == places_.end())
      {
        refuse(file_, "an element refers to a node that is not there; export it again");
      }
      if (i < element.corners)
      {
        corners[static_cast<std::size_t>(i)] = node->second;
      }
    }
    if (element.cell != VTK_EMPTY_CELL)
    {
      grid_->InsertNextCell(element.cell, element.corners, corners.data());
    }
  }

  const MshElement& element(std::int64_t type) const
  {
    if (type < 1 || static_cast<std::size_t>(type) > kMshElements.size())
    {
      refuse(file_,
        "has elements of type " + std::to_string(type) +
          ", which is not read here; save it with first order elements");
    }
    return kMshElements[static_cast<std::size_t>(type - 1)];
  }

  void readNodes()
  {
    for (std::int64_t left = countLine(); left > 0; --left)
    {
      addNode(integer<int>());
    }
  }

  void readElements()
  {
    std::int64_t left = countLine();
    while (left > 0)
    {
      if (!isBinary_)
      {
        (void)integer<int>(); // its tag
      }
      const MshElement& kind = element(integer<int>());
      const std::int64_t many = isBinary_ ? count(integer<int>()) : 1;
      const std::int64_t tags = count(integer<int>());
      for (std::int64_t i = 0; i < many; ++i)
      {
        for (std::int64_t k = isBinary_ ? -1 : 0; k < tags; ++k)
        {
          (void)integer<int>();
        }
        addElement<int>(kind);
      }
      left -= std::max<std::int64_t>(many, 1);
    }
  }

  void readNodeBlocks()
  {
    std::int64_t blocks = count(integer<std::size_t>());
    for (int i = 0; i < 3; ++i)
    {
      (void)integer<std::size_t>();
    }
    for (; blocks > 0; --blocks)
    {
      const auto dimension = static_cast<int>(integer<int>());
      (void)integer<int>(); // tag of the entity
      const int parameters = integer<int>() != 0 ? std::clamp(dimension, 0, 3) : 0;
      std::vector<std::int64_t> tags(static_cast<std::size_t>(count(integer<std::size_t>())));
      std::ranges::generate(tags, [this] { return integer<std::size_t>(); });
      std::ranges::for_each(tags, [&](std::int64_t tag) { addNode(tag, parameters); });
    }
  }

  void readElementBlocks()
  {
    std::int64_t blocks = count(integer<std::size_t>());
    for (int i = 0; i < 3; ++i)
    {
      (void)integer<std::size_t>();
    }
    for (; blocks > 0; --blocks)
    {
      (void)integer<int>();
      (void)integer<int>();
      const MshElement& kind = element(integer<int>());
      for (std::int64_t left = count(integer<std::size_t>()); left > 0; --left)
      {
        (void)integer<std::size_t>(); // its tag
        addElement<std::size_t>(kind);
      }
    }
  }

  std::filesystem::path file_;
  std::string text_;
  std::size_t at_ = 0;
  bool isBinary_ = false;
  bool isSwapped_ = false;
  bool isNew_ = false;
  std::unordered_map<std::int64_t, vtkIdType> places_;
  vtkNew<vtkPoints> points_;
  vtkNew<vtkUnstructuredGrid> grid_;
};

} // namespace

vtkSmartPointer<vtkPolyData> readMsh(const std::filesystem::path& file)
{
  return MshReader(file).read();
}

} // namespace palp
