#include "app/panels/tool_panel.h"
#include "haptics/contact/contact_geometry_of.h"
#include "haptics/error.h"
#include "tests/app/window/window_rig.h"
#include "tests/support/dicom_series.h"

#include <QAction>
#include <QComboBox>
#include <QDialog>
#include <QLabel>
#include <QLineEdit>
#include <QScreen>
#include <QStatusBar>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>

namespace palp
{
namespace
{

using test::WindowTest;

TEST_F(WindowTest, TakesAnotherTool)
{
  window_->findChild<QComboBox*>("kind")->setCurrentIndex(1);
  EXPECT_TRUE(std::holds_alternative<ConeTip>(session_->recording().scene.law.tip()));
}

// what was recorded is of one tool and tissue
TEST_F(WindowTest, AnotherToolBeginsTheRecordingAnew)
{
  press(160); // deeper than what comes
  release();
  EXPECT_TRUE(
    QTest::qWaitFor([this] { return !session_->newest().contact.touching(); }, kPatience));
  window_->findChild<QComboBox*>("kind")->setCurrentIndex(1);
  press(60);
  release();
  const Sample* deepest = session_->recording().deepest();
  ASSERT_NE(deepest, nullptr);
  EXPECT_LT(deepest->contact.depth, 4.1e-3);
  const ForceLaw& law = session_->recording().scene.law;
  EXPECT_NEAR(deepest->response.force, law({ .depth = deepest->contact.depth }).force, 1e-9);
}

// the force at the place that is held, from a law made here
TEST_F(WindowTest, TheCorrectedLawAnswersAHeldPress)
{
  press(100);
  window_->findChild<QComboBox*>("law")->setCurrentText("Corrected");
  const ForceLaw law(SphereTip{ 0.01 }, Material{ 50e3, 0.33 },
    { .mode = LawMode::Corrected,
      .largeStrain = readLargeStrain(PALP_SHARE "/tables/large_strain_sphere.csv",
        PALP_SHARE "/tables/large_strain_cone.csv") });
  const ForceLaw paper(SphereTip{ 0.01 }, Material{ 50e3, 0.33 });
  const auto answers = [&]
  {
    const Sample sample = session_->newest();
    return std::abs(sample.response.force - law(contactGeometryOf(sample.contact)).force) < 1e-9;
  };
  EXPECT_TRUE(QTest::qWaitFor(answers, kPatience));
  const Sample sample = session_->newest();
  EXPECT_GT(std::abs(sample.response.force - paper(contactGeometryOf(sample.contact)).force), 0.02);
  release();
}

TEST_F(WindowTest, ARefusedProfileLeavesEverythingAsItWas)
{
  const std::string file = (folder_.path() / "falling.csv").string();
  std::ofstream(file) << "radius_mm,height_mm\n0,0\n1,2\n2,1\n";
  window_->findChild<ToolPanel*>()->askForProfile(file.c_str());
  EXPECT_TRUE(said().contains("falling.csv") && said().contains("the height falls"))
    << said().toStdString();
  EXPECT_TRUE(std::holds_alternative<SphereTip>(session_->recording().scene.law.tip()));
  EXPECT_EQ(window_->findChild<QComboBox*>("kind")->currentText(), "Sphere");
}

// R_d of a cone is known for one thickness only
TEST_F(WindowTest, AToolWithoutAnExtentLeavesEverythingAsItWas)
{
  ScenePlan plan;
  plan.press.dent.layer = 0.04;
  window_.reset();
  session_ = std::make_unique<Session>(plan, silent_);
  window_ = std::make_unique<Window>(*session_, silent_);
  auto* kind = window_->findChild<QComboBox*>("kind");
  kind->setCurrentText("Cone");
  EXPECT_TRUE(said().contains("for a cone")) << said().toStdString();
  EXPECT_TRUE(std::holds_alternative<SphereTip>(session_->recording().scene.law.tip()));
  EXPECT_EQ(kind->currentText(), "Sphere");
}

TEST_F(WindowTest, WhatFailsLeavesEverythingAsItWas)
{
  const std::string file = (folder_.path() / "path.csv").string();
  std::ofstream(file) << "time_s,x_mm,y_mm,z_mm\n0,0,0,200\n1,0,0,200\n";
  session_->useDevice(parseDevice("path:" + file));
  const std::string body = session_->body().name;
  std::filesystem::remove(file);
  EXPECT_THROW(session_->open(loadBody({ { .file = PALP_SHARE "/meshes/sphere_50.vtp" } })), Error);
  EXPECT_EQ(session_->body().name, body);
  EXPECT_EQ(session_->recording().mesh, body);
  EXPECT_EQ(session_->recording().device, "path:" + file);
}

TEST_F(WindowTest, OpensAnotherSurface)
{
  ASSERT_TRUE(window_->openFile(PALP_SHARE "/meshes/sphere_50.vtp"));
  EXPECT_EQ(session_->body().name, "sphere_50.vtp");
  EXPECT_TRUE(window_->windowTitle().contains("sphere_50.vtp"));
  press(80);
  EXPECT_NEAR(session_->newest().contact.depth, 5e-3, 0.02e-3);
  release();
}

// a mask of a ball
std::string writeMask(const std::filesystem::path& file)
{
  constexpr int kSide = 40;
  std::ofstream out(file, std::ios::binary);
  out << "ObjectType = Image\nNDims = 3\nDimSize = 40 40 40\nElementSpacing = 2 2 2\n"
         "DistanceUnits = mm\nElementType = MET_UCHAR\nElementDataFile = LOCAL\n";
  for (int i = 0; i < kSide * kSide * kSide; ++i)
  {
    const Eigen::Vector3d from(
      i % kSide - 19.5, i / kSide % kSide - 19.5, i / kSide / kSide - 19.5);
    out.put(from.norm() < 15.0 ? 1 : 0);
  }
  return file.string();
}

TEST_F(WindowTest, AsksForTheLevelOfAnImage)
{
  const std::string file = writeMask(folder_.path() / "mask.mha");
  std::vector<QString> reasons;
  QStringList levels{ "0,5", "7", "0.5", "0.5" }; // typed in turn
  QStringList labels{ "", "", "1", "" };
  QTimer typist;
  QObject::connect(&typist, &QTimer::timeout,
    [&]
    {
      auto* dialog = qobject_cast<QDialog*>(QApplication::activeModalWidget());
      if (dialog != nullptr && !levels.isEmpty())
      {
        reasons.push_back(dialog->findChild<QLabel*>("why")->text());
        dialog->findChild<QLineEdit*>("level")->setText(levels.takeFirst());
        dialog->findChild<QLineEdit*>("label")->setText(labels.takeFirst());
        dialog->accept();
      }
    });
  typist.start(200);
  ASSERT_TRUE(window_->openFile(QString::fromStdString(file)));
  ASSERT_EQ(reasons.size(), 4U);
  EXPECT_TRUE(reasons[0].contains("level")) << reasons[0].toStdString();
  EXPECT_TRUE(reasons[1].contains("comma")) << reasons[1].toStdString();
  EXPECT_TRUE(reasons[2].contains("7")) << reasons[2].toStdString();
  EXPECT_TRUE(reasons[3].contains("more than one is given")) << reasons[3].toStdString();
  EXPECT_EQ(session_->body().name, "mask.mha");
  press(60);
  release();
}

// two phases of a scan: asks for the series, then for the level
TEST_F(WindowTest, OpensAFolderOfDicomImages)
{
  const test::DicomGrid grid{ 30, 30, 12, { 5.0, -7.0, 900.0 }, Eigen::Vector3d::UnitX(),
    Eigen::Vector3d::UnitY(), 1.0, 1.0, 2.5 };
  test::writeDicom(folder_.path(), "scan", grid, "--write-xfer-little");
  test::writeDicom(folder_.path(), "scan", grid, "--write-xfer-little", { .series = "1.2.3.2" });
  std::vector<QString> reasons;
  QStringList series{ "", "2" }; // typed in turn
  QTimer typist;
  QObject::connect(&typist, &QTimer::timeout,
    [&]
    {
      auto* dialog = qobject_cast<QDialog*>(QApplication::activeModalWidget());
      if (dialog != nullptr && !series.isEmpty())
      {
        reasons.push_back(dialog->findChild<QLabel*>("why")->text());
        dialog->findChild<QLineEdit*>("series")->setText(series.takeFirst());
        dialog->findChild<QLineEdit*>("level")->setText(QString::number(test::kDicomLevel));
        dialog->accept();
      }
    });
  typist.start(200);
  ASSERT_TRUE(window_->openFile(QString::fromStdString((folder_.path() / "scan").string())));
  ASSERT_EQ(reasons.size(), 2U);
  EXPECT_TRUE(reasons[1].contains("has 2 series: 1 'abdomen'")) << reasons[1].toStdString();
  EXPECT_EQ(session_->body().name, "scan");
  press(60);
  release();
}

TEST_F(WindowTest, SaysWhatItDidWhereNothingElseShowsIt)
{
  const QString shot = QString::fromStdString((folder_.path() / "shot.png").string());
  ASSERT_TRUE(window_->saveScreenshot(shot));
  EXPECT_TRUE(said().contains(shot) && said().contains("pixels")) << said().toStdString();
  auto* devices = window_->findChild<QComboBox*>("device");
  devices->setCurrentIndex(devices->count() - 1); // scan
  EXPECT_TRUE(said().contains("evice")) << said().toStdString();
  EXPECT_EQ(devices->currentText(), "mouse");
  EXPECT_TRUE(devices->itemText(devices->count() - 1).contains("Scan")) << "can be asked again";
}

TEST_F(WindowTest, FitsASmallScreenWithItsStatusBar)
{
  window_->findChild<QAction*>("plotsAction")->setChecked(true);
  // 1280 x 720 and 1024 x 768 without a title bar; on a higher screen the panels ask for more
  const int screen = window_->screen()->availableSize().height();
  const QSize small(1008, std::max(672, screen * 7 / 10));
  window_->resize(small);
  const auto fits = [&] { return window_->size() == small && canvas_->width() >= 300; };
  EXPECT_TRUE(QTest::qWaitFor(fits, kPatience));
  const QRect bar(
    window_->statusBar()->mapTo(window_.get(), QPoint()), window_->statusBar()->size());
  EXPECT_TRUE(window_->rect().contains(bar));
}

} // namespace
} // namespace palp
