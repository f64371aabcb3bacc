#include "app/organs/organ_list.h"
#include "tests/app/window/check_rig.h"

#include <gtest/gtest.h>
#include <map>

namespace palp
{
namespace
{

using namespace test;

class Check : public CheckTest
{
};

// whatever the docks beside it want
TEST_F(Check, FitsALowScreen)
{
  openBroken({ .crossing = true });
  for (const QSize screen : { QSize(1024, 768), QSize(1280, 720) })
  {
    const QSize size = screen - QSize(16, 48);
    window_->resize(size);
    EXPECT_TRUE(QTest::qWaitFor([&] { return window_->size() == size; }, kPatience))
      << window_->height();
    EXPECT_GT(table()->viewport()->visibleRegion().boundingRect().height(), 20) << size.height();
  }
}

TEST_F(Check, TellsWhatTheCommandLineTells)
{
  openBroken({ .crossing = true });
  const test::Finished printed = command(path("block.obj"));
  EXPECT_EQ(rows(), rowsOf(printed.out));
  const std::map<std::string, Place> made{ { "duplicate triangle", kDuplicate },
    { "sliver", kSliver }, { "flipped triangle", kFlipped }, { "hole", kHole },
    { "self-intersecting triangle", kCrossing } };
  for (const auto& [fault, place] : made)
  {
    EXPECT_LT((placeOf(fault) - place).norm(), 6.0) << fault;
    EXPECT_EQ(verdict().find(fault) != std::string::npos, fault != "flipped triangle") << verdict();
  }
  const double side = 64.0 / 13.0; // in so many parts; across it the diagonal
  EXPECT_NEAR(std::stod(rows()[static_cast<std::size_t>(rowOf("hole"))][3]),
    (2.0 + std::sqrt(2.0)) * side, 0.001)
    << "the widest; a triangle that hangs has less around";
  const Mesh mesh = broken({ .crossing = true });
  EXPECT_NE(measures().find("block.obj: " + std::to_string(mesh.points.size()) + " points, " +
              std::to_string(mesh.triangles.size()) + " triangles, 64 x 64 x "),
    std::string::npos)
    << measures();
  std::istringstream lines(measures());
  for (std::string line; std::getline(lines, line);)
  {
    EXPECT_NE(printed.out.find("# " + line + "\n"), std::string::npos) << line;
  }
}

TEST_F(Check, MarksWhatIsChosenElseWhatDisturbsAPress)
{
  openBroken({});
  lookFromAbove();
  for (const Place& place : { kHole, kDuplicate, kSliver })
  {
    EXPECT_GT(marks(place), 100) << place.transpose();
  }
  EXPECT_EQ(marks(kFlipped), 0) << "which loading turns";
  table()->selectRow(rowOf("flipped triangle"));
  EXPECT_GT(marks(kFlipped), 100);
  EXPECT_EQ(marks(kHole) + marks(kDuplicate) + marks(kSliver), 0);
  dock()->findChild<QPushButton*>("markAllFaults")->click();
  EXPECT_GT(marks(kHole), 100);
  EXPECT_EQ(marks(kFlipped), 0);
  dock()->close();
  EXPECT_EQ(marks(), 0);
  window_->findChild<QAction*>("checkAction")->trigger();
  EXPECT_GT(marks(kHole), 100);
  ASSERT_TRUE(window_->openFile(PALP_SHARE "/meshes/sphere_50.vtp"));
  EXPECT_FALSE(dock()->isVisible());
  EXPECT_EQ(marks(), 0);
}

// from the keyboard alone
TEST_F(Check, TurnsThePictureToAFault)
{
  write(path("block.obj"), broken({ .hole = false, .below = true }));
  ASSERT_TRUE(open("block.obj"));
  QTest::keyClick(window_.get(), Qt::Key_F7);
  ASSERT_TRUE(
    QTest::qWaitFor([this] { return dock() != nullptr && table()->hasFocus(); }, kPatience));
  lookFromAbove();
  for (QTest::keyClick(table(), Qt::Key_Down); table()->currentRow() != rowOf("hole");)
  {
    QTest::keyClick(table(), Qt::Key_Down);
  }
  EXPECT_EQ(marks(), 0) << "on the other side";
  QTest::keyClick(table(), Qt::Key_Return);
  EXPECT_GT(marks(placeOf("hole")), 100);
  vtkRenderer& renderer = *canvas_->renderWindow()->GetRenderers()->GetFirstRenderer();
  renderer.SetWorldPoint(1e-3 * kBelow.x(), 1e-3 * kBelow.y(), 1e-3 * kBelow.z(), 1.0);
  renderer.WorldToDisplay();
  const double* at = renderer.GetDisplayPoint();
  const int* size = canvas_->renderWindow()->GetSize();
  EXPECT_NEAR(at[0], size[0] / 2.0, size[0] / 4.0);
  EXPECT_NEAR(at[1], size[1] / 2.0, size[1] / 4.0);
}

TEST_F(Check, SaysThatThereIsNoFault)
{
  ASSERT_TRUE(window_->openFile(PALP_SHARE "/meshes/block_50.vtp"));
  check();
  EXPECT_EQ(rows(), Rows{});
  EXPECT_TRUE(verdict().starts_with("No fault")) << verdict();
  EXPECT_EQ(marks(), 0);
}

// the bundled one is felt by fewer triangles than are shown
TEST_F(Check, IsOfWhatIsFelt)
{
  check();
  EXPECT_TRUE(measures().starts_with("liver_haptic.vtp: ")) << measures();
  EXPECT_EQ(rows(), rowsOf(command(PALP_SHARE "/meshes/liver_haptic.vtp").out));
}

TEST_F(Check, IsOfOneFile)
{
  write(path("one.obj"), broken({}));
  write(path("two.obj"), broken({}));
  std::ofstream(path("both.json")) << R"({"palp_scene": 1, "meshes": [
    {"file": "one.obj", "unit": "mm"},
    {"file": "two.obj", "unit": "mm", "frame": {"origin": ["100mm", "0mm", "0mm"]}}]})";
  ASSERT_TRUE(window_->openFiles({ QString::fromStdString(path("both.json").string()) }));
  check();
  EXPECT_EQ(dock(), nullptr);
  EXPECT_TRUE(said().contains("is of several files")) << said().toStdString();
}

