#include "app/folder/export_folder.h"
#include "app/graphs/plot_panel.h"
#include "haptics/files/csv_text.h"
#include "pipeline/surface_io/surface_io.h"
#include "tests/app/window/window_rig.h"
#include "tests/support/csv_table.h"

#include <QAction>
#include <QCheckBox>
#include <QComboBox>
#include <QFileDialog>
#include <QImage>
#include <QLineEdit>
#include <QStatusBar>
#include <QTabBar>
#include <QTimer>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <set>

namespace palp
{
namespace
{

using test::WindowTest;

TEST_F(WindowTest, SavesAScreenshotOfTheDent)
{
  const QString file = QString::fromStdString((folder_.path() / "shot.png").string());
  press(160);
  ASSERT_TRUE(window_->saveScreenshot(file));
  release();
  const QImage image(file);
  ASSERT_FALSE(image.isNull());
  std::set<QRgb> colors;
  for (int y = 0; y < image.height(); y += 2)
  {
    for (int x = 0; x < image.width(); x += 2)
    {
      colors.insert(image.pixel(x, y));
    }
  }
  EXPECT_GT(colors.size(), 500u);
}

// share of its pixels as blue as the force's arrow
double arrowOf(const QImage& image)
{
  int blue = 0;
  for (int y = 0; y < image.height(); ++y)
  {
    for (int x = 0; x < image.width(); ++x)
    {
      const QColor color = image.pixelColor(x, y);
      blue += color.blue() > color.red() + 100 && color.blue() > color.green() + 50 ? 1 : 0;
    }
  }
  return 1.0 * blue / (image.width() * image.height());
}

// by its menu and its dialog
TEST_F(WindowTest, SavesAFigureAsItsDialogIsFilledIn)
{
  press(80);
  const auto saved = [&](const char* name, const char* size, const std::set<QString>& parts)
  {
    const QString file = QString::fromStdString((folder_.path() / name).string());
    QTimer hand;
    QObject::connect(&hand, &QTimer::timeout,
      [&]
      {
        auto* dialog = qobject_cast<QFileDialog*>(QApplication::activeModalWidget());
        if (dialog == nullptr)
        {
          return;
        }
        hand.stop();
        dialog->findChild<QComboBox*>("size")->setEditText(size);
        for (auto* box : dialog->findChildren<QCheckBox*>())
        {
          box->setChecked(parts.contains(box->objectName()));
        }
        dialog->findChild<QLineEdit*>("fileNameEdit")->setText(file);
        QMetaObject::invokeMethod(dialog, "accept");
      });
    hand.start(100);
    window_->findChild<QAction*>("figureAction")->trigger();
    EXPECT_TRUE(said().startsWith("Written to " + file)) << said().toStdString();
    return QImage(file);
  };
  const QImage whole = saved("whole.png", "3840x2160", { "overlays", "colorBar" });
  ASSERT_EQ(whole.size(), QSize(3840, 2160));
  EXPECT_FALSE(whole.hasAlphaChannel());
  EXPECT_GT(arrowOf(whole), 1e-4);
  const QImage clear = saved("clear.png", "640x480", { "transparent", "realistic" });
  ASSERT_EQ(clear.size(), QSize(640, 480));
  EXPECT_EQ(clear.pixelColor(2, 2).alpha(), 0);
  EXPECT_EQ(clear.pixelColor(320, 240).alpha(), 255) << "the liver";
  EXPECT_EQ(arrowOf(clear), 0.0);
  release();
}

TEST_F(WindowTest, SaysThatAnExportHasNoPress)
{
  ASSERT_TRUE(window_->exportData(QString::fromStdString((folder_.path() / "out").string())));
  EXPECT_TRUE(said().endsWith("no press is in it")) << said().toStdString();
}

TEST_F(WindowTest, ShowsTheSectionOfAPressOnRequest)
{
  EXPECT_EQ(window_->findChild<PlotPanel*>(), nullptr);
  PlotPanel* panel = showPlots();
  press(80); // 5 mm
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "section.csv";
  const auto lowest = [&] // [mm], of what is saved now
  {
    panel->refresh();
    double found = 0.0;
    EXPECT_TRUE(window_->savePlots(QString::fromStdString(file.string())));
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);)
    {
      if (line.starts_with("\"surface as drawn\""))
      {
        found = std::min(found, std::stod(line.substr(line.rfind(',') + 1)));
      }
    }
    return found;
  };
  EXPECT_TRUE(QTest::qWaitFor([&] { return std::abs(lowest() + 5.0) < 0.5; }, kPatience));
  window_->findChild<QAction*>("plotsAction")->setChecked(false);
  EXPECT_FALSE(panel->isVisible());
}

