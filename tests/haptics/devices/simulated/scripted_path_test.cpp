#include "haptics/devices/simulated/scripted_path.h"

#include "haptics/devices/simulated/scripted_device.h"
#include "haptics/error.h"
#include "haptics/units.h"
#include "tests/support/process.h"

#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <limits>
#include <ostream>

namespace palp
{
namespace
{

using namespace units::literals;
using Eigen::Vector3d;

const Vector3d kDownward = -Vector3d::UnitZ();

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinite = std::numeric_limits<double>::infinity();

const char* const kPress = "# a press of 5 mm and back\n"
                           "time_s,x_mm,y_mm,z_mm\n"
                           "0.5,10,-20,5\r\n"
                           "\n"
                           "1.5,10,-20,-5\n"
                           " 3.5 , 10 ,\t-20, 5\n";

TEST(ScriptedPath, GoesStraightFromKnotToKnotAtConstantSpeed)
{
  const ScriptedPath path = parsePath(kPress, "press.csv");
  EXPECT_DOUBLE_EQ(path.startTime(), 0.5);
  EXPECT_DOUBLE_EQ(path.duration(), 3.0);
  EXPECT_FALSE(path.hasAxes());

  const ToolPose pose = path.poseAt(0.75, kDownward);
  EXPECT_TRUE(pose.apex.isApprox(Vector3d(10.0_mm, -20.0_mm, 2.5_mm), 1e-15));
  EXPECT_TRUE(pose.velocity.isApprox(Vector3d(0, 0, -10.0_mm), 1e-12)); // per second
  EXPECT_EQ(pose.axis, kDownward);
  EXPECT_TRUE(path.poseAt(2.5, kDownward).velocity.isApprox(Vector3d(0, 0, 5.0_mm), 1e-12));
}

TEST(ScriptedPath, MeetsEveryKnotExactly)
{
  const ScriptedPath path = parsePath(kPress, "press.csv");
  for (const PathKnot& knot : path.knots())
  {
    EXPECT_EQ(path.poseAt(knot.time, kDownward).apex, knot.apex) << knot.time;
  }
  EXPECT_GT(
    path.poseAt(3.5, kDownward).velocity.z(), 0.0); // the last piece still counts at its end
}

TEST(ScriptedPath, RestsBeforeItsStartAndAfterItsEnd)
{
  const ScriptedPath path = parsePath(kPress, "press.csv");
  for (const double time : { -kInfinite, 0.0, 0.4999, 3.5001, kInfinite, kNotANumber })
  {
    const ToolPose pose = path.poseAt(time, kDownward);
    EXPECT_EQ(pose.velocity, Vector3d::Zero()) << time;
    EXPECT_TRUE(pose.apex.isApprox(Vector3d(10.0_mm, -20.0_mm, 5.0_mm))) << time;
  }
}

TEST(ScriptedPath, TurnsTheAxisAsAUnitVector)
{
  const ScriptedPath path = parsePath("0,0,0,0,1,0,0\n1,0,0,0,0,0,-1.002\n", "turn.csv");
  EXPECT_TRUE(path.hasAxes());
  for (const double time : { 0.0, 0.25, 0.5, 0.9, 1.0 })
  {
    EXPECT_NEAR(path.poseAt(time, Vector3d::UnitY()).axis.norm(), 1.0, 1e-15) << time;
  }
  // half-way between two axes lies their bisector
  EXPECT_TRUE(path.poseAt(0.5, Vector3d::UnitY()).axis.isApprox(Vector3d(1, 0, -1).normalized()));
}

TEST(ScriptedPath, HasAnAxisEvenBetweenOppositeOnes)
{
  const ScriptedPath path = parsePath("0,0,0,0,0,0,1\n1,0,0,0,0,0,-1\n", "flip.csv");
  EXPECT_NEAR(path.poseAt(0.5, kDownward).axis.norm(), 1.0, 1e-15);
}

TEST(ScriptedPath, OneRowIsAToolThatRests)
{
  const ScriptedPath path = parsePath("time_s,x_mm,y_mm,z_mm\n2,1,2,3", "rest.csv");
  EXPECT_EQ(path.duration(), 0.0);
  EXPECT_TRUE(path.poseAt(2.0, kDownward).apex.isApprox(Vector3d(1.0_mm, 2.0_mm, 3.0_mm)));
  EXPECT_EQ(path.poseAt(2.0, kDownward).velocity, Vector3d::Zero());
}

struct BadPath
{
  const char* text;
  const char* message; // where, and a word of what
};

void PrintTo(const BadPath& path, std::ostream* stream)
{
  *stream << path.message;
}

class EveryBadPath : public ::testing::TestWithParam<BadPath>
{
};
INSTANTIATE_TEST_SUITE_P(ScriptedPath, EveryBadPath,
  ::testing::Values(BadPath{ "", "p.csv: no row" }, BadPath{ "# only words\n", "p.csv: no row" },
    BadPath{ "time_s,x_mm,y_mm,z_mm\n", "p.csv: no row" },
    BadPath{ "0,0,0,0\n0,0,0,1\n", "p.csv:2: the time does not increase" },
    BadPath{ "0,0,0,0\n\n# note\n-1,0,0,1\n", "p.csv:4: the time does not increase" },
    BadPath{ "0,0,0\n", "p.csv:1: a row has 4 or 7 columns" },
    BadPath{ "0,0,0,0,1\n", "p.csv:1: a row has 4 or 7 columns" },
    BadPath{ "0,0,0,0,0,0,1,9\n", "p.csv:1: a row has 4 or 7 columns" },
    BadPath{ "0,0,0,nan\n", "p.csv:1: \"nan\" is not a number" },
    BadPath{ "0,0,inf,0\n", "p.csv:1: \"inf\" is not a number" },
    BadPath{ "0,0,1e999,0\n", "p.csv:1: \"1e999\" is not a number" },
    BadPath{ "0,0,,0\n", "p.csv:1: \"\" is not a number" },
    BadPath{ "0;0;0;0\n", "p.csv:1: columns are not separated by commas" },
    BadPath{ "time_s;x_mm;y_mm;z_mm\n0;0;0;0\n", "p.csv:1: columns are not separated by commas" },
    BadPath{ "0\t0\t0\t0\n", "p.csv:1: columns are not separated by commas" },
    BadPath{ "0,0,1mm,0\n", "p.csv:1: \"1mm\" is not a number" },
    BadPath{ "time,x,y,z\n0,0,0,0\n", "p.csv:1: no column time_s; give time_s,x_mm" },
    BadPath{ "time_ms,x_mm,y_mm,z_mm\n0,0,0,0\n", "p.csv:1: no column time_s" },
    BadPath{ "0,0,0,0\n5e-7,0,0,1\n", "p.csv:2: less than 1 us after the row before" },
    BadPath{ "0,0,0,0\ntime_s,x_mm,y_mm,z_mm\n", "p.csv:2: \"time_s\" is not a number" },
    BadPath{ "0,0,0,20000\n", "p.csv:1: the position is farther than 10 m" },
    BadPath{ "0,0,0,0,0,0,0\n", "p.csv:1: the axis is not of length one" },
    BadPath{ "0,0,0,0,1,1,0\n", "p.csv:1: the axis is not of length one" }));

TEST_P(EveryBadPath, IsRefusedWithItsLine)
{
  try
  {
    (void)parsePath(GetParam().text, "p.csv");
    FAIL() << "accepted: " << GetParam().text;
  }
  catch (const Error& error)
  {
    EXPECT_EQ(error.code(), ErrorCode::BadFile);
    EXPECT_EQ(std::string(error.what()).find(GetParam().message), 0U) << error.what();
  }
}

TEST(ScriptedPath, NamesAFileThatIsNotThere)
{
  EXPECT_THROW((void)readPath("no/such/path.csv"), Error);
}

TEST(ScriptedPath, ReadsWhatWasWritten)
{
  const std::string file = (test::freshFolder() / "path.csv").string();
  std::ofstream(file) << kPress;
  EXPECT_EQ(readPath(file).knots().size(), 3U);
}

// as R and spreadsheets write it: names and words in quotes, a comma among them, a plus
TEST(ScriptedPath, ReadsQuotedNamesAndWords)
{
  for (const char* text : { "\"time_s\",\"x_mm\",\"y_mm\",\"z_mm\"\n0,1,2,53\n\"0.5\",1,2,49\n",
         "note,time_s,x_mm,y_mm,z_mm\n\"down, slow\",0,1,2,53\n\"the \"\"end\"\"\",0.5,1,2,49\n",
         "time_s,x_mm,y_mm,z_mm,note\n0,1,2,53,\n0.5,1,2,49,end\n",
         "hand,time_s,x_mm,y_mm,z_mm\nleft,0,1,2,53\nright,0.5,1,2,49\n",
         "time_s,x_mm,y_mm,z_mm,\r\n0,1,2,53,\r\n+0.5,+1,2,49,\r\n", "0,1,2,53,\n0.5,1,2,+49,\n" })
  {
    const ScriptedPath path = parsePath(text, "quoted.csv");
    ASSERT_EQ(path.knots().size(), 2U) << text;
    EXPECT_EQ(path.duration(), 0.5) << text;
    EXPECT_TRUE(path.knots()[1].apex.isApprox(Vector3d(1.0_mm, 2.0_mm, 49.0_mm), 1e-15)) << text;
  }
  EXPECT_THROW((void)parsePath("0,1,2,+-3\n", "signs.csv"), Error);
}

std::filesystem::path write(const test::TemporaryFolder& folder, const std::string& text)
{
  const std::filesystem::path file = folder.path() / "samples.csv";
  std::ofstream(file) << text;
  return file;
}

TEST(ScriptedPath, MayBeginWithAByteOrderMark)
{
  const test::TemporaryFolder folder;
  const ScriptedPath path = readPath(write(folder, "\xEF\xBB\xBFtime_s,x_mm,y_mm,z_mm\n2,1,2,3"));
  EXPECT_EQ(path.startTime(), 2.0);
  EXPECT_EQ(path.knots().size(), 1U);
}

TEST(ScriptedPath, RefusesKnotsThatBreakTheRules)
{
  EXPECT_THROW(ScriptedPath({}), Error);
  EXPECT_THROW(ScriptedPath({ PathKnot{ .time = kNotANumber } }), Error);
  EXPECT_THROW(ScriptedPath({ PathKnot{ .apex = Vector3d(kNotANumber, 0, 0) } }), Error);
  EXPECT_THROW(ScriptedPath({ PathKnot{ .axis = Vector3d(0, 0, kInfinite) } }), Error);
}

TEST(ScriptedDevice, PlaysThePathOnItsOwnClockAndCannotBePushed)
{
  ScriptedDevice device(parsePath(kPress, "press.csv"), kDownward);
  EXPECT_FALSE(device.limits().rendersForce);
  ASSERT_TRUE(device.exchange(Vector3d::Zero(), 0.0));
  for (int tick = 0; tick < 250; ++tick)
  {
    (void)device.exchange(Vector3d(0, 0, 100), 1.0_ms);
  }
  const auto pose = device.exchange(Vector3d::Zero(), 0.0);
  ASSERT_TRUE(pose);
  EXPECT_NEAR(pose->apex.z(), 2.5_mm, 1e-12);
}

TEST(Recording, IsReadByTheNamesOfItsColumns)
{
  const test::TemporaryFolder folder;
  const ScriptedPath path = readPath(write(folder,
    "# palp\n# force: N\r\n"
    "force_N,time_s,axis_x,axis_y,axis_z,tool_x_mm,tool_y_mm,tool_z_mm\n"
    "0.5,2,0,0.6,-0.8,1,2,3\n"
    "inf,2.001,0,0,-1,1,2,2.5\n"));
  ASSERT_EQ(path.knots().size(), 2U);
  EXPECT_EQ(path.startTime(), 2.0);
  EXPECT_TRUE(path.knots()[0].apex.isApprox(Vector3d(1.0_mm, 2.0_mm, 3.0_mm), 1e-15));
  EXPECT_TRUE(path.knots()[0].axis->isApprox(Vector3d(0.0, 0.6, -0.8), 1e-15));
  EXPECT_TRUE(path.knots()[1].axis->isApprox(kDownward, 1e-15));
}

TEST(Recording, SaysInOneSentenceWhatIsWrong)
{
  const std::string header = "time_s,tool_x_mm,tool_y_mm,tool_z_mm,axis_x,axis_y,axis_z\n";
  const std::pair<std::string, const char*> all[] = { { "time_s,tool_x_mm,z_mm\n",
                                                        "no column tool_y_mm" },
    { "time_s,x_mm,force_N\n", "no column y_mm" },
    { "time_s,x_mm,y_mm,z_mm,y_mm\n", "two columns y_mm" }, { header, "no row" },
    { header + "0,1,2,3,0,0\n", "samples.csv:2: a row of 6 columns below a header of 7" },
    { header + "0,1,2,three,0,0,-1\n", "\"three\" is not a number" },
    { header + "0,1,2,nan,0,0,-1\n", "samples.csv:2: \"nan\" is not a number" },
    { header + "1,1,2,3,0,0,-1\n1,1,2,3,0,0,-1\n", "samples.csv:3: the time does not increase" },
    { header + "0,1,2,3,0,0,0\n", "the axis is not of length one" } };
  for (const auto& [text, expected] : all)
  {
    const test::TemporaryFolder folder;
    try
    {
      (void)readPath(write(folder, text));
      ADD_FAILURE() << text;
    }
    catch (const Error& error)
    {
      EXPECT_EQ(error.code(), ErrorCode::BadFile);
      const std::string what = error.what();
      EXPECT_NE(what.find(expected), what.npos) << what;
      EXPECT_NE(what.find("samples.csv"), what.npos) << what;
      EXPECT_EQ(what.find('\n'), what.npos) << what;
    }
  }
  EXPECT_THROW((void)readPath("/nowhere/samples.csv"), Error);
}

// of two presses the way between is not in the file, and could lead through the body
TEST(ScriptedPath, StaysWhereARecordingLeavesSamplesOut)
{
  const std::string rows = "0.000,0,0,1,0\n0.001,0,0,-1,1\n0.002,0,0,1,0\n"
                           "5.000,90,0,1,0\n5.001,90,0,-1,1\n";
  const std::string names = "tool_x_mm,tool_y_mm,tool_z_mm,depth_mm\n";
  const ScriptedPath recorded = parsePath("time_s," + names + rows, "samples.csv");
  for (const double time : { 0.002, 1.0, 4.999 })
  {
    EXPECT_EQ(recorded.poseAt(time, kDownward).apex, Vector3d(0.0, 0.0, 1.0_mm)) << time;
  }
  EXPECT_EQ(recorded.poseAt(5.0, kDownward).apex, Vector3d(90.0_mm, 0.0, 1.0_mm));
  // in contact, and in a path that somebody wrote, the way is straight
  const ScriptedPath written = parsePath("0,0,0,1\n1,90,0,1\n", "press.csv");
  EXPECT_NEAR(written.poseAt(0.5, kDownward).apex.x(), 45.0_mm, 1e-15);
  const ScriptedPath held =
    parsePath("time_s," + names + "0,0,0,-1,1\n1,90,0,-1,1\n", "samples.csv");
  EXPECT_NEAR(held.poseAt(0.5, kDownward).apex.x(), 45.0_mm, 1e-15);
}

} // namespace
} // namespace palp
