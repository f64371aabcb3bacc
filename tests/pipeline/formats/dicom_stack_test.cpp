#include "tests/pipeline/formats/dicom_files.h"

#include <cmath>
#include <fstream>

namespace palp::test
{
namespace
{

using Eigen::Vector3d;

// images that do not go together, or hardly
class DicomStack : public DicomFiles
{
};

// by an angle that is none of a gantry: where all of a long series has added up
TEST_F(DicomStack, SlicesThatLeanALittleStayWhereTheyAre)
{
  DicomGrid grid = kAxial;
  grid.step = 0.5;
  grid.slices = 90;
  const Vector3d middle =
    writeDicom(folder_.path(), "lean", grid, "--write-xfer-little", { .lean = 0.009 * grid.step });
  const LoadedSurface surface = readSurface(folder_.path() / "lean", {}, { .level = kDicomLevel });
  for (const Vector3d& point : meshOf(surface).points)
  {
    ASSERT_NEAR((point - middle).norm(), 1e-3 * kDicomRadius, 0.05e-3) << point.transpose();
  }
}

// slices that are shifted along themselves
TEST_F(DicomStack, ATiltedGantryIsRefusedWithItsAngle)
{
  DicomGrid tilted = kAxial;
  tilted.slices = 1;
  for (int k = 0; k < 12; ++k)
  {
    tilted.first = kAxial.first + 2.5 * k * Vector3d(0.0, std::tan(12.0 * M_PI / 180.0), 1.0);
    writeDicom(folder_.path(), "part" + std::to_string(k), tilted, "--write-xfer-little");
    std::filesystem::create_directories(folder_.path() / "tilted");
    std::filesystem::copy(folder_.path() / words("part", k, "/part", k, "1_3.dcm"),
      folder_.path() / words("tilted/", k, ".dcm"));
  }
  EXPECT_NE(refusal("tilted").find("its gantry was tilted by 12 degrees"), std::string::npos)
    << refusal("tilted");
}

// one image of which would be as much too bright
TEST_F(DicomStack, OneImageWithoutARescaleSlopeIsNamed)
{
  writeDicom(folder_.path(), "raw", kAxial, "--write-xfer-little");
  EXPECT_EQ(refusal("raw"), "taken");
  const std::string file = (folder_.path() / "raw/raw1_10.dcm").string();
  ASSERT_EQ(runCommand("dcmodify -q -nb -ea '(0028,1053)' -ea '(0028,1052)' " + file).code, 0);
  EXPECT_NE(refusal("raw").find("one lacks Rescale Slope and Intercept"), std::string::npos)
    << refusal("raw");
}

// which may stand between the others, or behind them
TEST_F(DicomStack, OneImageOfAnotherEchoOrTimeIsNamed)
{
  for (const std::string other : { "(0018,0081)=80", "(0020,0100)=2" })
  {
    writeDicom(folder_.path(), "one", kAxial, "--write-xfer-little",
      { .extra = "(0018,0081) DS [10]\n(0020,0100) IS [1]\n" });
    EXPECT_EQ(refusal("one"), "taken");
    const std::string file = (folder_.path() / "one/one1_10.dcm").string();
    ASSERT_EQ(runCommand("dcmodify -q -nb -m '" + other + "' " + file).code, 0);
    EXPECT_NE(refusal("one").find("is of another echo or time than"), std::string::npos)
      << refusal("one");
  }
}

// as every CD has it, here in a form that is no file of DICOM
TEST_F(DicomStack, TheDirectoryOfADiscIsPassedOver)
{
  writeDicom(folder_.path(), "disc", kAxial, "--write-xfer-little");
  std::ofstream(folder_.path() / "disc/DICOMDIR") << std::string(128, '\0') << "DICM damaged";
  EXPECT_EQ(refusal("disc"), "taken");
}

} // namespace
} // namespace palp::test
