#include "pipeline/formats/vtk_formats.h"

#include "haptics/error.h"
#include "pipeline/formats/whole_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <string_view>
#include <vtkCellArray.h>
#include <vtkDataSetReader.h>
#include <vtkDataSetSurfaceFilter.h>
#include <vtkNew.h>
#include <vtkOBJReader.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkPLYReader.h>
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

// the faces that belong to one cell only, curved ones in flat pieces
vtkSmartPointer<vtkPolyData> outerSurface(
  const std::filesystem::path& file, vtkUnstructuredGrid& grid)
{
  vtkCellArray* cells = grid.GetCells();
  const vtkIdType points = grid.GetNumberOfPoints();
  vtkDataArray* corners = cells ? cells->GetConnectivityArray() : nullptr;
  for (vtkIdType i = 0; corners && i < corners->GetNumberOfValues(); ++i)
  {
    const double corner = corners->GetComponent(i, 0);
    if (!(corner >= 0.0 && corner < static_cast<double>(points)))
    {
      throw Error(ErrorCode::BadFile,
        file.string() + ": a cell names a point that is not there; export it again");
    }
  }
  vtkNew<vtkDataSetSurfaceFilter> outside;
  outside->SetInputData(&grid);
  outside->Update();
  return outside->GetOutput();
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
  checkPlyEnd(file);
  return readWith<vtkPLYReader>(file);
}

vtkSmartPointer<vtkPolyData> readVtk(const std::filesystem::path& file)
{
  vtkNew<vtkDataSetReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  if (vtkUnstructuredGrid* grid = reader->GetUnstructuredGridOutput())
  {
    return outerSurface(file, *grid);
  }
  if (!reader->GetPolyDataOutput() && reader->GetOutput())
  {
    throw Error(ErrorCode::BadMesh,
      file.string() + ": " + reader->GetOutput()->GetClassName() +
        ", neither polygons nor an unstructured grid; extract its surface");
  }
  vtkSmartPointer<vtkPolyData> polygons = reader->GetPolyDataOutput();
  return polygons ? polygons : vtkSmartPointer<vtkPolyData>::New(); // errors are told elsewhere
}

vtkSmartPointer<vtkPolyData> readVtp(const std::filesystem::path& file)
{
  checkXmlEnd(file);
  return readWith<vtkXMLPolyDataReader>(file);
}

vtkSmartPointer<vtkPolyData> readVtu(const std::filesystem::path& file)
{
  checkXmlEnd(file);
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  return outerSurface(file, *reader->GetOutput());
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
