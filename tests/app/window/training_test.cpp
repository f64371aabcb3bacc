#include "app/folder/autosave.h"
#include "app/panels/validity_panel.h"
#include "haptics/surface/closest_point.h"
#include "tests/app/dialog_closer.h"
#include "tests/app/window/window_rig.h"

#include <QComboBox>
#include <QImage>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>

#include <filesystem>
#include <gtest/gtest.h>
#include <limits>
#include <nlohmann/json.hpp>

namespace palp
{
namespace
{

using test::WindowTest;

// healthy liver, and a law that knows nodules
ScenePlan planOfTraining()
{
  ScenePlan plan;
  plan.press.tissue.options.mode = LawMode::Corrected;
  plan.press.tissue.young = 6.63e3;
  plan.press.tissue.poisson = 0.49;
  return plan;
}

class TrainingTest : public WindowTest
{
protected:
  TrainingTest()
    : WindowTest(planOfTraining())
  {
    window_->saveTo(autosave_);
    window_->findChild<QAction*>("trainingAction")->trigger();
  }

  ~TrainingTest() override
  {
    session_->saveTo(nullptr);
  }

  void start(const char* seed)
  {
    window_->findChild<QLineEdit*>("trainingSeed")->setText(seed);
    click("trainingStart");
  }

  void click(const char* button)
  {
    auto* found = window_->findChild<QPushButton*>(button);
    EXPECT_TRUE(QTest::qWaitFor([&] { return found->isVisible(); }, kPatience));
    QTest::mouseClick(found, Qt::LeftButton);
  }

  // on the surface, right above one
  [[nodiscard]] Eigen::Vector3d above(std::size_t nodule) const
  {
    return findClosestPoint(*session_->body().haptic, session_->body().nodules[nodule].center,
      std::numeric_limits<double>::infinity())
      .point;
  }

  // until the tool is down there
  void pressAt(const Eigen::Vector3d& place)
  {
    EXPECT_TRUE(waitForLift());
    auto* field = window_->findChild<QLineEdit*>("pressPlace");
    field->setText(QString("%1, %2, %3")
                     .arg(1e3 * place.x(), 0, 'f', 3)
                     .arg(1e3 * place.y(), 0, 'f', 3)
                     .arg(1e3 * place.z(), 0, 'f', 3));
    QTest::keyClick(field, Qt::Key_Return);
    waitFor([](const Sample& sample) { return sample.contact.depth > 4e-3; });
  }

  // the largest force of such a press [N]
  double pressedAt(const Eigen::Vector3d& place)
  {
    const std::size_t before = session_->presses().presses().size();
    pressAt(place);
    waitForPresses(before + 1);
    return session_->presses().presses().back().summary.force;
  }

  void mark()
  {
    QTest::keyClick(canvas_, Qt::Key_M);
  }

  [[nodiscard]] QString told() const
  {
    return window_->findChild<QLabel*>("trainingTold")->text();
  }

  // once nothing moves any more
  QImage picture(const char* name)
  {
    waitForFrames();
    const QString file = QString::fromStdString((folder_.path() / name).string());
    EXPECT_TRUE(window_->saveScreenshot(file));
    return QImage(file);
  }

  [[nodiscard]] static int greens(const QImage& image)
  {
    int count = 0;
    for (int y = 0; y < image.height(); ++y)
    {
      for (int x = 0; x < image.width(); ++x)
      {
        const QColor color = image.pixelColor(x, y);
        count += color.green() > 1.3 * color.red() && color.green() > 1.1 * color.blue() ? 1 : 0;
      }
    }
    return count;
  }

  [[nodiscard]] std::size_t filesKept() const
  {
    const std::filesystem::recursive_directory_iterator all(folder_.path() / "kept");
    return static_cast<std::size_t>(std::count_if(begin(all), end(all),
      [](const auto& entry) { return entry.path().filename() == "scene.json"; }));
  }