TEST_F(WindowTest, ThisPressIsNotTheDeepestOfTheRecording)
{
  PlotPanel* panel = showPlots();
  panel->findChild<QTabBar*>("plotTabs")->setCurrentIndex(1);
  for (const int pixels : { 160, 40 })
  {
    press(pixels);
    release();
    EXPECT_TRUE(waitForLift());
    waitForRest();
  }
  panel->refresh();
  const std::filesystem::path file = folder_.path() / "forces.csv";
  ASSERT_TRUE(window_->savePlots(QString::fromStdString(file.string())));
  double deepest = 0.0;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);)
  {
    if (line.starts_with("\"this press\""))
    {
      deepest = std::max(deepest, std::stod(line.substr(line.find(',') + 1)));
    }
  }
  EXPECT_GT(deepest, 2.0);
  EXPECT_LT(deepest, 4.0);
  RecordProperty("depth_mm", std::to_string(deepest));
}

TEST_F(WindowTest, SavesTheCurvesForPrintAndSaysSo)
{
  press(100);
  release();
  for (const char* name : { "curves.png", "curves.svg", "curves.pdf", "curves.csv" })
  {
    const std::filesystem::path file = folder_.path() / name;
    ASSERT_TRUE(window_->saveCurves(QString::fromStdString(file.string())));
    EXPECT_GT(std::filesystem::file_size(file), 4000U) << name;
    EXPECT_TRUE(said().contains(name));
  }
  EXPECT_TRUE(said().contains("samples.csv")) << "each millisecond is elsewhere";
  const QImage picture(QString::fromStdString((folder_.path() / "curves.png").string()));
  EXPECT_EQ(picture.size(), QSize(1600, 1500)); // two charts

  std::ifstream in(folder_.path() / "curves.csv");
  std::string line;
  std::getline(in, line);
  EXPECT_EQ(line.find("# as drawn"), 0U) << line;
}

TEST_F(WindowTest, ExportsWhatWasMeasured)
{
  press(100);
  ASSERT_TRUE(QTest::qWaitFor([&] { return peakForce() > 1.0; }, kPatience));
  release();
  EXPECT_TRUE(waitForLift());
  ASSERT_TRUE(window_->exportData(QString::fromStdString(folder_.path().string())));
  const test::CsvTable samples = test::readCsv(folder_.path() / "samples.csv");
  const auto& force = samples["force_N"];
  ASSERT_GT(force.size(), 100u); // rest is not recorded
  EXPECT_NEAR(*std::max_element(force.begin(), force.end()), peakForce(), 1e-12);
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "deformed.vtp"));
  for (const char* name : { "servo.csv", "scene.json", "presses.csv", "provenance.json",
         "press.png", "force_time.png", "force_depth.png" })
  {
    EXPECT_TRUE(std::filesystem::exists(folder_.path() / name)) << name;
  }
}

// by the command that anybody can give, in another process
TEST_F(WindowTest, WhatItExportsIsRepeatedToTheByte)
{
  type("young", "33.3");
  press(100);
  ASSERT_TRUE(QTest::qWaitFor([&] { return peakForce() > 0.5; }, kPatience));
  release();
  EXPECT_TRUE(waitForLift());
  const std::filesystem::path first = folder_.path() / "first";
  const std::filesystem::path again = folder_.path() / "again";
  ASSERT_TRUE(window_->exportData(QString::fromStdString(first.string())));
  const test::Finished run =
    test::runCommand(PALP_PROGRAM " run " + first.string() + " --out " + again.string());
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.err.find("repeated to the byte"), std::string::npos) << run.err;
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(first))
  {
    const auto other = again / entry.path().filename();
    EXPECT_TRUE(test::readAll(entry.path()) == test::readAll(other)) << other;
    ++count;
  }
  EXPECT_EQ(count, 9U);
  const test::CsvTable samples = test::readCsv(first / "samples.csv");
  EXPECT_LE(std::ranges::count(samples["depth_mm"], 0.0), 4); // contact only
}

ScenePlan relaxing()
{
  ScenePlan plan;
  plan.press.tissue.options.mode = LawMode::Corrected;
  plan.press.tissue.options.relaxation = parseRelaxation("0.5:200ms");
  return plan;
}

