#include "app/folder/autosave.h"
#include "app/panels/press_list.h"
#include "tests/app/window/window_rig.h"

#include <QAction>
#include <QComboBox>
#include <QMenu>
#include <QTabBar>
#include <QToolButton>
#include <QTreeWidget>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <optional>

namespace palp
{
namespace
{

using test::WindowTest;

class PressListTest : public WindowTest
{
protected:
  [[nodiscard]] QTreeWidget& rows() const
  {
    return *window_->findChild<QTreeWidget*>("pressRows");
  }

  // a press that ends in a row of its own
  void pressOnce(int pixelsDown)
  {
    const int before = rows().topLevelItemCount();
    press(pixelsDown);
    release();
    waitForRows(before + 1);
  }

  void waitForRows(int count) const
  {
    EXPECT_TRUE(QTest::qWaitFor([&] { return rows().topLevelItemCount() == count; }, kPatience))
      << rows().topLevelItemCount();
  }

  // by its title
  [[nodiscard]] QString cell(int row, const QString& column) const
  {
    for (int i = 0; i < rows().columnCount(); ++i)
    {
      if (rows().headerItem()->text(i) == column)
      {
        return rows().topLevelItem(row)->text(i);
      }
    }
    ADD_FAILURE() << column.toStdString();
    return {};
  }

  void act(const QString& text) const
  {
    for (QAction* action : window_->findChildren<QAction*>())
    {
      if (action->text().remove('&').startsWith(text) && action->isEnabled())
      {
        return action->trigger();
      }
    }
    ADD_FAILURE() << text.toStdString() << " is not there";
  }
};

// F = E/(1 - nu^2) 4/3 sqrt(R) d^1.5, of the paper's Eq. (2)
TEST_F(PressListTest, ListsEachPressAndKeepsItUnderAnotherTool)
{
  pressOnce(60);
  type("young", "20");
  type("radius", "5");
  pressOnce(80);
  ASSERT_EQ(rows().topLevelItemCount(), 2);
  EXPECT_EQ(cell(0, "Tool"), "sphere:10mm");
  EXPECT_EQ(cell(1, "Tool"), "sphere:5mm");
  EXPECT_EQ(cell(1, "E [kPa]"), "20.0");
  const std::vector<double> radii{ 10e-3, 5e-3 };
  const std::vector<double> moduli{ 50e3, 20e3 };
  for (int i = 0; i < 2; ++i)
  {
    const auto at = static_cast<std::size_t>(i);
    const double depth = 1e-3 * cell(i, "δ max [mm]").toDouble();
    const double force =
      4.0 / 3.0 * moduli[at] / (1.0 - 0.33 * 0.33) * std::sqrt(radii[at]) * std::pow(depth, 1.5);
    EXPECT_GT(depth, 2e-3);
    EXPECT_NEAR(cell(i, "F max [N]").toDouble(), force, 0.01 + 0.01 * force);
  }
}

TEST_F(PressListTest, PressesAgainAtTheSamePlaceByAnotherLaw)
{
  pressOnce(60);
  act("By the exact law");
  waitForRows(2);
  EXPECT_TRUE(cell(1, "Law").startsWith("exact")) << cell(1, "Law").toStdString();
  EXPECT_NEAR(cell(0, "δ max [mm]").toDouble(), cell(1, "δ max [mm]").toDouble(), 0.02);
  const QStringList place = cell(0, "Place [mm]").split(", ");
  const QStringList again = cell(1, "Place [mm]").split(", ");
  for (int i = 0; i < 3; ++i)
  {
    EXPECT_NEAR(place[i].toDouble(), again[i].toDouble(), 0.15);
  }
  type("young", "20"); // which is not that of the press
  act("With cone:45deg:10mm");
  waitForRows(3);
  EXPECT_EQ(cell(2, "E [kPa]"), "50.0");
  EXPECT_EQ(cell(2, "Tool"), "cone:45deg:10mm");
  EXPECT_NEAR(cell(0, "δ max [mm]").toDouble(), cell(2, "δ max [mm]").toDouble(), 0.02);
}

TEST_F(PressListTest, DeletesAndBringsBack)
{
  pressOnce(50);
  pressOnce(70);
  rows().topLevelItem(0)->setSelected(true);
  act("Delete");
  waitForRows(1);
  EXPECT_EQ(cell(0, "Press"), "press 2");
  act("Undo delete");
  waitForRows(2);
  EXPECT_EQ(cell(0, "Press"), "press 1");
  rows().topLevelItem(0)->setText(0, "left lobe");
  const auto name = [this] { return cell(0, "Press"); };
  EXPECT_EQ(session_->presses().presses().front().summary.name, "left lobe");
  act("Undo rename");
  EXPECT_TRUE(QTest::qWaitFor([&] { return name() == "press 1"; }, kPatience));
}

TEST_F(PressListTest, UndoesAChangeOfTissueAndTool)
{
  const auto law = [this] { return session_->recording().scene.law; };
  type("young", "20");
  type("poisson", "0.45");
  window_->findChild<QComboBox*>("kind")->setCurrentIndex(1);
  EXPECT_EQ(law().material().youngModulus, 20e3);
  EXPECT_FALSE(std::holds_alternative<SphereTip>(law().tip()));
  act("Undo");
  EXPECT_TRUE(std::holds_alternative<SphereTip>(law().tip()));
  act("Undo");
  EXPECT_EQ(law().material().poissonRatio, 0.33);
  EXPECT_EQ(law().material().youngModulus, 20e3);
  act("Undo");
  EXPECT_EQ(law().material().youngModulus, 50e3);
  act("Redo");
  act("Redo");
  EXPECT_EQ(law().material().poissonRatio, 0.45);
  type("young", "30 apples");
  EXPECT_EQ(law().material().youngModulus, 20e3) << "refused";
  act("Undo");
  EXPECT_EQ(law().material().poissonRatio, 0.33) << "what was refused is no change";
}

// as another program would after a kill
TEST_F(PressListTest, RestoresWhatWasNotExported)
{
  std::optional<Autosave> before(folder_.path());
  window_->saveTo(*before);
  pressOnce(60);
  type("young", "25");
  pressOnce(40);
  pressOnce(50);
  const QString first = cell(0, "F max [N]");
  const QString second = cell(1, "F max [N]");
  rows().topLevelItem(0)->setText(0, "left lobe");
  rows().topLevelItem(2)->setSelected(true);
  act("Delete");
  waitForRows(2);
  type("young", "50");
  before.reset();
  Autosave after(folder_.path());
  window_->saveTo(after);
  EXPECT_TRUE(said().startsWith("Not exported yet: 2 presses of before")) << said().toStdString();
  answer("Restore");
  waitForRows(4);
  EXPECT_EQ(cell(2, "Press"), "left lobe (2)") << "as it was called, and told from the other";
  EXPECT_EQ(cell(2, "F max [N]"), first);
  EXPECT_EQ(cell(3, "F max [N]"), second);
  EXPECT_EQ(cell(3, "E [kPa]"), "25.0");
  EXPECT_TRUE(window_->exportData(QString::fromStdString((folder_.path() / "out").string())));
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "out" / "earlier-1" / "samples.csv"));
  after.clear();
  session_->saveTo(nullptr);
}

