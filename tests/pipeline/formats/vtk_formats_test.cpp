#include "haptics/error.h"
#include "pipeline/surface_io/surface_io.h"
#include "tests/support/process.h"

#include <gtest/gtest.h>
#include <vtkCubeSource.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkPolyDataWriter.h>
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
      EXPECT_NE(std::string(error.what()).find("'4294967295' components"), std::string::npos)
        << array << ": " << error.what();
    }
  }
}

// VTK takes room for a size of each
TEST(VtkFormats, AnArrayOfMoreBlocksThanThereAreIsRefusedByTheirNumber)
{
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "cube.vtp";
  for (const bool isBig : { false, true })
  {
    for (const char* where :
      { "AppendedData encoding=\"raw\"", "AppendedData encoding=\"base64\"", "format=\"binary\"" })
    {
      for (const auto& [type, number] :
        { std::pair("UInt32", "4294967295"), { "UInt64", "18446744073709551615" } })
      {
        const bool isText = std::string(where).find("raw") == std::string::npos;
        vtkNew<vtkCubeSource> cube;
        vtkNew<vtkXMLPolyDataWriter> writer;
        writer->SetInputConnection(cube->GetOutputPort());
        writer->SetFileName(file.c_str());
        writer->SetHeaderType(std::string(type) == "UInt32" ? 32 : 64);
        writer->SetEncodeAppendedData(isText);
        *where == 'f' ? writer->SetDataModeToBinary() : writer->SetDataModeToAppended();
        isBig ? writer->SetByteOrderToBigEndian() : writer->SetByteOrderToLittleEndian();
        writer->Write();
        EXPECT_EQ(readSurface(file, LengthUnit::Meter).mesh->GetNumberOfPolys(), 12) << where;
        std::string text = readAll(file);
        ASSERT_NE(text.find(where), text.npos) << where;
        const std::size_t end = text.find('>', text.find(where));
        const std::size_t data = text.find_first_not_of(" \n_", end + 1);
        text.replace(data, isText ? 12 : 8, isText ? 12 : 8, isText ? '/' : '\xff');
        std::ofstream(file, std::ios::binary) << text;
        try
        {
          (void)readSurface(file, LengthUnit::Meter);
          ADD_FAILURE() << where << type << ": accepted";
        }
        catch (const Error& error)
        {
          EXPECT_NE(std::string(error.what()).find(number + std::string(" blocks, more than")),
            std::string::npos)
            << where << ": " << error.what();
        }
      }
    }
  }
}

std::string legacy(const TemporaryFolder& folder, bool binary)
{
  const std::filesystem::path file = folder.path() / "cube.vtk";
  vtkNew<vtkCubeSource> cube;
  vtkNew<vtkPolyDataWriter> writer;
  writer->SetInputConnection(cube->GetOutputPort());
  writer->SetFileName(file.c_str());
  binary ? writer->SetFileTypeToBinary() : writer->SetFileTypeToASCII();
  writer->Write();
  return readAll(file);
}

// at either VTK's reader stands still
TEST(VtkFormats, BlanksInALegacyTextAreNotCounted)
{
  const TemporaryFolder folder;
  const std::string text = legacy(folder, false);
  const std::filesystem::path file = folder.path() / "blanks.vtk";
  for (const char blank : { ' ', '\r' })
  {
    for (const char* before : { "\nPOLYGONS", "\nCONNECTIVITY", "\nPOINT_DATA" })
    {
      const std::size_t at = text.find(before);
      ASSERT_NE(at, text.npos) << before;
      std::ofstream(file, std::ios::binary) << std::string(text).insert(at, 300, blank);
      EXPECT_EQ(readSurface(file, LengthUnit::Meter).mesh->GetNumberOfPolys(), 12) << before;
    }
    std::ofstream(file, std::ios::binary) << text + '\n' + std::string(3, blank);
    EXPECT_EQ(readSurface(file, LengthUnit::Meter).mesh->GetNumberOfPolys(), 12);
  }
}

TEST(VtkFormats, BlanksInALegacyBinaryAreRefusedByTheirNumber)
{
  const TemporaryFolder folder;
  const std::string text = legacy(folder, true);
  const std::filesystem::path file = folder.path() / "blanks.vtk";
  std::ofstream(file, std::ios::binary) << text.substr(0, text.find("\nPOLYGONS")) +
      std::string(300, '\r') + text.substr(text.find("\nPOLYGONS"));
  try
  {
    (void)readSurface(file, LengthUnit::Meter);
    ADD_FAILURE() << "accepted";
  }
  catch (const Error& error)
  {
    EXPECT_NE(std::string(error.what()).find("300 blanks in a row"), std::string::npos)
      << error.what();
  }
}

} // namespace
} // namespace palp::test
