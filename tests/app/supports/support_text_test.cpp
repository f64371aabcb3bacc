#include "app/supports/support_text.h"

#include "calibration/organ/organ_compliance.h"
#include "data/shapes.h"
#include "haptics/error.h"
#include "haptics/units.h"
#include "tests/app/supports/slabs.h"
#include "tests/support/process.h"

#include <fstream>
#include <gtest/gtest.h>

namespace palp
{
namespace
{

using namespace units::literals;

const Surface& block()
{
  static const Surface surface = []
  {
    Mesh mesh = makeBox({ 100.0_mm, 100.0_mm, 50.0_mm }, 5.0_mm);
    return Surface(std::move(mesh.points), std::move(mesh.triangles));
  }();
  return surface;
}

TEST(SupportText, HoldsTheSurfaceThere)
{
  const Support box = parseSupport("bonded:box:-50,-50,-50:50,50,-45", block());
  EXPECT_TRUE(box.along.isZero());
  EXPECT_TRUE(box.holds({ 50.0_mm, 0.0, -45.1_mm }));
  EXPECT_FALSE(box.holds({ 50.0_mm, 0.0, -44.9_mm }));
  const Support base = parseSupport("sliding:direction:0,0,-2:30deg", block());
  EXPECT_NEAR(base.along.z(), -1.0, 1e-12);
  EXPECT_TRUE(base.holds({ 0.0, 10.0_mm, -50.0_mm }));
  EXPECT_FALSE(base.holds({ 0.0, 10.0_mm, 0.0 }));
}

TEST(SupportText, OfAPatientIsToldWhereAxesAreNotKnown)
{
  for (const char* support : { "posterior", "sliding:hilum", "bonded:ligaments" })
  {
    std::vector<std::string> notes;
    noteAxes({ "bonded:direction:0,1,0:60deg", support }, "LPS", notes);
    EXPECT_TRUE(notes.empty());
    noteAxes({ "bonded:direction:0,1,0:60deg", support }, "", notes);
    ASSERT_EQ(notes.size(), 1U);
    EXPECT_NE(notes[0].find(std::string(support) + " takes y to the back"), std::string::npos);
  }
  std::vector<std::string> notes;
  noteAxes({ "bonded:direction:0,1,0:60deg", "bonded:points:posterior" }, "", notes);
  EXPECT_TRUE(notes.empty());
}

// it faces the same way as the base, but rests on nothing
TEST(SupportText, HoldsNoWallOfAHollow)
{
  Mesh hollow = makeBox({ 100.0_mm, 100.0_mm, 50.0_mm }, 5.0_mm);
  const Mesh cavity = makeBox({ 40.0_mm, 40.0_mm, 20.0_mm }, 5.0_mm);
  const int shift = static_cast<int>(hollow.points.size());
  for (const Eigen::Vector3d& point : cavity.points)
  {
    hollow.points.push_back(point - Eigen::Vector3d(0.0, 0.0, 15.0_mm));
  }
  for (const Triangle& t : cavity.triangles)
  {
    hollow.triangles.push_back({ t[0] + shift, t[2] + shift, t[1] + shift });
  }
  const Surface surface(hollow.points, hollow.triangles);
  const Support base = parseSupport("bonded:direction:0,0,-1:10deg", surface);
  EXPECT_TRUE(base.holds({ 10.0_mm, 0.0, -50.0_mm }));
  EXPECT_FALSE(base.holds({ 10.0_mm, 0.0, -15.0_mm }));
}

// all of it holds bonded; across no direction does it slide
TEST(SupportText, HoldsAllOfABodyButForSliding)
{
  const std::string all = ":box:-51,-51,-51:51,51,1";
  EXPECT_TRUE(parseSupport("bonded" + all, block()).holds({ 0.0, 0.0, 0.0 }));
  EXPECT_THROW((void)parseSupport("sliding" + all, block()), Error);
}

TEST(SupportText, HoldsWhatTouchesAnotherLabel)
{
  Mesh below = makeBox({ 40.0_mm, 40.0_mm, 20.0_mm }, 5.0_mm);
  for (Eigen::Vector3d& point : below.points)
  {
    point.z() -= 51.0_mm;
  }
  const auto region = std::make_shared<const Surface>(below.points, below.triangles);
  const auto find = [&](const std::string& label)
  {
    EXPECT_EQ(label, "7");
    return SupportRegion{ region, 1.5_mm };
  };
  const Support support = parseSupport("sliding:label:7", block(), find);
  EXPECT_NEAR(support.along.z(), -1.0, 1e-9);
  EXPECT_TRUE(support.holds({ 10.0_mm, 0.0, -50.0_mm }));
  EXPECT_TRUE(support.holds({ 21.0_mm, 0.0, -50.0_mm }));
  EXPECT_FALSE(support.holds({ 22.0_mm, 0.0, -50.0_mm }));
  EXPECT_FALSE(support.holds({ 10.0_mm, 0.0, 0.0 }));
}

// a block that stands as a patient's liver: y to the back, z to the head
TEST(SupportText, HoldsALiverByWhatHoldsIt)
{
  const Support back = parseSupport("posterior", block());
  EXPECT_TRUE(back.along.isZero());
  EXPECT_TRUE(back.holds({ 10.0_mm, 50.0_mm, -20.0_mm }));
  EXPECT_FALSE(back.holds({ 10.0_mm, -50.0_mm, -20.0_mm }));
  EXPECT_FALSE(back.holds({ 10.0_mm, 0.0, 0.0 }));
  const Support slides = parseSupport("sliding:posterior", block());
  EXPECT_NEAR(slides.along.y(), 1.0, 1e-12);
  const Support hilum = parseSupport("bonded:hilum", block());
  EXPECT_TRUE(hilum.holds({ 12.0_mm, -12.0_mm, -50.0_mm }));
  EXPECT_FALSE(hilum.holds({ 25.0_mm, 0.0, -50.0_mm }));
  EXPECT_FALSE(hilum.holds({ 0.0, 0.0, 0.0 }));
  const Mesh ball = makeSphere(40.0_mm, 3);
  const Surface round(ball.points, ball.triangles);
  const Support hangs = parseSupport("ligaments", round);
  const Eigen::Vector3d above(0.0, std::sqrt(0.5), std::sqrt(0.5));
  EXPECT_TRUE(hangs.holds(40.0_mm * above));
  EXPECT_FALSE(hangs.holds({ 0.0, 0.0, 40.0_mm }));
  EXPECT_FALSE(hangs.holds({ 0.0, 40.0_mm, 0.0 }));
}

// points every half of a millimeter over a half of the base
std::filesystem::path paintedHalf(const std::filesystem::path& folder)
{
  const auto file = folder / "half painted.csv";
  std::ofstream out(file);
  out << "x_mm,y_mm,z_mm\n";
  for (double x = -49.75; x < 0.0; x += 0.5)
  {
    for (double y = -49.75; y < 50.0; y += 0.5)
    {
      out << x << ',' << y << ",-50\n";
    }
  }
  return file;
}

TEST(SupportText, PaintIsAsStiffAsABoxOfTheSameSurface)
{
  const test::TemporaryFolder folder;
  const Support box = parseSupport("bonded:box:-51,-51,-51:0,51,-49.9", block());
  const Support painted =
    parseSupport("bonded:points:" + paintedHalf(folder.path()).string(), block());
  const auto compliance = [](const Support& support, double x)
  {
    const OrganModel model(block(), 7.0_mm, 50.0_kPa, 0.45, std::span(&support, 1));
    const auto found = complianceAt(model, block(), { x, 5.0_mm, 0.0 }, Eigen::Vector3d::UnitZ());
    return found ? model.contactModulus() * found->constant : 0.0;
  };
  for (const double x : { -25.0_mm, 25.0_mm })
  {
    const double known = compliance(box, x);
    EXPECT_NEAR(compliance(painted, x), known, 0.01 * std::abs(known)) << x;
  }
  EXPECT_GT(compliance(box, 25.0_mm), 1.5 * std::abs(compliance(box, -25.0_mm))) << "it tells";
  const Support slides =
    parseSupport("sliding:points:" + (folder.path() / "half painted.csv").string(), block());
  EXPECT_LT((slides.along + Eigen::Vector3d::UnitZ()).norm(), 1e-9);
}

TEST(SupportText, RefusesPointsThatAreNone)
{
  const test::TemporaryFolder folder;
  const auto file = folder.path() / "rest.csv";
  const auto refusal = [&](const char* text)
  {
    std::ofstream(file) << text;
    try
    {
      (void)parseSupport("bonded:points:" + file.string(), block());
    }
    catch (const Error& error)
    {
      EXPECT_NE(std::string(error.what()).find("rest.csv"), std::string::npos) << error.what();
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(refusal(""), "");
  EXPECT_NE(refusal("0,0,-50\n"), "") << "without a header";
  EXPECT_NE(refusal("x_mm,y_mm,z_mm\n").find("no point"), std::string::npos);
  EXPECT_NE(refusal("x_mm,y_mm,z_mm\n0,0,-50\n0,below,-50\n").find(":3:"), std::string::npos);
  EXPECT_NE(refusal("x_mm,y_mm,z_mm\n0,0,nan\n"), "");
  const std::string away = refusal("x_mm,y_mm,z_mm\n0,0,-50\n0,0,-60\n");
  EXPECT_NE(away.find(":3: the point is 10 mm away"), std::string::npos) << away;
  std::filesystem::remove(file);
  EXPECT_THROW((void)parseSupport("bonded:points:" + file.string(), block()), Error);
  EXPECT_THROW((void)parseSupport("bonded:points:", block()), Error);
  EXPECT_THROW((void)parseSupport("glued:points:" + file.string(), block()), Error);
}

// what an organ file says of them, which a file of points that holds something else is not
TEST(SupportText, AnOrganFileTellsItsSupportsAgain)
{
  const test::TemporaryFolder folder;
  const std::string file = paintedHalf(folder.path()).string();
  const std::vector<std::string> supports{ "posterior", "bonded:points:" + file,
    "sliding:box:0,0,0:1,2,3" };
  const std::string told = describeSupports(supports, folder.path());
  EXPECT_EQ(told.find(folder.path().string()), std::string::npos) << "both may go elsewhere";
  EXPECT_EQ(supportsIn(told, folder.path()), supports);
  EXPECT_NO_THROW(checkSupports(supports, folder.path() / "x.organ", told));
  std::ofstream(file, std::ios::app) << "1,1,-50\n";
  EXPECT_THROW(checkSupports(supports, folder.path() / "x.organ", told), Error);
  EXPECT_NO_THROW(checkSupports({}, folder.path() / "x.organ", told)) << "none are asked for";
}

TEST(SupportText, RefusesWhatItDoesNotKnow)
{
  for (const char* text :
    { "", "bonded", "glued:box:0,0,0:1,1,1", "bonded:sphere:0,0,0:1,1,1", "bonded:box:0,0:1,1,1",
      "bonded:box:200,200,200:210,210,210", "bonded:direction:0,0,0:30deg",
      "bonded:direction:0,0,1:30", "bonded:direction:0,0,1:0deg", "bonded:direction:0,0,1:-5deg",
      "bonded:direction:0,0,1:200deg", "bonded:box:0,0,0:1,1,1:2",
      "bonded:label:", "bonded:label:7", "anterior", "glued:hilum", "posterior:60deg" })
  {
    EXPECT_THROW(parseSupport(text, block()), Error) << text;
  }
}

class SupportCommand : public testing::Test
{
protected:
  void SetUp() override
  {
    const std::string out = (folder_.path() / "made").string();
    ASSERT_EQ(test::runCommand(PALP_PROGRAM " phantom block --voxel 5mm --out " + out).code, 0);
    block_ = out + "/block.vtp";
  }

  test::Finished organ(const std::string& arguments)
  {
    return test::runCommand(
      PALP_PROGRAM " organ " + block_ + " --cell 5mm --poisson 0.45 " + arguments);
  }

  static std::vector<double> columnOf(const std::string& csv, int column)
  {
    std::vector<double> values;
    std::istringstream lines(csv);
    std::string line;
    for (std::getline(lines, line); std::getline(lines, line);)
    {
      std::istringstream cells(line);
      std::string cell;
      for (int i = 0; i <= column; ++i)
      {
        std::getline(cells, cell, ',');
      }
      values.push_back(std::stod(cell));
    }
    return values;
  }

  test::TemporaryFolder folder_;
  std::string block_;
};

// the middle of the paper's block, by elements of another program
TEST_F(SupportCommand, TellsTheForceOfTheBlockAndThatOfAHalfSpace)
{
  for (const char* support :
    { "bonded:direction:0,0,-1:30deg", "bonded:box:-50,-50,-51:50,50,-50" })
  {
    const test::Finished finished =
      organ(std::string("--at 0,0,0 --depth 2:4:2mm --support ") + support);
    ASSERT_EQ(finished.code, 0) << finished.err;
    const std::vector<double> forces = columnOf(finished.out, 6);
    ASSERT_EQ(forces.size(), 2U);
    EXPECT_NEAR(forces[0], 0.790771, 0.02 * forces[0]) << support;
    EXPECT_NEAR(forces[1], 2.26695, 0.02 * forces[1]) << support;
    const test::Finished two =
      organ(std::string("--at 0,0,0 --at=-20,5,0 --depth 2:2:1mm --support ") + support);
    EXPECT_EQ(columnOf(two.out, 0), (std::vector{ 0.0, -20.0 }));
  }
}

// a slab of 80 x 80 x 20 mm on another one: the exact bonded layer
TEST_F(SupportCommand, HoldsALabelByAnotherOfItsImage)
{
  const auto image = folder_.path() / "slabs.nrrd";
  test::writeSlabs(image, 40, 20);
  const auto pressed = [&](const std::string& support)
  {
    return test::runCommand(PALP_PROGRAM " organ " + image.string() +
      " --label 3 --cell 4mm --poisson 0.45 --depth 2:4:2mm --at=1,1,-4 --support " + support);
  };
  const test::Finished finished = pressed("bonded:label:7");
  ASSERT_EQ(finished.code, 0) << finished.err;
  const std::vector<double> forces = columnOf(finished.out, 6);
  ASSERT_EQ(forces.size(), 2U);
  EXPECT_NEAR(forces[0], 0.94715239, 0.02 * forces[0]);
  EXPECT_NEAR(forces[1], 2.9208349, 0.02 * forces[1]);
  for (const char* itself : { "bonded:label:3", "sliding:label:0" })
  {
    const test::Finished refused = pressed(itself);
    EXPECT_EQ(refused.code, 2) << itself;
    EXPECT_NE(refused.err.find("does not rest"), std::string::npos) << refused.err;
  }
  const test::Finished missing = pressed("bonded:label:9");
  EXPECT_EQ(missing.code, 2);
  EXPECT_NE(missing.err.find('9'), std::string::npos) << missing.err;
}

TEST_F(SupportCommand, RefusesInOneSentence)
{
  const char* base = "--support bonded:direction:0,0,-1:30deg ";
  for (const std::string& arguments :
    { std::string(base), std::string("--at 0,0,0"), std::string(base) + "--at 0,0,30",
      std::string("--at 0,0,0 --support sliding:direction:0,0,-1:30deg"),
      std::string(base) + "--at 0,0,0 --poisson 0.5",
      std::string("--at 0,0,0 --support bonded:label:7") })
  {
    const test::Finished finished = organ(arguments);
    EXPECT_EQ(finished.code, 2) << arguments << finished.out;
    EXPECT_EQ(finished.out, "") << arguments;
  }
}

} // namespace
} // namespace palp
