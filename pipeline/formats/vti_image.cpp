#include "pipeline/formats/vti_image.h"

#include "haptics/files/input_text.h"
#include "pipeline/formats/meshes/refuse.h"
#include "pipeline/formats/meshes/stated_space.h"
#include "pipeline/formats/vtk_formats.h"
#include "pipeline/process/file_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <sstream>
#include <string_view>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkMatrix3x3.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkStringArray.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLDataParser.h>
#include <vtkXMLImageDataReader.h>

namespace palp
{
namespace
{

// voxels' cells in extents: each after a key, as Extent="0 9 0 9 0 9"
std::uintmax_t cellsIn(std::string_view text, std::string_view key)
{
  std::uintmax_t cells = 0;
  for (std::size_t at = text.find(key); at != text.npos; at = text.find(key, at + 1))
  {
    std::istringstream words(std::string(text.substr(at + key.size(), 100)));
    words.ignore(2, '"');
    std::uintmax_t product = 1;
    std::int64_t low = 0;
    std::int64_t high = 0;
    for (int axis = 0; axis < 3 && words >> low >> high; ++axis)
    {
      product *= high > low ? static_cast<std::uintmax_t>(high - low) : 0;
    }
    cells += product;
  }
  return cells;
}

// VTK takes its own place, size and direction for those that it cannot read
void checkNumbers(const std::filesystem::path& file, std::string_view text)
{
  const std::size_t tag = std::min(text.find("<ImageData"), text.size());
  text = text.substr(tag, text.find('>', tag) - tag);
  for (const auto& [key, count] : { std::pair("Origin", 3), { "Spacing", 3 }, { "Direction", 9 } })
  {
    const std::size_t at = text.find(key + std::string("=\""));
    if (at == text.npos)
    {
      continue;
    }
    const std::size_t begin = text.find('"', at) + 1;
    std::istringstream words(std::string(text.substr(begin, text.find('"', begin) - begin)));
    int got = 0;
    for (double number = 0.0; words >> number;)
    {
      ++got;
    }
    if (got != count || !words.eof())
    {
      refuse(file,
        std::string("its ") + key + " is not " + std::to_string(count) +
          " numbers; export it again");
    }
  }
}

// and leaves voxels that no piece has as they come
void checkVtiHeader(const std::filesystem::path& file)
{
  const std::string text = checkedXml(file);
  checkNumbers(file, text);
  if (cellsIn(text, "<Piece Extent=") != cellsIn(text, "WholeExtent="))
  {
    refuse(file, "damaged, its pieces do not fill its WholeExtent; export it again");
  }
}

// the one array of numbers at the points, where none is marked as the scalars
void findScalars(const std::filesystem::path& file, vtkImageData& image)
{
  vtkPointData& points = *image.GetPointData();
  if (points.GetScalars())
  {
    return;
  }
  std::vector<std::string> names;
  for (int i = 0; i < points.GetNumberOfArrays(); ++i)
  {
    if (vtkDataArray* array = points.GetArray(i))
    {
      names.emplace_back(array->GetName() ? array->GetName() : "");
    }
  }
  if (names.empty())
  {
    refuse(file,
      image.GetCellData()->GetNumberOfArrays() > 0
        ? "its values are those of cells, not of points; save them as point data"
        : "no values at its points; export it again");
  }
  if (names.size() > 1)
  {
    refuse(file,
      std::to_string(names.size()) + " arrays at its points, as " + inQuotes(names[0]) + " and " +
        inQuotes(names[1]) + ", and none is marked as Scalars; save the one to press");
  }
  points.SetActiveScalars(names[0].c_str());
}

// of a field array that has one; else empty
std::string fieldWord(vtkImageData& image, const char* name)
{
  auto* words = vtkStringArray::SafeDownCast(image.GetFieldData()->GetAbstractArray(name));
  return words != nullptr && words->GetNumberOfValues() == 1 ? words->GetValue(0) : vtkStdString();
}

// about the corner of the voxels, as VTK does; a negative spacing turns an axis round
void turn(vtkImageData& image, PatientImage& result)
{
  const double* corner = image.GetOrigin();
  const std::array<double, 3> step{ image.GetSpacing()[0], image.GetSpacing()[1],
    image.GetSpacing()[2] };
  for (int i = 0; i < 3; ++i)
  {
    double* row = result.toPatient + 4 * i;
    row[3] = corner[i];
    for (int k = 0; k < 3; ++k)
    {
      row[k] = std::copysign(image.GetDirectionMatrix()->GetElement(i, k),
        image.GetDirectionMatrix()->GetElement(i, k) * step[static_cast<std::size_t>(k)]);
      row[3] -= row[k] * corner[k];
    }
  }
  vtkNew<vtkMatrix3x3> straightened;
  image.SetDirectionMatrix(straightened);
  image.SetSpacing(std::abs(step[0]), std::abs(step[1]), std::abs(step[2]));
}

// VTK takes of a block the first values that an extent asks for, and leaves others
class BlockReader : public vtkXMLImageDataReader
{
public:
  static BlockReader* New();
  vtkTypeMacro(BlockReader, vtkXMLImageDataReader);

