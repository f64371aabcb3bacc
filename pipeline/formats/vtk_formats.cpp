#include "pipeline/formats/vtk_formats.h"

#include "haptics/error.h"
#include "haptics/files/input_text.h"
#include "pipeline/formats/meshes/stated_space.h"
#include "pipeline/formats/meshes/whole_file.h"
#include "pipeline/formats/outer_surface.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <regex>
#include <string>
#include <string_view>
#include <vtkDataSetReader.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

namespace palp
{
namespace
{

template <typename Reader>
vtkSmartPointer<vtkPolyData> readWith(const std::filesystem::path& file)
{
  vtkNew<Reader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  return reader->GetOutput();
}

// VTK asks for the name of each component, for hours where a damaged count is believed
void checkComponents(const std::filesystem::path& file, const std::string& tags)
{
  constexpr std::string_view kKey = "NumberOfComponents=\"";
  constexpr double kMost = 1000.0;
  for (std::size_t at = tags.find(kKey); at != tags.npos; at = tags.find(kKey, at + 1))
  {
    const double count = std::strtod(tags.c_str() + at + kKey.size(), nullptr);
    if (!(count >= 0.0 && count <= kMost))
    {
      throw Error(ErrorCode::BadFile,
        file.string() + ": damaged, one of its arrays has " +
          inQuotes(std::string_view(tags).substr(
            at + kKey.size(), tags.find('"', at + kKey.size()) - at - kKey.size())) +
          " components; export it again");
    }
  }
}

// what a tag gives as a value; empty: nothing
std::string_view valueOf(std::string_view tag, std::string_view key)
{
  const std::size_t at = tag.find(key);
  tag.remove_prefix(at == tag.npos ? tag.size() : at + key.size());
  return tag.substr(0, tag.find('"'));
}

// the one that data begin with
std::uint64_t firstNumber(std::string_view data, bool isText, std::size_t wide, bool isBig)
{
  constexpr std::string_view kDigits =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes(isText ? std::string_view() : data.substr(0, wide));
  std::uint32_t bits = 0;
  for (std::size_t i = 0; isText && i < std::min(data.size(), 2 * wide); ++i)
  {
    bits = bits << 6 | static_cast<std::uint32_t>(kDigits.find(data[i]) & 63);
    if (i % 4 != 0) // which completes a byte
    {
      bytes += static_cast<char>(bits >> (6 - 2 * (i % 4)));
    }
  }
  bytes.resize(wide);
  std::uint64_t number = 0;
  for (std::size_t i = 0; i < wide; ++i)
  {
    number = number << 8 | static_cast<unsigned char>(bytes[isBig ? i : wide - 1 - i]);
  }
  return number;
}

// VTK takes room for as many blocks as a compressed array claims
void checkBlocks(const std::filesystem::path& file, std::string_view all)
{
  const std::size_t appended = std::min(all.find("<AppendedData"), all.size());
  const std::string_view tags = all.substr(0, appended);
  const std::size_t first = std::min(all.find('_', appended), all.size() - 1) + 1;
  const bool isRaw = all.substr(appended, first - appended).find("\"raw\"") != all.npos;
  const std::size_t wide = valueOf(tags, "header_type=\"") == "UInt64" ? 8 : 4;
  const bool isBig = valueOf(tags, "byte_order=\"") == "BigEndian";
  const bool isPacked = !valueOf(tags, "compressor=\"").empty();
  for (std::size_t at = tags.find("<DataArray"); isPacked && at != tags.npos;
       at = tags.find("<DataArray", at + 1))
  {
    const std::size_t end = std::min(tags.find('>', at), tags.size());
    const std::string_view tag = tags.substr(at, end - at);
    const std::string_view format = valueOf(tag, "format=\"");
    const bool isApart = format == "appended";
    const double offset = std::strtod(std::string(valueOf(tag, "offset=\"")).c_str(), nullptr);
    const double rest = static_cast<double>(all.size() - first);
    const std::size_t begin = isApart
      ? first + static_cast<std::size_t>(std::max(0.0, std::min(rest, offset)))
      : std::min(all.find_first_not_of(" \t\r\n>", end), all.size());
    const std::string_view data = all.substr(begin);
    const std::uint64_t blocks =
      isApart || format == "binary" ? firstNumber(data, !isApart || !isRaw, wide, isBig) : 0;
    if (blocks > data.size() / wide) // of which each takes a number at least
    {
      throw Error(ErrorCode::BadFile,
        file.string() + ": damaged, one of its arrays claims " + std::to_string(blocks) +
          " blocks, more than it holds; export it again");
    }
  }
}

} // namespace

std::string checkedXml(const std::filesystem::path& file)
{
  std::string text = wholeFile(file);
  constexpr std::size_t enough = 1024; // [bytes], for a tag and remarks or blank lines about it
  constexpr std::size_t shortest = 32; // that a file cut off later can be
  if (text.size() >= shortest && text.substr(0, enough).find("<VTKFile") == text.npos)
  {
    throw Error(ErrorCode::BadFile,
      file.string() + ": not a VTP, VTU or VTI file, whatever its name; rename or convert it");
  }
  if (text.find("</VTKFile", text.size() - std::min(text.size(), enough)) == text.npos)
  {
    throw Error(ErrorCode::BadFile,
      file.string() + ": cut off, its last tag </VTKFile> is missing; export or copy it again");
  }
  checkBlocks(file, text);
  text.resize(std::min(text.size(), text.find("<AppendedData")));
  checkComponents(file, text);
  return text;
}

namespace
{

// VTK looks for ever at 256 blanks behind an array, and at blanks in a last line of their own
void openLegacy(const std::filesystem::path& file, vtkDataSetReader& reader)
{
  std::string text = wholeFile(file);
  constexpr std::size_t kLongest = 255;
  const auto isBlank = [](char c) { return c == ' ' || c == '\r'; };
  std::size_t run = 0;
  std::size_t longest = 0;
  for (const char c : text)
  {
    run = isBlank(c) ? run + 1 : 0;
    longest = std::max(longest, run);
  }
  std::size_t format = 0; // in the third line
  for (int line = 0; line < 2; ++line)
  {
    format = std::min(text.find('\n', format), text.size() - 1) + 1;
  }
  if (!text.substr(format, 5).starts_with("ASCII"))
  {
    if (longest > kLongest)
    {
      throw Error(ErrorCode::BadFile,
        file.string() + ": damaged, " + std::to_string(longest) +
          " blanks in a row stand in it; export it again");
    }
    reader.SetFileName(file.c_str());
    return;
  }
  const auto areBlank = [&](char a, char b) { return isBlank(a) && isBlank(b); };
  text.erase(std::unique(text.begin(), text.end(), areBlank), text.end());
  text.erase(text.find_last_not_of(" \r\n") + 1);
  reader.ReadFromInputStringOn();
  reader.SetInputString(text + '\n');
}

} // namespace

vtkSmartPointer<vtkPolyData> readVtk(const std::filesystem::path& file)
{
  vtkNew<vtkDataSetReader> reader;
  openLegacy(file, *reader);
  if (reader->ReadOutputType() < 0)
  {
    throw Error(ErrorCode::BadFile,
      file.string() +
        ": cut off or damaged in its header, it names no known DATASET; export it again");
  }
  reader->Update();
  const std::string_view header = reader->GetHeader() ? reader->GetHeader() : "";
  if (vtkUnstructuredGrid* grid = reader->GetUnstructuredGridOutput())
  {
    auto surface = outerSurface(*grid, file.string());
    stateSpace(*surface, header);
    return surface;
  }
  if (!reader->GetPolyDataOutput() && reader->GetOutput())
  {
    throw Error(ErrorCode::BadMesh,
      file.string() + ": " + reader->GetOutput()->GetClassName() +
        ", neither polygons nor an unstructured grid; extract its surface");
  }
  vtkSmartPointer<vtkPolyData> polygons = reader->GetPolyDataOutput();
  polygons = polygons ? polygons : vtkSmartPointer<vtkPolyData>::New();
  stateSpace(*polygons, header);
  return polygons;
}

vtkSmartPointer<vtkPolyData> readVtp(const std::filesystem::path& file)
{
  (void)checkedXml(file);
  return readWith<vtkXMLPolyDataReader>(file);
}

vtkSmartPointer<vtkPolyData> readVtu(const std::filesystem::path& file)
{
  (void)checkedXml(file);
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  return outerSurface(*reader->GetOutput(), file.string());
}

namespace
{

// what VTK says of files that end too early, in words for people; other messages as they are
std::string inWords(std::string text)
{
  constexpr std::array kShort{ "may be too short", "not long enough", "Error reading ascii",
    "Error reading binary", "file is truncated", "Data cannot be read", "Error in binary read",
    "cell array header", "offset header", "Cannot read number" };
  const auto says = [&](const char* words) { return text.find(words) != text.npos; };
  return std::ranges::any_of(kShort, says)
    ? "cut off, or it counts more than it holds"
    : std::regex_replace(text, std::regex("\\(0x[0-9a-f]+\\)"), ""); // addresses
}

// takes the messages of all objects, those inside a reader included
class Thrower : public vtkOutputWindow
{
public:
  static Thrower* New();
  vtkTypeMacro(Thrower, vtkOutputWindow);

  void DisplayErrorText(const char* text) override
  {
    // "ERROR: In file, line n\nvtkClass (0x..): what happened"; a warning names no class
    std::string_view what(text);
    what.remove_prefix(what.find('\n') + 1);
    what = what.substr(0, what.find_first_of("\r\n"));
    const std::size_t name = what.find("): ");
    constexpr std::size_t most = 200; // it may quote the file
    std::string line(what.substr(name == what.npos ? 0 : name + 3, most));
    std::replace_if(
      line.begin(), line.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
    throw VtkError{ inWords(line) };
  }

  // data that end too early are but a warning to VTK
  void DisplayGenericWarningText(const char* text) override
  {
    if (std::strstr(text, "Error reading"))
    {
      this->DisplayErrorText(text);
    }
  }

  void DisplayWarningText(const char*) override
  {
  }
};
vtkStandardNewMacro(Thrower);

} // namespace

void throwVtkErrors()
{
  vtkOutputWindow::SetInstance(vtkSmartPointer<Thrower>::New());
}

} // namespace palp
