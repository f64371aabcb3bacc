#include "haptics/units.h"
#include "tests/app/commands/run_rig.h"
#include "tests/support/obj_file.h"
#include "tests/support/surfaces.h"

#include <sstream>
#include <vector>

namespace palp
{
namespace
{

using namespace units::literals;
using test::Finished;

constexpr const char* kLeft = R"({"name": "left", "bundled": "sphere_30", "tissue":
  {"young": "5kPa", "poisson": 0.45}, "frame": {"origin": ["-30mm", "0mm", "0mm"]}})";
constexpr const char* kRight = R"({"name": "right", "bundled": "sphere_30", "color": "#203040",
  "tissue": {"young": "60kPa", "poisson": 0.3}, "frame": {"origin": ["30mm", "0mm", "0mm"]}})";
constexpr const char* kFar = R"({"name": "far", "bundled": "sphere_30", "tissue":
  {"young": "60kPa", "poisson": 0.3}, "frame": {"origin": ["0mm", "500mm", "0mm"]}})";
constexpr const char* kSkin = R"({"name": "skin", "bundled": "sphere_100", "role": "through"})";

// presses of organs without a window, down on the left ball, up, and down on the right one
class OrganScene : public ::testing::Test
{
protected:
  [[nodiscard]] std::filesystem::path out(const std::string& name) const
  {
    return folder_.path() / name;
  }

  [[nodiscard]] Finished press(
    const std::string& organs, const std::string& name, const std::string& more = "") const
  {
    std::ofstream(folder_.path() / "press.csv")
      << "time_s,x_mm,y_mm,z_mm,ax,ay,az\n0,-30,0,31,0,0,-1\n0.1,-30,0,24,0,0,-1\n"
         "0.2,-30,0,31,0,0,-1\n0.3,30,0,31,0,0,-1\n0.4,30,0,26,0,0,-1\n0.5,30,0,31,0,0,-1\n";
    const std::string moved =
      more.find("recording") == more.npos ? R"("device": "path:press.csv",)" : "";
    std::ofstream(out(name + ".json"))
      << R"({"palp_scene": 1, "organs": [)" << organs << "]," << moved
      << R"("window": false, "exports": ["all-samples", "deformed"], "tool": "sphere:6mm")" << more
      << "}";
    return test::palp("scene " + out(name + ".json").string() + " --out " + out(name).string());
  }

  // of 30 mm
  void writeBall(const std::string& name, int splits, double left) const
  {
    test::Mesh mesh = test::ball(30.0_mm, splits);
    for (Eigen::Vector3d& point : mesh.first)
    {
      point.x() += left;
    }
    test::writeObj(out(name), mesh.first, mesh.second);
  }

  // a table without its comments
  [[nodiscard]] std::string rows(const std::string& name, const char* table = "samples.csv") const
  {
    std::istringstream all(test::readAll(out(name) / table));
    std::string rows;
    for (std::string line; std::getline(all, line);)
    {
      rows += line.starts_with('#') ? "" : line + '\n';
    }
    return rows;
  }

  // cells of a column while an organ is touched, or is apart
  [[nodiscard]] std::vector<std::string> cells(
    const std::string& name, const std::string& column, const std::string& organ) const
  {
    std::istringstream lines(rows(name));
    std::vector<std::string> found;
    std::vector<std::string> header;
    for (std::string line; std::getline(lines, line);)
    {
      std::istringstream parts(line);
      std::vector<std::string> row;
      for (std::string cell; std::getline(parts, cell, ',');)
      {
        row.push_back(cell);
      }
      if (header.empty())
      {
        header = row;
        continue;
      }
      const auto at = [&](const std::string& of)
      { return row.at(static_cast<std::size_t>(std::ranges::find(header, of) - header.begin())); };
      if (at("organ") == organ)
      {
        found.push_back(at(column));
      }
    }
    return found;
  }

  [[nodiscard]] double middleOf(const std::string& name) const
  {
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->SetFileName((out(name) / "deformed.vtp").c_str());
    reader->Update();
    const double* bounds = reader->GetOutput()->GetBounds();
    return 0.5 * (bounds[0] + bounds[1]);
  }

  test::TemporaryFolder folder_;
};