// restored, loaded and made now: of one body, tool and tissue they are one recording
TEST_F(PressListTest, ExportsThePressesOfOneToolIntoOneFolder)
{
  const auto out = folder_.path() / "out";
  const auto exportedNames = [&]
  {
    EXPECT_TRUE(window_->exportData(QString::fromStdString(out.string())));
    EXPECT_FALSE(std::filesystem::exists(out / "earlier-1"));
    std::ifstream table(out / "presses.csv");
    std::vector<std::string> names;
    for (std::string line; std::getline(table, line);)
    {
      line.starts_with('"') ? names.push_back(line.substr(1, line.find('"', 1) - 1)) : void();
    }
    return names;
  };
  std::optional<Autosave> before(folder_.path() / "state");
  window_->saveTo(*before);
  pressOnce(60);
  pressOnce(40);
  rows().topLevelItem(0)->setText(0, "left lobe");
  before.reset();
  Autosave after(folder_.path() / "state");
  window_->saveTo(after);
  answer("Restore");
  waitForRows(4);
  pressOnce(50);
  const std::vector<std::string> first{ "left lobe", "press 2", "left lobe", "press 2", "press 5" };
  EXPECT_EQ(exportedNames(), first);
  const test::Finished again = test::runCommand(
    PALP_PROGRAM " run " + out.string() + " --out " + (folder_.path() / "again").string());
  ASSERT_EQ(again.code, 0) << again.err;
  const auto samples = folder_.path() / "again" / "samples.csv";
  EXPECT_EQ(test::readAll(samples), test::readAll(out / "samples.csv"));
  EXPECT_TRUE(window_->loadPresses(QString::fromStdString(out.string())));
  waitForRows(10);
  std::filesystem::remove_all(out);
  EXPECT_EQ(exportedNames().size(), 10U);
  after.clear();
  session_->saveTo(nullptr);
}

TEST_F(PressListTest, ExportsTheNamesThatWereGiven)
{
  pressOnce(50);
  type("young", "25");
  pressOnce(70);
  rows().topLevelItem(0)->setText(0, "left lobe");
  rows().topLevelItem(1)->setText(0, "tumor, \"A\"");
  const auto out = folder_.path() / "out";
  ASSERT_TRUE(window_->exportData(QString::fromStdString(out.string())));
  EXPECT_NE(test::readAll(out / "presses.csv").find("\"tumor, \"\"A\"\"\","), std::string::npos);
  EXPECT_NE(
    test::readAll(out / "earlier-1" / "presses.csv").find("\"left lobe\","), std::string::npos);
}

