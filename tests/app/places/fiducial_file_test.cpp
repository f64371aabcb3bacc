#include "app/places/fiducial_file.h"

#include "haptics/error.h"
#include "tests/support/process.h"

#include <fstream>
#include <gtest/gtest.h>

namespace palp
{
namespace
{

class FiducialFile : public ::testing::Test
{
protected:
  [[nodiscard]] std::filesystem::path written(const std::string& name, const std::string& text)
  {
    const auto file = folder_.path() / name;
    std::ofstream(file) << text;
    return file;
  }

  [[nodiscard]] std::string refusal(const std::string& name, const std::string& text)
  {
    try
    {
      (void)readFiducials(written(name, text));
    }
    catch (const Error& error)
    {
      return error.what();
    }
    return "accepted";
  }

  test::TemporaryFolder folder_;
};

const std::string kHead = "# Markups fiducial file version = 4.11\n";
const std::string kColumns =
  "# columns = id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc,associatedNodeID\n";
const std::string kPoints = "vtkMRMLMarkupsFiducialNode_0,-45.5,12.25,30,0,0,0,1,1,1,0,F-1,,\r\n"
                            "vtkMRMLMarkupsFiducialNode_1,1,-2,3,0,0,0,1,1,1,0,"
                            "\"lobe, \"\"left\"\"\",,\r\n";

// as 3D Slicer writes them: LPS and RAS by name, before 4.11 by number
TEST_F(FiducialFile, TurnsRasRoundByItsHeader)
{
  for (const char* axes : { "LPS", "1" })
  {
    const auto [places, unplaced] = readFiducials(
      written("a.fcsv", kHead + "# CoordinateSystem = " + axes + "\n" + kColumns + kPoints));
    ASSERT_EQ(places.size(), 2U);
    EXPECT_EQ(places[0], (PressPlace{ "F-1", { -0.0455, 0.01225, 0.03 } }));
    EXPECT_EQ(places[1], (PressPlace{ "lobe, \"left\"", { 0.001, -0.002, 0.003 } }));
  }
  for (const char* axes : { "RAS", "0" })
  {
    const auto [places, unplaced] = readFiducials(
      written("a.fcsv", kHead + "# CoordinateSystem = " + axes + "\n" + kColumns + kPoints));
    EXPECT_EQ(places.at(0), (PressPlace{ "F-1", { 0.0455, -0.01225, 0.03 } }));
  }
}

TEST_F(FiducialFile, ReadsMarkups)
{
  const auto text = [](const std::string& axes)
  {
    return R"({"@schema": "markups-schema-v1.0.0.json#", "markups": [{"type": "Fiducial",
      "coordinateSystem": ")" +
      axes + R"(", "coordinateUnits": "mm", "controlPoints": [
      {"id": "1", "label": "F-1", "position": [-45.5, 12.25, 30], "positionStatus": "defined"},
      {"id": "2", "label": "lost", "position": [0, 0, 0], "positionStatus": "undefined"},
      {"id": "3", "label": "F-2", "position": [1, -2.0, 3e0]}]}]})";
  };
  const auto [lps, unplaced] = readFiducials(written("a.mrk.json", text("LPS")));
  EXPECT_EQ(unplaced, 1U);
  ASSERT_EQ(lps.size(), 2U);
  EXPECT_EQ(lps[0], (PressPlace{ "F-1", { -0.0455, 0.01225, 0.03 } }));
  EXPECT_EQ(lps[1], (PressPlace{ "F-2", { 0.001, -0.002, 0.003 } }));
  const auto ras = readFiducials(written("a.mrk.json", text("RAS"))).places;
  EXPECT_EQ(ras.at(1), (PressPlace{ "F-2", { -0.001, 0.002, 0.003 } }));
}

TEST_F(FiducialFile, NamesWhatIsWrong)
{
  EXPECT_NE(refusal("a.csv", "1,2,3").find("not a list of points"), std::string::npos);
  EXPECT_NE(
    refusal("a.fcsv", kHead + kPoints).find("a.fcsv:2: nothing tells the axes"), std::string::npos);
  EXPECT_NE(
    refusal("a.fcsv", "# CoordinateSystem = IJK\n").find("the axes are 'IJK'"), std::string::npos);
  EXPECT_NE(refusal("a.fcsv", "# CoordinateSystem = LPS\n").find("no point"), std::string::npos);
  EXPECT_NE(refusal("a.fcsv", "# CoordinateSystem = LPS\n0,1,b,3\n").find(":2: y: 'b' is not a"),
    std::string::npos);
  EXPECT_NE(refusal("a.fcsv", "# CoordinateSystem = LPS\n0,1,2,1e9\n").find("farther than 10 m"),
    std::string::npos);
  EXPECT_NE(refusal("a.mrk.json", "{}").find("no list 'markups'"), std::string::npos);
  EXPECT_NE(
    refusal("a.mrk.json", R"({"markups": [{"controlPoints": []}]})").find("the axes are ''"),
    std::string::npos);
  EXPECT_NE(
    refusal("a.mrk.json", R"({"markups": [{"coordinateSystem": "LPS", "coordinateUnits": "m"}]})")
      .find("the unit is 'm'"),
    std::string::npos);
  for (const char* unit : { R"(["m", "UCUM", "meter"])", R"(["cm", "UCUM", "centimeter"])", "5" })
  {
    EXPECT_NE(refusal("a.mrk.json",
                std::string(R"({"markups": [{"coordinateSystem": "LPS", "coordinateUnits": )") +
                  unit + "}]}")
                .find("the unit is '"),
      std::string::npos)
      << unit;
  }
  EXPECT_NE(refusal("a.mrk.json",
              R"({"markups": [{"coordinateSystem": "LPS", "coordinateUnits": ["mm", "UCUM", "x"],
                "controlPoints": [{"position": [1]}]}]})")
              .find("must be three"),
    std::string::npos);
  EXPECT_NE(refusal("a.mrk.json",
              R"({"markups": [{"coordinateSystem": "LPS", "controlPoints": [{"position": [1]}]}]})")
              .find("/markups/0/controlPoints/0/position: must be three"),
    std::string::npos);
}

} // namespace
} // namespace palp