TEST_F(OrganScene, EachOrganAnswersByItsTissueAsIfItWereAlone)
{
  const std::string both = std::string(kLeft) + ',' + kRight;
  ASSERT_EQ(press(both, "both").code, 0);
  ASSERT_EQ(press(kLeft, "left").code, 0);
  ASSERT_EQ(press(kRight, "right").code, 0);
  for (const char* organ : { "left", "right" })
  {
    for (const char* column : { "time_s", "depth_mm", "force_N", "force_z_N", "contact_radius_mm",
           "extent_radius_mm", "stiffness_N_per_mm", "thickness_mm" })
    {
      EXPECT_EQ(cells("both", column, organ), cells(organ, column, organ)) << column;
    }
    EXPECT_GT(cells("both", "force_N", organ).size(), 50U);
  }
  // E / (1 - nu^2) 4/3 sqrt(R) d^1.5, of the paper's Eq. (2), the deepest of the right one
  const std::vector<std::string> depths = cells("both", "depth_mm", "right");
  const std::vector<std::string> forces = cells("both", "force_N", "right");
  const double depth = 1e-3 * std::stod(depths[depths.size() / 2]);
  const double force =
    4.0 / 3.0 * 60.0_kPa / (1.0 - 0.09) * std::sqrt(6.0_mm) * std::pow(depth, 1.5);
  EXPECT_NEAR(std::stod(forces[forces.size() / 2]), force, 1e-9 * force);
}

TEST_F(OrganScene, OneThatIsFarAndOneThatIsSeenThroughChangeNoByteOfTheSamples)
{
  ASSERT_EQ(press(kLeft, "alone").code, 0);
  for (const auto& [name, more] : { std::pair("far", kFar), std::pair("skin", kSkin) })
  {
    ASSERT_EQ(press(std::string(kLeft) + ',' + more, name).code, 0);
    EXPECT_EQ(rows(name), rows("alone"));
    EXPECT_EQ(rows(name, "presses.csv"), rows("alone", "presses.csv"));
  }
  EXPECT_NE(
    test::readAll(out("skin") / "samples.csv").find("# organ skin: not felt\n"), std::string::npos);
}

// a ball of many points, to look at, and of few, to feel
TEST_F(OrganScene, IsFeltByItsHapticLevelAndTellsHowFarThatIs)
{
  writeBall("fine.obj", 40, -30.0_mm);
  writeBall("few.obj", 6, -30.0_mm);
  const auto ball = [](const std::string& files)
  { return R"({"name": "left", "unit": "mm", )" + files + "}"; };
  const Finished both = press(ball(R"("file": "fine.obj", "haptic": "few.obj")"), "both");
  ASSERT_EQ(both.code, 0) << both.err;
  ASSERT_EQ(press(ball(R"("file": "few.obj")"), "few").code, 0);
  ASSERT_EQ(press(ball(R"("file": "fine.obj")"), "fine").code, 0);
  EXPECT_EQ(rows("both"), rows("few"));
  EXPECT_NE(rows("both"), rows("fine"));
  EXPECT_NE(both.err.find("from the surface shown"), std::string::npos) << both.err;
  EXPECT_EQ(both.err.find("warning"), std::string::npos) << both.err;
  EXPECT_GT(std::filesystem::file_size(out("both") / "deformed.vtp"),
    4 * std::filesystem::file_size(out("few") / "deformed.vtp"));
  ASSERT_EQ(test::palp("run " + out("both").string() + " --out " + out("again").string()).code, 0);
  EXPECT_EQ(rows("again"), rows("both"));
}

// which an edit of the scene may swap
TEST_F(OrganScene, WarnsWhereTheLevelToFeelIsOfAnotherOrgan)
{
  writeBall("left.obj", 10, -30.0_mm);
  writeBall("right.obj", 10, -20.0_mm);
  const std::string warning = "warning: the surface to feel is no level of the one shown";
  const Finished shown =
    press(R"({"name": "left", "unit": "mm", "file": "left.obj", "haptic": "right.obj"})", "shown");
  EXPECT_NE(shown.err.find(warning), std::string::npos) << shown.err;
  std::string scene = test::readAll(out("shown.json"));
  scene.erase(scene.find(R"(, "deformed")"), 12); // so that nobody looks at it
  std::ofstream(out("felt.json")) << scene;
  const Finished felt =
    test::palp("scene " + out("felt.json").string() + " --out " + out("felt").string());
  EXPECT_NE(felt.err.find(warning), std::string::npos) << felt.err;
}

TEST_F(OrganScene, TellsWhichOrganWasPressedAndLeavesThatDeformed)
{
  const Finished finished = press(std::string(kLeft) + ',' + kRight, "both");
  EXPECT_NE(finished.err.find(" mm in left, force "), std::string::npos) << finished.err;
  const std::string header = test::readAll(out("both") / "samples.csv");
  EXPECT_NE(header.find("# organ left: Young's modulus: 5 kPa, Poisson's ratio: 0.45, "),
    std::string::npos);
  EXPECT_NE(header.find("# organ right: Young's modulus: 60 kPa, Poisson's ratio: 0.3, "),
    std::string::npos);
  const std::string presses = rows("both", "presses.csv");
  EXPECT_NE(presses.find("\n\"press 1\",\"left\","), std::string::npos) << presses;
  EXPECT_NE(presses.find("\n\"press 2\",\"right\","), std::string::npos) << presses;
  EXPECT_NEAR(middleOf("both"), -30.0, 0.5);
  ASSERT_EQ(press(std::string(kRight) + ',' + kFar, "right").code, 0);
  EXPECT_NEAR(middleOf("right"), 30.0, 0.5);
}

