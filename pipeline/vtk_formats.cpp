#include "pipeline/vtk_formats.h"

#include "haptics/error.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <string_view>
#include <vtkNew.h>
#include <vtkOBJReader.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkPLYReader.h>
#include <vtkPolyData.h>
#include <vtkPolyDataReader.h>
#include <vtkSTLReader.h>
#include <vtkXMLPolyDataReader.h>

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

// true when a text begins with so many finite numbers
bool startsWithNumbers(std::string_view text, int count)
{
  for (int i = 0; i < count; ++i)
  {
    text.remove_prefix(std::min(text.find_first_not_of(" \t+"), text.size()));
    double value = 0.0;
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (failure != std::errc{} || !std::isfinite(value))
    {
      return false;
    }
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  }
  return true;
}

} // namespace

vtkSmartPointer<vtkPolyData> readStl(const std::filesystem::path& file)
{
  constexpr std::size_t header = 84; // [bytes], the last four are the number of triangles
  constexpr std::size_t facet = 50;  // [bytes]
  const std::size_t size = std::filesystem::file_size(file);
  std::string start(std::min<std::size_t>(size, 512), '\0');
  std::ifstream(file, std::ios::binary)
    .read(start.data(), static_cast<std::streamsize>(start.size()));
  const bool isText = start.starts_with("solid") && start.find('\0') == std::string::npos;
  if (isText)
  {
    return readWith<vtkSTLReader>(file);
  }
  if (size < header + facet)
  {
    throw Error(ErrorCode::BadFile,
      file.string() + ": too short for a binary STL file; export the surface again");
  }
  std::uint32_t count = 0;
  std::memcpy(&count, start.data() + header - sizeof count, sizeof count);
  if ((size - header) / facet < count)
  {
    throw Error(ErrorCode::BadFile,
      file.string() + ": cut off, it holds " + std::to_string((size - header) / facet) + " of " +
        std::to_string(count) + " triangles; export or copy it again");
  }
  return readWith<vtkSTLReader>(file);
}

vtkSmartPointer<vtkPolyData> readObj(const std::filesystem::path& file)
{
  std::ifstream in(file);
  std::string line;
  for (int number = 1; std::getline(in, line); ++number)
  {
    if ((line.starts_with("v ") || line.starts_with("v\t")) &&
      !startsWithNumbers(std::string_view(line).substr(1), 3))
    {
      throw Error(ErrorCode::BadMesh,
        file.string() + ":" + std::to_string(number) +
          ": expected three coordinates, each a usable number; repair the surface");
    }
  }
  return readWith<vtkOBJReader>(file);
}

vtkSmartPointer<vtkPolyData> readPly(const std::filesystem::path& file)
{
  return readWith<vtkPLYReader>(file);
}

vtkSmartPointer<vtkPolyData> readVtk(const std::filesystem::path& file)
{
  return readWith<vtkPolyDataReader>(file);
}

vtkSmartPointer<vtkPolyData> readVtp(const std::filesystem::path& file)
{
  return readWith<vtkXMLPolyDataReader>(file);
}

// takes the messages of all objects, those inside a reader included
class VtkErrors::Log : public vtkOutputWindow
{
public:
  static Log* New();
  vtkTypeMacro(Log, vtkOutputWindow);

  void DisplayErrorText(const char* text) override
  {
    if (!this->First.empty())
    {
      return;
    }
    // "ERROR: In file, line n\nvtkClass (0x..): what happened"; a warning names no class
    std::string_view what(text);
    what.remove_prefix(what.find('\n') + 1);
    what = what.substr(0, what.find_first_of("\r\n"));
    const std::size_t name = what.find("): ");
    constexpr std::size_t most = 200; // it may quote the file
    this->First = what.substr(name == what.npos ? 0 : name + 3, most);
    std::replace_if(
      this->First.begin(), this->First.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  }

  // data that end too early are but a warning to VTK
  void DisplayGenericWarningText(const char* text) override
  {
    if (std::strstr(text, "Error reading"))
    {
      this->DisplayErrorText(text);
    }
  }

  std::string First;
};
vtkStandardNewMacro(VtkErrors::Log);

VtkErrors::VtkErrors()
  : log_(vtkSmartPointer<Log>::New())
{
  vtkOutputWindow::SetInstance(log_);
}

const std::string& VtkErrors::first() const noexcept
{
  return log_->First;
}

} // namespace palp
