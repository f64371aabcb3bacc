#include "pipeline/formats/meshes/surface_readers.h"

#include "haptics/error.h"
#include "haptics/files/input_text.h"
#include "pipeline/formats/meshes/stated_space.h"
#include "pipeline/formats/meshes/text_lines.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>
#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

namespace palp
{
namespace
{

struct Type
{
  const char* name;
  const char* other;
  std::size_t size;                    // [bytes]
  double (*value)(const char* native); // of its bytes in the order of this machine
};

template <typename Number>
double valueOf(const char* native)
{
  Number number;
  std::memcpy(&number, native, sizeof number);
  return static_cast<double>(number);
}

constexpr std::array kTypes{ Type{ "char", "int8", 1, valueOf<std::int8_t> },
  Type{ "uchar", "uint8", 1, valueOf<std::uint8_t> },
  Type{ "short", "int16", 2, valueOf<std::int16_t> },
  Type{ "ushort", "uint16", 2, valueOf<std::uint16_t> },
  Type{ "int", "int32", 4, valueOf<std::int32_t> },
  Type{ "uint", "uint32", 4, valueOf<std::uint32_t> },
  Type{ "float", "float32", 4, valueOf<float> }, Type{ "double", "float64", 8, valueOf<double> } };

struct Property
{
  std::string name;
  const Type* count = nullptr; // of a list; null: a single number
  const Type* type = nullptr;
};

struct Element
{
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties{};
};

enum class Coding
{
  Text,
  LittleEndian,
  BigEndian,
};

class PlyReader
{
public:
  explicit PlyReader(const std::filesystem::path& file)
    : lines_(file)
  {
    points_->SetDataTypeToDouble();
  }

  vtkSmartPointer<vtkPolyData> read()
  {
    readHeader();
    body_ = lines_.behind();
    for (const Element& element : elements_)
    {
      for (at_ = 1; at_ <= element.count; ++at_)
      {
        readOne(element);
      }
    }
    refuseMore();
    if (farthest_ >= static_cast<double>(points_->GetNumberOfPoints()))
    {
      refuseIndex(farthest_, farthestFace_); // faces may stand before vertices
    }
    auto mesh = vtkSmartPointer<vtkPolyData>::New();
    mesh->SetPoints(points_);
    mesh->SetPolys(faces_);
    stateSpace(*mesh, comments_);
    return mesh;
  }

private:
  // ---- header

  void readHeader()
  {
    for (bool first = true;; first = false)
    {
      if (!lines_.next())
      {
        lines_.refuseEnd("the end of its header");
      }
      const std::string_view key = lines_.word();
      if (key == "end_header")
      {
        break;
      }
      if (key == "format")
      {
        readFormat();
      }
      else if (key == "element")
      {
        Element element{ .name = std::string(lines_.word()) };
        element.count = lines_.number<std::uint64_t>("the number of its elements");
        elements_.push_back(element);
      }
      else if (key == "property")
      {
        readProperty();
      }
      else if (key == "comment")
      {
        comments_.append(lines_.rest()).append("\n");
      }
      else if (!first && key != "obj_info")
      {
        refuseHeader("its header is damaged, " + inQuotes(key) + " is no word of it");
      }
    }
    formatted_ ? void() : refuseHeader("its header names no format");
    const auto vertex = std::ranges::find(elements_, "vertex", &Element::name);
    for (const std::string axis : { "x", "y", "z" })
    {
      const bool lacks = vertex != elements_.end() &&
        std::ranges::count(vertex->properties, axis, &Property::name) == 0;
      lacks ? refuseHeader("its vertices have no " + axis) : void();
    }
  }

  void readFormat()
  {
    const std::string_view word = lines_.word();
    if (word != "ascii" && word != "binary_little_endian" && word != "binary_big_endian")
    {
      refuseHeader("its header names an unknown format, " + inQuotes(word));
    }
    coding_ = word == "ascii"          ? Coding::Text
      : word == "binary_little_endian" ? Coding::LittleEndian
                                       : Coding::BigEndian;
    formatted_ = true;
  }

  const Type* type()
  {
    const std::string_view word = lines_.word();
    const auto found = std::ranges::find_if(
      kTypes, [&](const Type& known) { return word == known.name || word == known.other; });
    if (found == kTypes.end())
    {
      refuseHeader("its header names an unknown type of a property, " + inQuotes(word));
    }
    return &*found;
  }

  void readProperty()
  {
    if (elements_.empty())
    {
      refuseHeader("its header names a property before any element");
    }
    Property property;
    if (lines_.rest().starts_with("list "))
    {
      lines_.word();
      property.count = type();
    }
    property.type = type();
    property.name = lines_.word();
    elements_.back().properties.push_back(property);
  }