class RelaxingTissue : public WindowTest
{
protected:
  RelaxingTissue()
    : WindowTest(relaxing())
  {
  }
};

// not as the law would answer without what was done before
TEST_F(RelaxingTissue, IsExportedAsItWasFelt)
{
  press(100);
  ASSERT_TRUE(QTest::qWaitFor([&] { return peakForce() > 0.5; }, kPatience));
  release();
  EXPECT_TRUE(waitForLift());
  const std::filesystem::path first = folder_.path() / "first";
  ASSERT_TRUE(window_->exportData(QString::fromStdString(first.string())));
  const test::CsvTable samples = test::readCsv(first / "samples.csv");
  EXPECT_EQ(std::ranges::max(samples["force_N"]), peakForce());
  const std::string presses = test::readAll(first / "presses.csv");
  EXPECT_NE(presses.find(',' + shortest(peakForce()) + ','), std::string::npos) << presses;
  const test::Finished run = test::runCommand(
    PALP_PROGRAM " run " + first.string() + " --out " + (folder_.path() / "again").string());
  EXPECT_NE(run.err.find("repeated to the byte"), std::string::npos) << run.err;
}

TEST_F(WindowTest, ExportsTheDentAsFineAsInThePicture)
{
  press(100);
  ASSERT_TRUE(QTest::qWaitFor([&] { return peakForce() > 1.0; }, kPatience));
  release();
  const auto pointsOfExport = [&](const char* name)
  {
    const auto folder = folder_.path() / name;
    EXPECT_TRUE(window_->exportData(QString::fromStdString(folder.string())));
    const QString said = WindowTest::said();
    EXPECT_TRUE(said.contains(name)) << said.toStdString();
    return readSurface(folder / "deformed.vtp").mesh->GetNumberOfPoints();
  };
  EXPECT_EQ(pointsOfExport("as it is"), session_->body().display->GetNumberOfPoints());
  window_->findChild<QAction*>("refinedExport")->trigger();
  EXPECT_GT(pointsOfExport("refined"), session_->body().display->GetNumberOfPoints());
}

TEST_F(WindowTest, AsksBeforeAnExportReplacesFiles)
{
  const auto file = folder_.path() / "samples.csv";
  std::ofstream(file) << "mine";
  EXPECT_FALSE(window_->exportData(QString::fromStdString(folder_.path().string())));
  EXPECT_TRUE(said().contains("samples.csv")) << said().toStdString();
  EXPECT_EQ(test::readAll(file), "mine");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_.path()), {}), 1);
  answer("Replace");
  EXPECT_TRUE(test::readAll(file).starts_with("# palp"));
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "servo.csv"));
}

// a change of the tool ends a recording, and loses nothing
TEST_F(WindowTest, KeepsAndExportsWhatAChangeEnds)
{
  press(100);
  release();
  EXPECT_TRUE(waitForLift());
  waitForRest();
  const double peak = peakForce();
  window_->findChild<QComboBox*>("kind")->setCurrentIndex(1);
  EXPECT_TRUE(said().contains("kept"));
  ASSERT_EQ(session_->earlier().size(), 1U);
  EXPECT_TRUE(std::holds_alternative<SphereTip>(session_->earlier()[0].recording.scene.law.tip()));
  ASSERT_TRUE(window_->exportData(QString::fromStdString(folder_.path().string())));
  // the last that touched is what the folder opens
  const auto peakIn = [](const std::filesystem::path& folder)
  {
    const test::CsvTable samples = test::readCsv(folder / "samples.csv");
    const auto& force = samples["force_N"];
    return *std::max_element(force.begin(), force.end());
  };
  EXPECT_NEAR(peakIn(folder_.path()), peak, 1e-9);
  EXPECT_TRUE(isExport(folder_.path()));

  press(60); // by the other tool
  release();
  EXPECT_TRUE(waitForLift());
  waitForRest();
  const auto both = folder_.path() / "both";
  std::filesystem::create_directories(both);
  for (const char* stale : { "earlier-1", "earlier-2", "earlier-3" })
  {
    std::filesystem::copy(folder_.path(), both / stale); // files alone
  }
  ASSERT_TRUE(window_->exportData(QString::fromStdString(both.string())));
  EXPECT_NEAR(peakIn(both / "earlier-1"), peak, 1e-9);
  EXPECT_GT(std::abs(peakIn(both) - peak), 1e-3);
  EXPECT_FALSE(std::filesystem::exists(both / "earlier-2")) << "of another session";
}

} // namespace
} // namespace palp
