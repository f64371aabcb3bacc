// What a user wants of a session, each action counted: the start, a click, a key, or a line that is
// typed where the keyboard is. Nothing is used that cannot be seen. When strangers first tried the
// program, these took 15, 21, and, for the last in the window, 12; the others were impossible.
#include "pipeline/model/poly_data.h"
#include "pipeline/surface_io/surface_io.h"
#include "tests/app/window/window_rig.h"
#include "tests/support/csv_table.h"

#include <QFileDialog>
#include <QImage>
#include <QLineEdit>
#include <QMenu>
#include <QTabBar>
#include <QToolButton>
#include <QTreeWidget>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <gtest/gtest.h>

namespace palp
{
namespace
{

using test::WindowTest;

class Tasks : public WindowTest
{
protected:
  // the program is started with a file
  void launch(const std::string& file)
  {
    ++actions_;
    ASSERT_TRUE(window_->openFile(QString::fromStdString(file)));
  }

  void key(Qt::Key code, Qt::KeyboardModifiers modifiers = Qt::NoModifier)
  {
    ++actions_;
    QTest::keyClick(window_.get(), code, modifiers);
  }

  void click(QWidget* widget, QPoint at = {})
  {
    EXPECT_FALSE(widget->visibleRegion().isEmpty()) << widget->objectName().toStdString();
    ++actions_;
    QTest::mouseClick(widget, Qt::LeftButton, {}, at);
  }

  // a line that ends with Return
  void line(QLineEdit* field, const QString& text)
  {
    field->window()->focusWidget() == field ? void() : click(field);
    if (field->selectedText() != field->text()) // which the line replaces
    {
      ++actions_;
      QTest::keyClick(field, Qt::Key_A, Qt::ControlModifier);
    }
    ++actions_;
    text.isEmpty() ? QTest::keyClick(field, Qt::Key_Delete) : QTest::keyClicks(field, text);
    QTest::keyClick(field, Qt::Key_Return);
  }

  // lines for the fields of a dialog, from the last to be answered on
  void answer(
    const std::function<void()>& open, const std::vector<std::pair<QString, QString>>& lines)
  {
    std::size_t next = 0;
    QTimer typist;
    QObject::connect(&typist, &QTimer::timeout,
      [&]
      {
        auto* dialog = qobject_cast<QDialog*>(QApplication::activeModalWidget());
        if (dialog == nullptr || !dialog->isVisible() || next == lines.size())
        {
          return;
        }
        if (!dialog->isActiveWindow()) // a file dialog changes a name that is typed before that
        {
          return QApplication::setActiveWindow(dialog);
        }
        const auto& [name, text] = lines[next];
        if (auto* field = name.isEmpty() ? dialog->findChild<QLineEdit*>()
                                         : dialog->findChild<QLineEdit*>(name))
        {
          ++next;
          field->setCompleter(nullptr); // its list would take the Return, or go to another folder
          line(field, text);
        }
      });
    typist.start(200);
    open();
    EXPECT_TRUE(QTest::qWaitFor([&] { return next == lines.size(); }, kPatience));
  }

  void keyAndLines(Qt::Key code, Qt::KeyboardModifiers modifiers,
    const std::vector<std::pair<QString, QString>>& lines)
  {
    answer([&] { key(code, modifiers); }, lines);
  }

  // at a place, as deep as the line says
  void pressThere(const char* place)
  {
    line(window_->findChild<QLineEdit*>("pressPlace"), place);
    waitForPresses(1);
  }

  // of the menu beside the button
  void again(const QString& how, int presses)
  {
    auto* button = window_->findChild<QToolButton*>("pressAgain");
    QTimer::singleShot(300, button,
      [&]
      {
        QMenu* menu = button->menu();
        for (QAction* action : menu->actions())
        {
          if (action->text() == how)
          {
            click(menu, menu->actionGeometry(action).center());
          }
        }
      });
    click(button, { button->width() - 4, button->height() / 2 });
    waitForPresses(presses);
  }

  void compare()
  {
    for (auto* button : window_->findChildren<QToolButton*>())
    {
      if (button->text() == "Compare" && button->isVisible())
      {
        return click(button);
      }
    }
    ADD_FAILURE() << "no button";
  }

  void waitForPresses(int count) const
  {
    auto* rows = window_->findChild<QTreeWidget*>("pressRows");
    EXPECT_TRUE(QTest::qWaitFor([&] { return rows->topLevelItemCount() == count; }, 2 * kPatience))
      << rows->topLevelItemCount();
  }