// on the surface that was pressed, whatever is open now
TEST_F(PressListTest, LoadsWhatWasExported)
{
  const QString out = QString::fromStdString((folder_.path() / "out").string());
  ASSERT_TRUE(window_->openFile(PALP_SHARE "/meshes/sphere_50.vtp"));
  pressOnce(60);
  type("young", "25");
  pressOnce(40);
  std::vector<QStringList> exported;
  for (int row = 0; row < 2; ++row)
  {
    exported.push_back({ cell(row, "F max [N]"), cell(row, "δ max [mm]"), cell(row, "E [kPa]"),
      cell(row, "Place [mm]") });
  }
  ASSERT_TRUE(window_->exportData(out));
  ASSERT_TRUE(window_->openFile(PALP_SHARE "/meshes/block_50.vtp"));
  EXPECT_TRUE(window_->loadPresses(out));
  EXPECT_TRUE(said().startsWith("2 presses loaded from")) << said().toStdString();
  waitForRows(4);
  for (int row = 2; row < 4; ++row)
  {
    const QStringList loaded{ cell(row, "F max [N]"), cell(row, "δ max [mm]"), cell(row, "E [kPa]"),
      cell(row, "Place [mm]") };
    EXPECT_EQ(loaded, exported[static_cast<std::size_t>(row - 2)]);
  }
  EXPECT_EQ(session_->body().name, "block_50.vtp");
  EXPECT_EQ(session_->earlier().back().body.name, "sphere_50.vtp");
}

TEST_F(PressListTest, TicksThePressesThatHaveCurvesAndRefusesThemElsewhere)
{
  const QString out = QString::fromStdString((folder_.path() / "out").string());
  for (int i = 0; i < 4; ++i)
  {
    pressOnce(30 + 10 * i);
  }
  ASSERT_TRUE(window_->exportData(out));
  EXPECT_TRUE(window_->loadPresses(out));
  waitForRows(8);
  int ticked = 0;
  for (int row = 0; row < 8; ++row)
  {
    ticked += rows().topLevelItem(row)->checkState(0) == Qt::Checked ? 1 : 0;
  }
  EXPECT_EQ(ticked, 6);
  EXPECT_EQ(window_->findChild<PressList*>()->ticked().size(), 6U);
  EXPECT_EQ(cell(4, "Press"), "press 1 (2)");
  ASSERT_TRUE(window_->openFile(PALP_SHARE "/meshes/block_50.vtp"));
  rows().topLevelItem(0)->setSelected(true);
  act("By its own tool and law");
  EXPECT_TRUE(said().startsWith("press 1: it was of liver.vtp")) << said().toStdString();
}

TEST_F(PressListTest, LoadsNoPressesOfAnotherSurfaceOrOfNoExport)
{
  const std::filesystem::path mesh = folder_.path() / "mine.vtp";
  const std::filesystem::path out = folder_.path() / "out";
  std::filesystem::copy_file(PALP_SHARE "/meshes/sphere_50.vtp", mesh);
  ASSERT_TRUE(window_->openFile(QString::fromStdString(mesh.string())));
  pressOnce(60);
  ASSERT_TRUE(window_->exportData(QString::fromStdString(out.string())));
  std::filesystem::copy_file(
    PALP_SHARE "/meshes/sphere_30.vtp", mesh, std::filesystem::copy_options::overwrite_existing);
  ASSERT_TRUE(window_->openFile(QString::fromStdString(mesh.string())));
  const std::size_t before = session_->earlier().size();
  for (const auto& [folder, why] :
    { std::pair(out, "mine.vtp is another file"), std::pair(folder_.path(), "scene.json") })
  {
    EXPECT_FALSE(window_->loadPresses(QString::fromStdString(folder.string())));
    EXPECT_TRUE(said().contains(why)) << said().toStdString();
  }
  EXPECT_EQ(session_->earlier().size(), before);
  EXPECT_EQ(rows().topLevelItemCount(), 1);
}

TEST_F(PressListTest, ComparesAndFits)
{
  pressOnce(60);
  type("young", "25");
  pressOnce(60);
  act("Compare");
  auto* tabs = window_->findChild<QTabBar*>("plotTabs");
  ASSERT_NE(tabs, nullptr);
  EXPECT_EQ(tabs->tabText(tabs->currentIndex()), "Presses");
  rows().clearSelection();
  rows().topLevelItem(1)->setSelected(true);
  act("Fit E");
  EXPECT_TRUE(said().startsWith("press 2: E = 25 kPa")) << said().toStdString();
}

} // namespace
} // namespace palp
