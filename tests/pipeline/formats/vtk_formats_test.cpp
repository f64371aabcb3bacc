#include "haptics/error.h"
#include "pipeline/surface_io/surface_io.h"
#include "tests/support/process.h"

#include <gtest/gtest.h>
#include <vtkCubeSource.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataWriter.h>

namespace palp::test
{
namespace
{

// VTK asks for the name of each of four billion components
TEST(VtkFormats, AnArrayOfFourBillionComponentsIsRefusedByItsCount)
{
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "cube.vtp";
  for (const char* array : { "Normals", "Points", "connectivity" })
  {
    vtkNew<vtkCubeSource> cube;
    vtkNew<vtkXMLPolyDataWriter> writer;
    writer->SetInputConnection(cube->GetOutputPort());
    writer->SetFileName(file.c_str());
    writer->Write();
    std::string text = readAll(file);
    const std::string key = "NumberOfComponents=\"";
    const std::size_t name = text.find("Name=\"" + std::string(array));
    ASSERT_NE(name, text.npos) << array;
    const std::size_t count = text.find(key, name);
    if (count < text.find('>', name))
    {
      text.erase(count, text.find('"', count + key.size()) + 1 - count);
    }
    std::ofstream(file, std::ios::binary) << text.insert(name, key + "4294967295\" ");
    try
    {
      (void)readSurface(file, LengthUnit::Meter);
      ADD_FAILURE() << array << ": accepted";
    }
    catch (const Error& error)
    {
      EXPECT_NE(std::string(error.what()).find("4294967295 components"), std::string::npos)
        << array << ": " << error.what();
    }
  }
}

} // namespace
} // namespace palp::test