  Autosave autosave_{ folder_.path() / "kept" };
};

TEST_F(TrainingTest, FindsMarksGradesRevealsAndRepeats)
{
  const QImage before = picture("before.png");
  start("4");
  ASSERT_EQ(session_->body().nodules.size(), 3U);
  EXPECT_EQ(picture("hidden.png"), before); // not a pixel of what is hidden
  pressAt(above(0));
  mark();
  pressAt(above(1));
  mark();
  const Eigen::Vector3d beside = above(2) + Eigen::Vector3d(0.02, 0.0, 0.0);
  pressAt(findClosestPoint(*session_->body().haptic, beside, 1.0).point);
  mark();
  EXPECT_TRUE(waitForLift());
  EXPECT_LT(greens(picture("marked.png")), 20);
  EXPECT_EQ(filesKept(), 0U);
  click("trainingFinish");
  EXPECT_TRUE(told().contains("2 of 3 nodules found, 1 false mark")) << told().toStdString();
  EXPECT_GT(greens(picture("revealed.png")), 200);

  const auto out = folder_.path() / "graded";
  ASSERT_TRUE(window_->saveSheet(QString::fromStdString(out.string()))) << said().toStdString();
  const auto score = nlohmann::json::parse(test::readAll(out / "score.json"));
  EXPECT_EQ(score["seed"], 4);
  EXPECT_EQ(score["measures"]["hits"], 2);
  EXPECT_EQ(score["measures"]["false_marks"], 1);
  EXPECT_LT(score["measures"]["distance_error_mm"], 1.0);
  const test::Finished again = test::runCommand(
    PALP_PROGRAM " train " + out.string() + " --out " + (folder_.path() / "again").string());
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_NE(again.err.find("repeated to the byte"), std::string::npos) << again.err;
}

TEST_F(TrainingTest, AMarkIsTakenBackUntilItIsGraded)
{
  start("4");
  EXPECT_TRUE(said().contains("Ctrl+Z")) << said().toStdString();
  const auto undo = [this](Qt::Key key)
  { QTest::keyClick(window_.get(), key, Qt::ControlModifier); };
  const auto marks = [this](const char* count)
  { return QTest::qWaitFor([&] { return told().contains(count); }, kPatience); };
  pressAt(above(0));
  mark();
  mark();
  EXPECT_TRUE(marks("2 marked")) << told().toStdString();
  undo(Qt::Key_Z);
  EXPECT_TRUE(marks("1 marked")) << told().toStdString();
  undo(Qt::Key_Z);
  EXPECT_TRUE(marks("0 marked")) << told().toStdString();
  undo(Qt::Key_Z); // there is none
  undo(Qt::Key_Y);
  EXPECT_TRUE(marks("1 marked")) << told().toStdString();
  click("trainingFinish");
  EXPECT_TRUE(told().contains("1 of 3 nodules found, 0 false marks")) << told().toStdString();
  EXPECT_FALSE(window_->findChild<QAction*>("undoAction")->isEnabled());
}

TEST_F(TrainingTest, WhatToDoIsNotHiddenByTheFirstGreeting)
{
  start("4");
  window_->greet();
  EXPECT_TRUE(said().contains("mark with M")) << said().toStdString();
}

TEST_F(TrainingTest, TellsOfNoNoduleBeforeItIsGraded)
{
  start("4");
  const auto rules = [this] { return window_->findChild<ValidityPanel*>()->text(); };
  const Eigen::Vector3d place = above(0);
  pressAt(place);
  EXPECT_TRUE(QTest::qWaitFor([&] { return rules().contains("depth"); }, kPatience));
  EXPECT_FALSE(rules().contains("nodule"));
  EXPECT_FALSE(window_->exportData(QString::fromStdString((folder_.path() / "early").string())));
  EXPECT_TRUE(said().contains("finish it first")) << said().toStdString();
  EXPECT_FALSE(window_->openFile(PALP_SHARE "/meshes/block_50.vtp"));
  EXPECT_FALSE(window_->findChild<QAction*>("plotsAction")->isEnabled());
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "early"));
  window_->findChild<QAction*>("gradeAction")->trigger();
  EXPECT_TRUE(told().contains("0 of 3")) << told().toStdString();
  pressAt(place);
  EXPECT_TRUE(QTest::qWaitFor([&] { return rules().contains("nodule"); }, kPatience));
}

TEST_F(TrainingTest, RefusesWhatTheSearchForbidsBeforeItAsksForAFile)
{
  start("4");
  pressAt(above(0));
  const test::DialogCloser closer;
  for (const char* name : { "exportAction", "movieAction", "turntableAction", "openAction" })
  {
    window_->findChild<QAction*>(name)->trigger();
    EXPECT_EQ(closer.count(), 0) << name;
    EXPECT_TRUE(said().contains("finish it first")) << said().toStdString();
  }
  window_->findChild<QAction*>("gradeAction")->trigger();
  window_->findChild<QAction*>("exportAction")->trigger();
  EXPECT_EQ(closer.count(), 1);
}

TEST_F(TrainingTest, SaysWhatIsMissing)
{
  start("minus one");
  EXPECT_TRUE(said().contains("Seed")) << said().toStdString();
  start("9");
  mark();
  EXPECT_TRUE(said().contains("Nothing was touched yet")) << said().toStdString();
  window_->findChild<QAction*>("gradeAction")->trigger();
  EXPECT_TRUE(told().contains("nothing is graded")) << told().toStdString();
  EXPECT_FALSE(window_->saveSheet(QString::fromStdString((folder_.path() / "none").string())));
  EXPECT_TRUE(QTest::qWaitFor([this] { return session_->body().nodules.empty(); }, kPatience))
    << "none is left that nobody sees";
  EXPECT_EQ(session_->scene().nodules, nullptr);
}

TEST_F(TrainingTest, NodulesThatWereGradedAreFeltByTheCorrectedLawUntilTheyAreTakenOut)
{
  start("4");
  const Eigen::Vector3d place = above(0);
  pressAt(place);
  window_->findChild<QAction*>("gradeAction")->trigger();
  EXPECT_TRUE(waitForLift());
  auto* law = window_->findChild<QComboBox*>("law");
  for (const char* other : { "Paper", "Exact half-space" })
  {
    law->setCurrentText(other);
    EXPECT_TRUE(said().contains("corrected law")) << said().toStdString();
    EXPECT_EQ(law->currentText(), "Corrected");
  }
  ASSERT_NE(session_->scene().nodules, nullptr);
  const double stiff = pressedAt(place);
  const auto sheet = folder_.path() / "sheet";
  ASSERT_TRUE(window_->saveSheet(QString::fromStdString(sheet.string()))) << said().toStdString();
  window_->findChild<QAction*>("noNodulesAction")->trigger();
  EXPECT_TRUE(QTest::qWaitFor([this] { return session_->body().nodules.empty(); }, kPatience));
  EXPECT_FALSE(window_->findChild<QAction*>("noNodulesAction")->isEnabled());
  law->setCurrentText("Paper");
  EXPECT_EQ(session_->scene().law.settings().mode, LawMode::Paper);

  ASSERT_TRUE(window_->openFiles({ QString::fromStdString((sheet / "scene.json").string()) }));
  EXPECT_EQ(session_->body().nodules.size(), 3U) << "as palp view SHEET";
  EXPECT_EQ(session_->scene().law.settings().mode, LawMode::Corrected);
  EXPECT_NEAR(pressedAt(place), stiff, 1e-3 * stiff);
}

} // namespace
} // namespace palp
