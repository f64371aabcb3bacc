#pragma once

#include "tests/support/csv_table.h"
#include "tests/support/process.h"

#include <array>
#include <fstream>
#include <gtest/gtest.h>
#include <set>
#include <sstream>
#include <string>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>

namespace palp::test
{

/// What the program does without a display.
inline Finished palp(const std::string& arguments)
{
  return test::runCommand("env -u DISPLAY -u WAYLAND_DISPLAY " PALP_PROGRAM " " + arguments);
}

/// A path of these rows.
inline std::filesystem::path writePath(const std::filesystem::path& folder, const char* rows)
{
  const std::filesystem::path file = folder / "press.csv";
  std::ofstream(file) << "time_s,x_mm,y_mm,z_mm\n" << rows;
  return file;
}

/// Presses on the shipped block.
class RunCommand : public ::testing::Test
{
protected:
  // the upper face of the shipped block, whose frame the path is in
  [[nodiscard]] double topMm() const
  {
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->SetFileName(block().c_str());
    reader->Update();
    return reader->GetOutput()->GetBounds()[5];
  }
  [[nodiscard]] std::string block() const
  {
    return PALP_SHARE "/meshes/block_50.vtp";
  }

  // down onto the middle of its upper face, 5 mm deep, and up again
  [[nodiscard]] Finished press(const std::string& extra, const std::string& out)
  {
    std::ostringstream rows;
    rows << "0,0,0," << topMm() + 2 << "\n0.1,0,0," << topMm() - 5 << "\n0.1505,0,0," << topMm() + 1
         << "\n";
    return pressAlong(rows.str(), extra, out);
  }

  // @param rows  of a path
  [[nodiscard]] Finished pressAlong(
    const std::string& rows, const std::string& extra, const std::string& out)
  {
    const auto path = writePath(folder_.path(), rows.c_str());
    return palp("run " + block() + " --path " + path.string() + " --out " +
      (folder_.path() / out).string() + " " + extra);
  }

  test::TemporaryFolder folder_;
};

/// How many colors a picture of this size has.
inline std::size_t colorsOf(const std::filesystem::path& png, int width, int height)
{
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName(png.c_str());
  reader->Update();
  vtkImageData* image = reader->GetOutput();
  EXPECT_EQ(image->GetDimensions()[0], width) << png;
  EXPECT_EQ(image->GetDimensions()[1], height) << png;
  std::set<std::array<int, 3>> colors;
  vtkDataArray* pixels = image->GetPointData()->GetScalars();
  for (vtkIdType i = 0; pixels && i < pixels->GetNumberOfTuples(); ++i)
  {
    const double* rgb = pixels->GetTuple(i);
    colors.insert({ int(rgb[0]), int(rgb[1]), int(rgb[2]) });
  }
  return colors.size();
}

} // namespace palp::test