  std::string longArray;  ///< that has more values than its piece has points; empty: none
  std::string shortArray; ///< that has fewer

protected:
  void ReadXMLData() override
  {
    this->Superclass::ReadXMLData();
    vtkXMLDataElement* grid =
      this->XMLParser->GetRootElement()->FindNestedElementWithName("ImageData");
    for (int i = 0; grid && i < grid->GetNumberOfNestedElements(); ++i)
    {
      checkPiece(*grid->GetNestedElement(i));
    }
  }

private:
  void checkPiece(vtkXMLDataElement& piece)
  {
    std::array<int, 6> extent{};
    vtkXMLDataElement* points = piece.FindNestedElementWithName("PointData");
    if (!points || piece.GetVectorAttribute("Extent", 6, extent.data()) != 6)
    {
      return;
    }
    vtkTypeUInt64 count = 1;
    for (std::size_t k = 0; k < 6; k += 2)
    {
      count *= static_cast<vtkTypeUInt64>(extent[k + 1] - extent[k] + 1);
    }
    for (int i = 0; i < points->GetNumberOfNestedElements(); ++i)
    {
      vtkXMLDataElement& array = *points->GetNestedElement(i);
      const vtkTypeUInt64 got = lastOf(array, count);
      if (got != 1)
      {
        const char* name = array.GetAttribute("Name");
        (got > 1 ? longArray : shortArray) = name ? name : "of no name";
      }
    }
  }

  // how many it has from the last of its piece on, two at most
  vtkTypeUInt64 lastOf(vtkXMLDataElement& array, vtkTypeUInt64 points)
  {
    int type = 0;
    int components = 1;
    vtkTypeInt64 offset = 0;
    array.GetScalarAttribute("NumberOfComponents", components);
    if (!array.GetWordTypeAttribute("type", type) || type == VTK_STRING ||
      type == VTK_BIT) // those it does not tell single values of
    {
      return 1;
    }
    // together with the last one: the next by itself VTK looks for behind the last block, if full
    const vtkTypeUInt64 last = points * static_cast<vtkTypeUInt64>(std::max(components, 1)) - 1;
    const char* format = array.GetAttribute("format");
    std::array<double, 2> values{};
    return array.GetScalarAttribute("offset", offset)
      ? this->XMLParser->ReadAppendedData(offset, values.data(), last, 2, type)
      : this->XMLParser->ReadInlineData(
          &array, format && std::string_view(format) == "ascii", values.data(), last, 2, type);
  }
};

vtkStandardNewMacro(BlockReader);

} // namespace

PatientImage readVti(const std::filesystem::path& file)
{
  checkVtiHeader(file);
  vtkNew<BlockReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  if (!reader->longArray.empty())
  {
    refuse(file,
      "its array " + inQuotes(reader->longArray) +
        " has more values than its extent has points; mend the extent, or export it again");
  }
  if (!reader->shortArray.empty())
  {
    refuse(file,
      "cut off, its array " + inQuotes(reader->shortArray) +
        " has fewer values than its extent has points; export or copy it again");
  }
  findScalars(file, *reader->GetOutput());
  PatientImage result{ .image = reader->GetOutput(), .toPatient = { 0 } };
  result.toPatient[15] = 1.0;
  turn(*result.image, result);
  result.unit = fieldWord(*result.image, kUnitArray);
  const std::string space = checkedSpace(file, fieldWord(*result.image, kSpaceArray));
  result.space = space.empty() ? "" : "LPS";
  if (space == "RAS")
  {
    std::for_each(result.toPatient, result.toPatient + 8, [](double& one) { one = -one; });
    result.notes.emplace_back(kTurnedFromRas);
  }
  return result;
}

std::uintmax_t vtiBytes(const std::filesystem::path& file)
{
  std::string start(4096, '\0');
  std::ifstream(file, std::ios::binary).read(start.data(), static_cast<std::streamsize>(4096));
  const std::string key = "WholeExtent=\"";
  const std::size_t at = start.find(key);
  std::istringstream words(at == start.npos ? "" : start.substr(at + key.size(), 200));
  std::uintmax_t bytes = sizeof(double);
  std::int64_t low = 0;
  std::int64_t high = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    if (!(words >> low >> high) || high < low || high - low > 100'000)
    {
      return 0;
    }
    bytes *= static_cast<std::uintmax_t>(high - low + 1);
  }
  return bytes;
}

} // namespace palp