TEST_F(Check, SaysThatTheFileIsGoneOrAnother)
{
  openBroken({});
  dock()->close();
  std::ofstream(path("block.obj"), std::ios::app) << "# more\n";
  check();
  EXPECT_TRUE(said().contains("block.obj: is another file")) << said().toStdString();
  std::filesystem::remove(path("block.obj"));
  check();
  EXPECT_TRUE(said().contains("block.obj: is there no longer")) << said().toStdString();
  EXPECT_FALSE(dock()->isVisible());
}

TEST_F(Check, OfSeveralOrgansTheChosenOneWhereItStands)
{
  write(path("left.obj"), broken({}));
  write(path("right.obj"), broken({ .crossing = true }));
  std::ofstream(path("two.json")) << R"({"palp_scene": 1, "organs": [
    {"name": "left", "file": "left.obj", "unit": "mm"},
    {"name": "right", "file": "right.obj", "unit": "mm",
     "frame": {"origin": ["100mm", "0mm", "0mm"]}}]})";
  ASSERT_TRUE(window_->openFiles({ QString::fromStdString(path("two.json").string()) }));
  const Place aside(100.0, 0.0, 0.0);
  auto* organs = window_->findChild<OrganList*>("organs");
  organs->choose("right");
  check();
  EXPECT_TRUE(measures().starts_with("right.obj")) << measures();
  EXPECT_LT((placeOf("self-intersecting triangle") - kCrossing - aside).norm(), 6.0);
  lookFromAbove();
  EXPECT_GT(marks(kDuplicate + aside), 100);
  EXPECT_EQ(marks(kDuplicate), 0);
  organs->choose("left");
  check();
  EXPECT_TRUE(measures().starts_with("left.obj")) << measures();
  EXPECT_GT(marks(kDuplicate), 100);
  EXPECT_EQ(marks(kDuplicate + aside), 0);
}

// in cm and in RAS, as 3D Slicer writes it
TEST_F(Check, PlacesAreThoseThatAPressTakes)
{
  write(path("ras.obj"), broken({}), { -100.0, -100.0, 100.0 }, "# SPACE=RAS\n");
  std::ofstream(path("ras.json"))
    << R"({"palp_scene": 1, "meshes": [{"file": "ras.obj", "unit": "cm"}]})";
  ASSERT_TRUE(window_->openFiles({ QString::fromStdString(path("ras.json").string()) }));
  ASSERT_EQ(session_->body().unit, "cm");
  check();
  EXPECT_EQ(rows(), rowsOf(command(path("ras.obj"), "--unit cm").out));
  EXPECT_LT((placeOf("sliver") - kSliver).norm(), 6.0);
  lookFromAbove();
  EXPECT_GT(marks(kSliver), 100);
  const std::string place = rows()[static_cast<std::size_t>(rowOf("sliver"))][2];
  const test::Finished run = test::runCommand(PALP_PROGRAM " run " + path("ras.obj").string() +
    " --unit cm --at " + place + " --depth 1mm --speed 10mm/s --out " + path("out").string());
  EXPECT_EQ(run.code, 0) << run.err;
}

} // namespace
} // namespace palp
