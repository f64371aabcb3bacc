#include "app/graphs/chart_panel.h"
#include "app/graphs/figure_dialog.h"
#include "tests/app/window/window_rig.h"

#include <QComboBox>
#include <QImage>
#include <QLabel>
#include <QTabBar>
#include <QToolButton>
#include <QTreeWidget>
#include <QWheelEvent>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vtkAxis.h>
#include <vtkDataArray.h>
#include <vtkPen.h>
#include <vtkPlot.h>
#include <vtkTable.h>

namespace palp
{
namespace
{

class WindowCharts : public test::WindowTest
{
protected:
  [[nodiscard]] QVTKOpenGLNativeWidget* canvas(const char* name) const
  {
    return window_->findChild<QVTKOpenGLNativeWidget*>(name);
  }

  [[nodiscard]] ChartPanel* panel(const char* name) const
  {
    return qobject_cast<ChartPanel*>(canvas(name)->parentWidget());
  }

  [[nodiscard]] vtkPalpChart& chart(const char* name) const
  {
    return *panel(name)->charts().at(0);
  }

  void click(const char* chart, const char* button) const
  {
    panel(chart)->findChild<QToolButton*>(button)->click();
  }

  [[nodiscard]] static double width(vtkPalpChart& chart, int side)
  {
    return chart.GetAxis(side)->GetMaximum() - chart.GetAxis(side)->GetMinimum();
  }
};

// the toolkit's own keys: 3 draws for two eyes, e and q end, w draws wires
TEST_F(WindowCharts, StayAsTheyAreWhateverIsTypedIntoThem)
{
  auto* time = canvas("timeChart");
  QTest::mouseClick(time, Qt::LeftButton);
  QTest::keyClicks(time, "3eqwsfrpjtu");
  EXPECT_EQ(time->renderWindow()->GetStereoRender(), 0);
  EXPECT_TRUE(window_->isVisible());
}

TEST_F(WindowCharts, AreZoomedByTheWheelAndFitAgain)
{
  press(100);
  release();
  EXPECT_TRUE(waitForLift());
  waitForRest();
  vtkPalpChart& depth = chart("depthChart");
  click("depthChart", "fit"); // on a slow machine the last of the press is not yet in the chart
  const double before = width(depth, vtkAxis::BOTTOM);
  const QPoint middle = canvas("depthChart")->rect().center();
  QTest::mouseMove(canvas("depthChart"), middle);
  QWheelEvent wheel(middle, canvas("depthChart")->mapToGlobal(middle), {}, QPoint(0, 120),
    Qt::NoButton, Qt::NoModifier, Qt::NoScrollPhase, false);
  QApplication::sendEvent(canvas("depthChart"), &wheel);
  EXPECT_LT(width(depth, vtkAxis::BOTTOM), 0.9 * before);
  EXPECT_TRUE(QTest::qWaitFor([&] { return picturesIn(200) == 0; }, kPatience)) << "drawn for ever";
  click("depthChart", "fit");
  EXPECT_NEAR(width(depth, vtkAxis::BOTTOM), before, 1e-9);
}

TEST_F(WindowCharts, ForgetThePointerThatHasLeft)
{
  press(100);
  release();
  EXPECT_TRUE(waitForLift());
  waitForRest();
  EXPECT_TRUE(QTest::qWaitFor([&] { return picturesIn(200) == 0; }, kPatience));
  auto* depth = canvas("depthChart");
  const QImage before = depth->grabFramebuffer();
  QTest::mouseMove(depth, depth->rect().center());
  EXPECT_TRUE(QTest::qWaitFor([&] { return depth->grabFramebuffer() != before; }, kPatience));
  QTest::mouseMove(canvas_, QPoint(5, 5));
  QEvent leave(QEvent::Leave); // which the pointer of a test does not cause
  QApplication::sendEvent(depth, &leave);
  EXPECT_TRUE(QTest::qWaitFor([&] { return depth->grabFramebuffer() == before; }, kPatience));
}

TEST_F(WindowCharts, ArePausedAndClearedTogether)
{
  click("timeChart", "pause");
  EXPECT_TRUE(panel("depthChart")->findChild<QToolButton*>("pause")->isChecked());
  const auto points = [this](const char* name)
  { return chart(name).GetPlot(1)->GetInput()->GetNumberOfRows(); };
  const auto pictures = [this]
  {
    return std::pair(
      canvas("timeChart")->grabFramebuffer(), canvas("depthChart")->grabFramebuffer());
  };
  const vtkIdType before = points("depthChart");
  const auto seen = pictures();
  press(100);
  release();
  waitForPresses(1);
  auto* rows = window_->findChild<QTreeWidget*>("pressRows");
  EXPECT_TRUE(QTest::qWaitFor([rows] { return rows->topLevelItemCount() == 1; }, kPatience));
  waitForFrames();
  EXPECT_EQ(points("depthChart"), before);
  EXPECT_EQ(pictures(), seen) << "nor has the press a curve";
  click("depthChart", "pause");
  EXPECT_TRUE(QTest::qWaitFor([&] { return points("depthChart") > before + 10; }, kPatience));
  waitForRest();
  click("timeChart", "clear");
  EXPECT_EQ(points("depthChart"), 0);
  EXPECT_GT(session_->recording().samples.size(), 10U) << "the recording keeps them";
}

// nor with the panels beside them: all together may take longer than a picture
TEST_F(WindowCharts, AreDrawnOneInATurn)
{
  press(100);
  int drawn = 0;
  vtkNew<vtkCallbackCommand> count;
  count->SetClientData(&drawn);
  count->SetCallback(
    [](vtkObject*, unsigned long, void* data, void*) { ++*static_cast<int*>(data); });
  std::map<vtkRenderWindow*, unsigned long> watched;
  for (const char* name : { "timeChart", "depthChart" })
  {
    vtkRenderWindow* window = canvas(name)->renderWindow();
    watched[window] = window->AddObserver(vtkCommand::EndEvent, count);
  }
  const QDeadlineTimer patience(kPatience);
  for (int all = 0; all < 20 && !patience.hasExpired(); all += std::exchange(drawn, 0))
  {
    QApplication::processEvents(QEventLoop::WaitForMoreEvents);
    EXPECT_LE(drawn, 1);
  }
  EXPECT_FALSE(patience.hasExpired());
  for (const auto& [window, observer] : watched)
  {
    window->RemoveObserver(observer);
  }
  release();
}

TEST_F(WindowCharts, AreSavedAtTheSizeThatIsAskedFor)
{
  press(100);
  release();
  for (const std::size_t which : { 0U, 1U })
  {
    for (const char* name : { "chart.png", "chart.svg", "chart.pdf", "chart.csv" })
    {
      const std::filesystem::path file = folder_.path() / name;
      ASSERT_TRUE(window_->saveChart(
        which, QString::fromStdString(file.string()), { .width = 2400, .height = 1200 }));
      EXPECT_GT(std::filesystem::file_size(file), 2000U) << name;
    }
    EXPECT_LT(std::filesystem::file_size(folder_.path() / "chart.pdf"), 200'000U);
    const QImage picture(QString::fromStdString((folder_.path() / "chart.png").string()));
    EXPECT_EQ(picture.size(), QSize(2400, 1200));
    std::ifstream svg(folder_.path() / "chart.svg");
    const std::string text{ std::istreambuf_iterator<char>(svg), {} };
    EXPECT_NE(text.find(which == 0 ? "time [s]" : "depth"), std::string::npos);
  }
}

TEST_F(WindowCharts, TellWhatToDoWhereThereIsNothingToShow)
{
  PlotPanel* plots = showPlots();
  auto* hint = plots->findChild<QLabel*>("hint");
  ASSERT_NE(hint, nullptr);
  EXPECT_TRUE(hint->isVisible());
  EXPECT_TRUE(hint->text().contains("press the surface")) << hint->text().toStdString();
  press(60);
  EXPECT_TRUE(QTest::qWaitFor([&] { return !hint->isVisible(); }, kPatience));
  EXPECT_FALSE(plots->plots().empty());
  release();
  waitForPresses(1);
  auto* tabs = plots->findChild<QTabBar*>("plotTabs");
  tabs->setCurrentIndex(4);
  EXPECT_TRUE(QTest::qWaitFor([&] { return hint->isVisible(); }, kPatience));
  EXPECT_TRUE(hint->text().contains("tick two presses")) << hint->text().toStdString();
  tabs->setCurrentIndex(3);
  EXPECT_TRUE(QTest::qWaitFor([&] { return !hint->isVisible(); }, kPatience)) << "a press is shown";
  window_->findChild<QTreeWidget*>("pressRows")->topLevelItem(0)->setCheckState(0, Qt::Unchecked);
  EXPECT_TRUE(QTest::qWaitFor([&] { return hint->isVisible(); }, kPatience));
  EXPECT_TRUE(hint->text().contains("tick the press")) << hint->text().toStdString();
  EXPECT_TRUE(plots->plots().empty());
  tabs->setCurrentIndex(0);
  EXPECT_TRUE(QTest::qWaitFor([&] { return !hint->text().contains("tick"); }, kPatience));
}

// of those that are ticked, the first or the one that is selected
TEST_F(WindowCharts, TellHowFarPressesAreFromTheOneThatIsChosen)
{
  PlotPanel* plots = showPlots();
  plots->turnTo("Differences");
  auto* rows = window_->findChild<QTreeWidget*>("pressRows");
  for (const int presses : { 1, 2 })
  {
    press(80);
    release();
    EXPECT_TRUE(QTest::qWaitFor([&] { return rows->topLevelItemCount() == presses; }, kPatience));
    type("young", "100");
  }
  const auto waitFor = [plots](const char* name)
  {
    const auto isShown = [plots, name]
    { return !plots->plots().empty() && plots->plots()[0]->curves()[0].name == name; };
    return QTest::qWaitFor(isShown, kPatience);
  };
  const auto largest = [plots]
  {
    double range[2];
    vtkDataArray::SafeDownCast(plots->plots()[0]->tables()[0]->GetColumn(1))->GetRange(range);
    return std::abs(range[0]) > range[1] ? range[0] : range[1];
  };
  ASSERT_TRUE(waitFor("press 2")) << "the first is what the others differ from";
  const double stiffer = largest();
  EXPECT_GT(stiffer, 0.1);
  rows->topLevelItem(1)->setSelected(true);
  ASSERT_TRUE(waitFor("press 1"));
  EXPECT_NEAR(largest(), -stiffer, 0.1 * stiffer);
  EXPECT_TRUE(rows->headerItem()->toolTip(0).contains("Selected"));
}

// a curve of its own for each press, which outlives a change of the tool and is hidden by its name
TEST_F(WindowCharts, ShowEachTickedPressInAColorOfItsOwn)
{
  auto* rows = window_->findChild<QTreeWidget*>("pressRows");
  for (const int presses : { 1, 2 })
  {
    press(60 * presses);
    release();
    EXPECT_TRUE(QTest::qWaitFor([&] { return rows->topLevelItemCount() == presses; }, kPatience));
    window_->findChild<QComboBox*>("kind")->setCurrentIndex(2); // a punch, for the second
  }
  vtkPalpChart& depth = chart("depthChart");
  const auto shown = [&depth]
  {
    std::map<std::string, vtkPlot*> byName;
    for (vtkIdType i = 0; i < depth.GetNumberOfPlots(); ++i)
    {
      byName[depth.GetPlot(i)->GetLabel()] = depth.GetPlot(i);
    }
    return byName;
  };
  std::map<std::string, vtkPlot*> curves = shown();
  ASSERT_TRUE(curves.contains("press 1") && curves.contains("press 2"));
  const auto largest = [](vtkPlot* plot, vtkIdType column)
  { return vtkDataArray::SafeDownCast(plot->GetInput()->GetColumn(column))->GetRange()[1]; };
  for (const auto& press : session_->presses().presses())
  {
    vtkPlot* curve = curves[press.summary.name];
    EXPECT_NEAR(largest(curve, 0), 1e3 * press.summary.deepest.depth, 1e-4);
    EXPECT_NEAR(largest(curve, 1), press.summary.force, 1e-5);
  }
  std::set<std::array<unsigned char, 3>> colors;
  for (const auto& [name, plot] : curves)
  {
    const vtkColor4ub color = plot->GetPen()->GetColorObject();
    name.empty() ? void() : void(colors.insert({ color[0], color[1], color[2] }));
  }
  EXPECT_EQ(colors.size(), 4U) << "model, recorded and two presses";

  rows->topLevelItem(0)->setCheckState(0, Qt::Unchecked);
  EXPECT_TRUE(QTest::qWaitFor([&] { return !shown().contains("press 1"); }, kPatience));
  depth.SetCurveShown("press 2", false);
  EXPECT_FALSE(shown().at("press 2")->GetVisible());
  const std::filesystem::path file = folder_.path() / "depth.csv";
  ASSERT_TRUE(window_->saveChart(1, QString::fromStdString(file.string()), {}));
  EXPECT_NE(test::readAll(file).find("press 2"), std::string::npos);
}

TEST(FigureDialog, TakesAnySizeUpToItsLimit)
{
  test::application();
  const test::TemporaryFolder folder;
  FigureDialog dialog("Save", "figure.png", "Figures (*.png)", { .width = 1600, .height = 1000 });
  dialog.setDirectory(QString::fromStdString(folder.path().string()));
  dialog.findChild<QComboBox*>("size")->setEditText("7680x4320");
  dialog.accept();
  EXPECT_EQ(dialog.size().width, 7680);
  EXPECT_EQ(dialog.size().height, 4320);
  EXPECT_TRUE(dialog.file().endsWith("figure.png")) << dialog.file().toStdString();
}

} // namespace
} // namespace palp