// The way to the place on the ball at the left is 31.2 mm beside the middle of the other one, whose
// radius is 30 mm: with a ball of 6 mm that is met 2 mm earlier.
TEST_F(OrganScene, TellsOfAPressThatMeetsAnotherOrganThanItsPlaces)
{
  const auto placed = [&](const std::string& organs, const std::string& name)
  {
    std::ofstream(out(name + ".json"))
      << R"({"palp_scene": 1, "organs": [)" << organs << R"(], "presses": {"depth": "2mm",
        "places": [{"at": ["-30mm", "0mm", "30mm"]}, {"name": "gap", "at":
        ["-10mm", "0mm", "22.36mm"]}]}, "window": false, "exports": ["samples"],
        "tool": "sphere:6mm"})";
    return test::palp("scene " + out(name + ".json").string() + " --out " + out(name).string());
  };
  const Finished alone = placed(kLeft, "alone");
  ASSERT_EQ(alone.code, 0) << alone.err;
  EXPECT_EQ(alone.err.find("the place"), std::string::npos) << alone.err;
  const char* beside = R"(,{"name": "right", "bundled": "sphere_30", "frame":
    {"origin": ["6.6mm", "0mm", "-5.9mm"]}})";
  const Finished both = placed(std::string(kLeft) + beside, "both");
  ASSERT_EQ(both.code, 0) << both.err;
  EXPECT_EQ(both.err.find("-30,0,30"), std::string::npos) << both.err;
  EXPECT_NE(
    both.err.find("the place gap, -10,0,22.36 mm is on left, but the tool meets right first"),
    std::string::npos)
    << both.err;
  EXPECT_NE(rows("both", "presses.csv").find("\"gap\",\"right\""), std::string::npos);
  const Finished covered =
    placed(std::string(kLeft) + R"(,{"name": "skin", "bundled": "sphere_100"})", "covered");
  EXPECT_EQ(covered.code, 2);
  EXPECT_NE(
    covered.err.find("is on left, but a tool comes to it through skin only"), std::string::npos)
    << covered.err;
}

TEST_F(OrganScene, IsRepeatedToTheByte)
{
  ASSERT_EQ(press(std::string(kSkin) + ',' + kLeft + ',' + kRight, "both").code, 0);
  const Finished again =
    test::palp("run " + out("both").string() + " --out " + out("again").string());
  EXPECT_EQ(again.code, 0);
  EXPECT_NE(again.err.find("repeated to the byte"), std::string::npos) << again.err;
}

TEST_F(OrganScene, ARecordingFeelsTheOrgansThatItNames)
{
  const std::string both = std::string(kLeft) + ',' + kRight;
  ASSERT_EQ(press(both, "both").code, 0);
  const std::string recorded = R"(, "recording": {"file": "both/samples.csv"})";
  ASSERT_EQ(press(both, "again", recorded).code, 0);
  EXPECT_EQ(rows("again"), rows("both"));
  const Finished other = press(kLeft, "other", recorded);
  EXPECT_EQ(other.code, 2);
  EXPECT_NE(other.err.find("'right' is no organ that the scene feels"), std::string::npos)
    << other.err;
}

TEST_F(OrganScene, APlaceIsPressedOnTheNearestOrgan)
{
  const std::string places = R"(, "presses": {"depth": "2mm", "places":
    [{"at": ["30mm", "0mm", "30mm"]}, {"at": ["-30mm", "0mm", "30mm"]}]})";
  std::string scene = R"({"palp_scene": 1, "organs": [)" + std::string(kLeft) + ',' + kRight +
    R"(], "window": false, "exports": ["samples"], "tool": "sphere:6mm", "dent": {"surface": "none"})" +
    places + "}";
  std::ofstream(out("places.json")) << scene;
  ASSERT_EQ(
    test::palp("scene " + out("places.json").string() + " --out " + out("places").string()).code,
    0);
  const std::string presses = rows("places", "presses.csv");
  EXPECT_NE(presses.find("\n\"press 1\",\"right\","), std::string::npos) << presses;
  EXPECT_NE(presses.find("\n\"press 2\",\"left\","), std::string::npos) << presses;
}

} // namespace
} // namespace palp