  // ---- body

  void readOne(const Element& element)
  {
    if (coding_ == Coding::Text && !element.properties.empty() && !lines_.next())
    {
      refuseCut(element);
    }
    const bool isFace = element.name == "face";
    double p[3] = { std::nan(""), std::nan(""), std::nan("") };
    for (const Property& property : element.properties)
    {
      const double first = number(property.count ? *property.count : *property.type, element);
      if (!property.count)
      {
        for (std::size_t i = 0; i < 3; ++i)
        {
          p[i] = property.name.size() == 1 && property.name[0] == "xyz"[i] ? first : p[i];
        }
        continue;
      }
      const bool isCorners =
        isFace && (property.name == "vertex_indices" || property.name == "vertex_index");
      readList(element, property, first, isCorners);
    }
    if (element.name == "vertex")
    {
      points_->InsertNextPoint(p);
    }
  }

  void readList(const Element& element, const Property& property, double count, bool isCorners)
  {
    if (!(count >= 0.0) || (isCorners && count < 3.0))
    {
      refuseHere(element, "has " + inWords(count) + " corners");
    }
    if (coding_ != Coding::Text &&
      count * static_cast<double>(property.type->size) > static_cast<double>(body_.size()))
    {
      refuseHere(element,
        "counts " + inWords(count) +
          " corners, more than the file holds: cut off, or damaged there");
    }
    if (isCorners)
    {
      faces_->InsertNextCell(static_cast<int>(count));
    }
    for (double k = 0.0; k < count; ++k)
    {
      const double index = number(*property.type, element);
      if (!isCorners)
      {
        continue;
      }
      if (!(index >= 0.0 && index == std::floor(index)))
      {
        refuseIndex(index, at_);
      }
      if (index > farthest_)
      {
        farthest_ = index;
        farthestFace_ = at_;
      }
      faces_->InsertCellPoint(static_cast<vtkIdType>(std::min(index, 1e15)));
    }
  }

  double number(const Type& type, const Element& element)
  {
    if (coding_ == Coding::Text)
    {
      if (lines_.rest().empty() && lines_.behind().empty())
      {
        refuseCut(element);
      }
      return lines_.number<double>("a number for each of its properties, or of its corners");
    }
    if (body_.size() < type.size)
    {
      refuseCut(element);
    }
    char bytes[sizeof(double)];
    std::memcpy(bytes, body_.data(), type.size);
    body_.remove_prefix(type.size);
    if (coding_ == Coding::BigEndian) // this machine is of the other order
    {
      std::reverse(bytes, bytes + type.size);
    }
    return type.value(bytes);
  }

  // ---- refusals

  [[noreturn]] void refuseHeader(const std::string& what) const
  {
    if (lines_.behind().empty())
    {
      lines_.refuseEnd("the end of its header");
    }
    lines_.refuse(what);
  }

  static std::string inWords(double value)
  {
    char digits[32];
    return { digits, std::to_chars(digits, std::end(digits), value).ptr };
  }

  [[noreturn]] void refuseCut(const Element& element) const
  {
    lines_.refuse("cut off, or its header damaged: it counts " + std::to_string(element.count) +
      " of " + shortened(element.name) + ", and ends after " + std::to_string(at_ - 1));
  }

  // a line or byte more than the header counts, but for blanks
  void refuseMore()
  {
    const auto isBlank = [](unsigned char c) { return c == 0 || std::isspace(c) != 0; };
    if (coding_ == Coding::Text ? lines_.next() : !std::ranges::all_of(body_, isBlank))
    {
      lines_.refuse("the file goes on behind all that its header counts");
    }
  }

  [[noreturn]] void refuseHere(const Element& element, const std::string& what) const
  {
    lines_.refuse(shortened(element.name) + " " + std::to_string(at_) + " " + what);
  }

  [[noreturn]] void refuseIndex(double index, std::uint64_t face) const
  {
    lines_.refuse("face " + std::to_string(face) + " refers to vertex " + inWords(index) +
      ", out of range (0 to " + std::to_string(points_->GetNumberOfPoints() - 1) + ")");
  }

  TextLines lines_;
  std::string comments_;
  std::string_view body_; // what is left of a binary one
  std::vector<Element> elements_;
  Coding coding_ = Coding::Text;
  bool formatted_ = false;
  std::uint64_t at_ = 0;   // number of the element that is read, from 1
  double farthest_ = -1.0; // vertex that a face refers to
  std::uint64_t farthestFace_ = 0;
  vtkNew<vtkPoints> points_;
  vtkNew<vtkCellArray> faces_;
};

} // namespace

vtkSmartPointer<vtkPolyData> readPly(const std::filesystem::path& file)
{
  return PlyReader(file).read();
}

} // namespace palp