  [[nodiscard]] double force(std::size_t press) const
  {
    return session_->presses().presses().at(press).summary.force;
  }

  // a ball of 50 mm, as another program writes it
  [[nodiscard]] std::string ownSurface() const
  {
    const auto file = folder_.path() / "own.stl";
    writeSurface(file, *readSurface(PALP_SHARE "/meshes/sphere_50.vtp").mesh);
    return file.string();
  }

  int actions_ = 0;
};

// F = E/(1 - nu^2) 4/3 sqrt(R) d^1.5, by hand
constexpr double kSphereForce = 2.6448; // [N], 10 mm of radius, 5 mm deep, 50 kPa, 0.33

TEST_F(Tasks, AnOwnSurfaceIsPressedAtAPlaceAndSavedAsAPicture)
{
  const auto picture = folder_.path() / "press.png";
  launch(ownSurface());
  pressThere("0, 0, 50, 5 mm");
  keyAndLines(Qt::Key_S, Qt::ControlModifier, { { "", QString::fromStdString(picture.string()) } });
  EXPECT_TRUE(QTest::qWaitFor([&] { return std::filesystem::exists(picture); }, kPatience));
  EXPECT_NEAR(force(0), kSphereForce, 0.02);
  auto* rows = window_->findChild<QTreeWidget*>("pressRows");
  bool isTold = false;
  for (int column = 0; column < rows->columnCount(); ++column)
  {
    isTold = isTold || rows->topLevelItem(0)->text(column).startsWith("2.6");
  }
  EXPECT_TRUE(isTold) << "in the list of presses";
  EXPECT_FALSE(QImage(QString::fromStdString(picture.string())).isNull());
  EXPECT_LE(actions_, 15 / 3);
}

TEST_F(Tasks, TwoLawsAreComparedAtOnePlace)
{
  launch(ownSurface());
  pressThere("0, 0, 50, 5 mm");
  again("By the corrected law", 2);
  compare();
  auto* tabs = window_->findChild<QTabBar*>("plotTabs");
  ASSERT_NE(tabs, nullptr);
  EXPECT_EQ(tabs->tabText(tabs->currentIndex()), "Presses");
  EXPECT_NEAR(force(0), kSphereForce, 0.02);
  EXPECT_LT(force(1), 0.97 * force(0)) << "a ball gives way more than a plane";
  EXPECT_GT(force(1), 0.85 * force(0));
  EXPECT_LE(actions_, 21 / 3);
}

TEST_F(Tasks, ThreeToolsAreComparedInOnePlot)
{
  launch(ownSurface());
  pressThere("0, 0, 50, 5 mm");
  again("With cone:45deg:10mm", 2);
  again("With punch:5mm", 3);
  compare();
  EXPECT_LE(actions_, 8);
  const auto file = folder_.path() / "tools.csv";
  EXPECT_TRUE(QTest::qWaitFor(
    [&] { return window_->savePlots(QString::fromStdString(file.string())); }, kPatience));
  const std::string curves = test::readAll(file);
  for (const char* press : { "press 1", "press 2", "press 3" })
  {
    EXPECT_NE(curves.find(press), std::string::npos) << press;
  }
  // 2/pi E/(1 - nu^2) d^2 tan(45 degrees), and 2 E/(1 - nu^2) a d
  const double modulus = 50e3 / (1.0 - 0.33 * 0.33);
  EXPECT_NEAR(force(1), 2.0 / M_PI * modulus * 25e-6, 0.02);
  EXPECT_NEAR(force(2), 2.0 * modulus * 25e-6, 0.05);
}

// of the same everywhere, a fifth of what the panel says
TEST_F(Tasks, AMapOfTheModulusIsTyped)
{
  launch(ownSurface());
  pressThere("0, 0, 50, 5 mm");
  again("By the corrected law", 2);
  auto* action = window_->findChild<QAction*>("tissueMapAction");
  answer([action] { action->trigger(); }, { { "", "formula:10+yes" }, { "", "formula:10" } });
  EXPECT_TRUE(QTest::qWaitFor([&] { return bool(session_->body().stiffness); }, kPatience));
  line(window_->findChild<QLineEdit*>("pressPlace"), "0, 0, 50, 5 mm");
  waitForPresses(3);
  EXPECT_NEAR(force(2), 0.2 * force(1), 0.002 * force(1));
  answer([action] { action->trigger(); }, { { "", "" } });
  EXPECT_TRUE(QTest::qWaitFor([&] { return !session_->body().stiffness; }, kPatience));
}

// a law that knows no map would press another body than is told, and export nothing
TEST_F(Tasks, AMapTakesTheCorrectedLawAndIsExportedWithIt)
{
  launch(ownSurface());
  ASSERT_EQ(session_->scene().law.settings().mode, LawMode::Paper);
  auto* action = window_->findChild<QAction*>("tissueMapAction");
  answer([action] { action->trigger(); }, { { "", "formula:10" } });
  EXPECT_TRUE(QTest::qWaitFor([&] { return bool(session_->body().stiffness); }, kPatience));
  EXPECT_EQ(session_->scene().law.settings().mode, LawMode::Corrected);
  EXPECT_TRUE(said().contains("Corrected")) << said().toStdString();
  pressThere("0, 0, 50, 5 mm");
  const auto out = folder_.path() / "mapped";
  EXPECT_TRUE(window_->exportData(QString::fromStdString(out.string()))) << said().toStdString();
  EXPECT_TRUE(std::filesystem::exists(out / "presses.csv"));
}

// two balls with labels of their own, the second off the middle
TEST_F(Tasks, AnOrganIsTakenOutOfAnImageOfLabels)
{
  const auto image = folder_.path() / "abdomen.mha";
  std::ofstream out(image, std::ios::binary);
  out << "ObjectType = Image\nNDims = 3\nDimSize = 60 40 40\nElementSpacing = 2 2 2\n"
         "Offset = -40 -40 100\nTransformMatrix = 1 0 0 0 1 0 0 0 1\nDistanceUnits = mm\n"
         "ElementType = MET_UCHAR\nElementDataFile = LOCAL\n";
  const Eigen::Vector3d small(10.0, 20.0, 20.0);
  const Eigen::Vector3d large(38.0, 20.0, 20.0);
  for (int i = 0; i < 60 * 40 * 40; ++i)
  {
    const Eigen::Vector3d at(i % 60, i / 60 % 40, i / 60 / 40);
    out.put((at - small).norm() < 7.0 ? 2 : (at - large).norm() < 15.0 ? 5 : 0);
  }
  out.close();
  keyAndLines(Qt::Key_O, Qt::ControlModifier,
    { { "", QString::fromStdString(image.string()) }, { "label", "5" } });
  EXPECT_TRUE(QTest::qWaitFor([&] { return session_->body().name == "abdomen.mha"; }, kPatience));
  EXPECT_LE(actions_, 3);
  const double* box = session_->body().display->GetBounds(); // [m]
  EXPECT_NEAR(0.5 * (box[0] + box[1]), 36e-3, 0.5e-3);
  EXPECT_NEAR(0.5 * (box[4] + box[5]), 140e-3, 0.5e-3);
  EXPECT_NEAR(box[1] - box[0], 60e-3, 2e-3);
}

TEST_F(Tasks, ASessionIsExportedAndRepeatedWithoutAWindow)
{
  launch(ownSurface());
  pressThere("0, 0, 50, 5 mm");
  const int before = actions_;
  const auto folder = folder_.path() / "session";
  keyAndLines(Qt::Key_E, Qt::ControlModifier, { { "", QString::fromStdString(folder.string()) } });
  EXPECT_TRUE(
    QTest::qWaitFor([&] { return std::filesystem::exists(folder / "scene.json"); }, kPatience));
  const auto again = folder_.path() / "again";
  ++actions_;
  const test::Finished run =
    test::runCommand(PALP_PROGRAM " run " + folder.string() + " --out " + again.string());
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_LE(actions_ - before, 12 / 3);
  const auto largest = [](const std::filesystem::path& file)
  { return std::ranges::max(test::readCsv(file)["force_N"]); };
  EXPECT_NEAR(largest(again / "samples.csv"), largest(folder / "samples.csv"), 1e-6);
}

// nothing but a line of the shell
TEST_F(Tasks, TheCommandLinePressesByOneLine)
{
  const auto folder = folder_.path() / "run";
  ++actions_;
  const test::Finished run = test::runCommand(
    PALP_PROGRAM " run " + ownSurface() + " --at 0,0,50 --depth 5mm --out " + folder.string());
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(actions_, 1);
  EXPECT_NEAR(
    std::ranges::max(test::readCsv(folder / "samples.csv")["force_N"]), kSphereForce, 0.02);
}

} // namespace
} // namespace palp
