#include "app/organs/organ_list.h"
#include "calibration/tables/organ_table.h"
#include "haptics/surface/area_and_volume.h"
#include "haptics/units.h"
#include "pipeline/model/poly_data.h"
#include "tests/app/dialog_closer.h"
#include "tests/app/window/window_rig.h"

#include <QCheckBox>
#include <QDialog>
#include <QDockWidget>
#include <QDropEvent>
#include <QLineEdit>
#include <QListWidget>
#include <QMimeData>
#include <QTreeWidget>
#include <QUrl>

#include <array>
#include <fstream>
#include <gtest/gtest.h>
#include <numbers>
#include <vtkPolyData.h>

namespace palp
{
namespace
{

using namespace units::literals;
using test::WindowTest;

struct Ball
{
  const char* name;
  Eigen::Vector3d center; // LPS [mm]
  double radius;          // [mm]
};

// a liver in front of a kidney, and a spleen beside it
const std::array kBalls{ Ball{ "liver", { -30.6, 0.3, 0.7 }, 30.2 },
  Ball{ "left kidney", { 42.7, 14.3, -6.4 }, 18.2 },
  Ball{ "spleen", { 40.3, -25.6, 20.7 }, 14.3 } };

// as 3D Slicer writes a segmentation, by the definition of NRRD
void writeSegmentation(const std::filesystem::path& file)
{
  std::ofstream out(file, std::ios::binary);
  out << "NRRD0004\ntype: unsigned char\ndimension: 3\nspace: left-posterior-superior\n"
         "sizes: 70 50 40\nspace directions: (2,0,0) (0,2,0) (0,0,2)\n"
         "kinds: domain domain domain\nencoding: raw\nspace origin: (-70,-50,-40)\n";
  for (std::size_t i = 0; i < kBalls.size(); ++i)
  {
    const std::string segment = "Segment" + std::to_string(i) + "_";
    out << segment << "ID:=Segment_" << i + 1 << '\n'
        << segment << "LabelValue:=" << i + 1 << '\n'
        << segment << "Layer:=0\n"
        << segment << "Name:=" << kBalls[i].name << '\n';
  }
  out << '\n';
  for (int voxel = 0; voxel < 70 * 50 * 40; ++voxel)
  {
    const Eigen::Vector3d place(
      2.0 * (voxel % 70) - 70.0, 2.0 * (voxel / 70 % 50) - 50.0, 2.0 * (voxel / 3500) - 40.0);
    char label = 0;
    for (std::size_t i = 0; i < kBalls.size(); ++i)
    {
      const bool isIn = (place - kBalls[i].center).norm() < kBalls[i].radius;
      label = isIn ? static_cast<char>(i + 1) : label;
    }
    out.put(label);
  }
}

class OpenOrgans : public WindowTest
{
protected:
  OpenOrgans()
  {
    writeSegmentation(file_);
  }

  // answers the dialog by ticking labels
  void drop(const std::vector<int>& ticked, bool areOrgans)
  {
    QTimer typist;
    QObject::connect(&typist, &QTimer::timeout,
      [&]
      {
        auto* dialog = qobject_cast<QDialog*>(QApplication::activeModalWidget());
        auto* list = dialog != nullptr ? dialog->findChild<QListWidget*>("labels") : nullptr;
        if (list == nullptr || isAnswered_)
        {
          return;
        }
        isAnswered_ = true;
        for (int row = 0; row < list->count(); ++row)
        {
          rows_ << list->item(row)->text();
        }
        for (const int row : ticked)
        {
          list->item(row)->setCheckState(Qt::Checked);
        }
        dialog->findChild<QCheckBox*>("areOrgans")->setChecked(areOrgans);
        dialog->accept();
      });
    typist.start(100);
    QMimeData files;
    files.setUrls({ QUrl::fromLocalFile(QString::fromStdString(file_.string())) });
    QDragEnterEvent enter({ 400, 300 }, Qt::CopyAction, &files, Qt::LeftButton, {});
    QApplication::sendEvent(window_.get(), &enter);
    QDropEvent event({ 400, 300 }, Qt::CopyAction, &files, Qt::LeftButton, {});
    QApplication::sendEvent(window_.get(), &event);
    EXPECT_TRUE(QTest::qWaitFor(
      [this] { return isAnswered_ && session_->body().name != "liver.vtp"; }, kPatience));
  }

  // against the ball of its name
  void expectBall(const SceneBody& organ, const Ball& ball) const
  {
    const std::vector<Eigen::Vector3d> points = pointsOf(*organ.display);
    const double volume = enclosedVolume(points, trianglesOf(*organ.display));
    const double exact = 4.0 / 3.0 * std::numbers::pi * std::pow(ball.radius * 1.0_mm, 3);
    EXPECT_NEAR(volume, exact, 0.02 * exact) << organ.name;
    double farthest = 0.0;
    for (const Eigen::Vector3d& point : points)
    {
      const double radius = (point - ball.center * 1.0_mm).norm();
      farthest = std::max(farthest, std::abs(radius - ball.radius * 1.0_mm));
    }
    EXPECT_LT(farthest, 1.5_mm) << organ.name; // voxels of 2 mm
  }

  [[nodiscard]] QDockWidget* dock() const
  {
    return window_->findChild<QDockWidget*>("Organs");
  }

  test::TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.path() / "abdomen.seg.nrrd";
  QStringList rows_; // that the dialog listed
  bool isAnswered_ = false;
};

TEST_F(OpenOrgans, ADroppedLabelMapBecomesTheOrgansThatAreTicked)
{
  EXPECT_EQ(dock(), nullptr);
  drop({ 0, 1 }, true);
  ASSERT_EQ(rows_.size(), 3);
  EXPECT_TRUE(
    rows_[1].contains("left kidney") && rows_[1].contains("voxels") && rows_[1].contains("ml"))
    << rows_[1].toStdString();
  const std::vector<OrganPlan>& organs = session_->organs();
  ASSERT_EQ(organs.size(), 2U);
  EXPECT_EQ(organs[0].name, "liver");
  EXPECT_EQ(organs[1].name, "left kidney");
  EXPECT_NE(organs[0].color, organs[1].color);
  EXPECT_NE(organs[0].press.tissue.young, organs[1].press.tissue.young) << "healthy liver";
  expectBall(session_->body().organs[0], kBalls[0]);
  expectBall(session_->body().organs[1], kBalls[1]);
  ASSERT_NE(dock(), nullptr);
  EXPECT_TRUE(QTest::qWaitFor([&] { return dock()->isVisible(); }, kPatience));
  EXPECT_EQ(window_->findChild<QTreeWidget*>("organRows")->topLevelItemCount(), 2);

  ASSERT_TRUE(window_->openFile(PALP_SHARE "/meshes/sphere_50.vtp"));
  EXPECT_TRUE(session_->organs().empty());
  EXPECT_FALSE(dock()->isVisible());
  press(60);
  release();
}

TEST_F(OpenOrgans, TickedLabelsAreOneBodyWhereThatIsAsked)
{
  drop({ 0, 2 }, false);
  EXPECT_TRUE(session_->organs().empty());
  EXPECT_EQ(session_->body().sources.front().part.labels, (std::vector<std::string>{ "1", "3" }));
}

// and a press of them is repeated by what is exported
TEST_F(OpenOrgans, TheSceneOfAnImportOpensInTheWindow)
{
  const std::filesystem::path made = folder_.path() / "organs";
  const test::Finished imported =
    test::runCommand(PALP_PROGRAM " import " + file_.string() + " --out " + made.string());
  ASSERT_EQ(imported.code, 0) << imported.err;
  ASSERT_TRUE(window_->openFiles({ QString::fromStdString((made / "scene.json").string()) }));
  ASSERT_EQ(session_->organs().size(), 3U);
  for (std::size_t i = 0; i < kBalls.size(); ++i)
  {
    EXPECT_EQ(session_->organs()[i].name, kBalls[i].name);
    expectBall(session_->body().organs[i], kBalls[i]);
  }
  EXPECT_EQ(session_->recording().scene.law.material().youngModulus,
    session_->organs()[0].press.tissue.young);
  press(60);
  release();
  EXPECT_TRUE(waitForLift());
  const auto& presses = session_->presses().presses();
  ASSERT_TRUE(QTest::qWaitFor([&] { return presses.size() == 1; }, kPatience));
  const std::filesystem::path out = folder_.path() / "out";
  ASSERT_TRUE(window_->exportData(QString::fromStdString(out.string())));
  const test::Finished again = test::runCommand(
    PALP_PROGRAM " run " + out.string() + " --out " + (folder_.path() / "again").string());
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_NE(again.err.find("repeated to the byte"), std::string::npos) << again.err;
}

// the organ that is chosen in the list, by its tissue
TEST_F(OpenOrgans, TheMapIsOfTheOrganThatIsChosen)
{
  drop({ 0, 1 }, true);
  window_->findChild<OrganList*>()->choose("left kidney");
  QTimer::singleShot(0, window_.get(),
    [&]
    {
      auto* dialog = window_->findChild<QDialog*>("mapDialog");
      ASSERT_NE(dialog, nullptr);
      type("mapDepth", "2");
      dialog->accept();
    });
  window_->findChild<QAction*>("mapAction")->trigger();
  EXPECT_TRUE(QTest::qWaitFor([this] { return said().startsWith("Stiffness map:"); }, kPatience))
    << said().toStdString();
  press(60); // the liver, perhaps: an export wants a press
  release();
  EXPECT_TRUE(waitForLift());
  EXPECT_TRUE(
    QTest::qWaitFor([this] { return !session_->presses().presses().empty(); }, kPatience));
  const std::filesystem::path out = folder_.path() / "out";
  ASSERT_TRUE(window_->exportData(QString::fromStdString(out.string())));
  std::ifstream in(out / "stiffness_map.csv");
  int places = 0;
  for (std::string line; std::getline(in, line);)
  {
    if (line.starts_with('#') || line.starts_with("x_mm"))
    {
      places += line == "# surface: left kidney" ? 1000 : 0;
      continue;
    }
    const Eigen::Vector3d place = [&]
    {
      Eigen::Vector3d three;
      char comma = 0;
      std::istringstream(line) >> three.x() >> comma >> three.y() >> comma >> three.z();
      return three;
    }();
    EXPECT_NEAR((place - kBalls[1].center).norm(), kBalls[1].radius, 1.5);
    ++places;
  }
  EXPECT_GT(places, 1010) << "the kidney's name, and places on it";
}

// of the surface that is open it is felt at once, of another one it is refused
TEST_F(WindowTest, DroppedOrganFileIsFelt)
{
  const test::TemporaryFolder folder;
  const auto drop = [&](const std::string& mesh)
  {
    OrganTable table;
    table.mesh = mesh;
    table.spacing = 200.0_mm;
    for (int face = 0; face < 6; ++face) // whichever the pointer is on
    {
      const double outward = face % 2 == 0 ? 1.0 : -1.0;
      table.places.push_back(
        { .normal = outward * Eigen::Vector3d::Unit(face / 2), .constant = 1000.0 });
    }
    table.count = table.places.size();
    const std::filesystem::path file = folder.path() / "liver.organ";
    writeOrganTable(file, table);
    return window_->openFiles({ QString::fromStdString(file.string()) });
  };
  EXPECT_FALSE(drop("of another one"));
  EXPECT_EQ(session_->recording().scene.series, nullptr);
  EXPECT_TRUE(drop(identityOf(session_->body().files.front())));
  ASSERT_NE(session_->recording().scene.series, nullptr);
  EXPECT_EQ(session_->recording().scene.series->field->places(), 6U);
  EXPECT_EQ(session_->body().sources.front().bundled, "liver");
  press(40);
  const Sample sample = session_->newest();
  EXPECT_LT(sample.localDepth, 0.99 * sample.contact.depth);
}

// no answer to a question opens these
TEST_F(WindowTest, AFileThatCannotBeReadIsToldInTheBar)
{
  const test::DialogCloser closer;
  const auto tells = [&](const char* name, const std::string& bytes, const char* why)
  {
    const std::filesystem::path file = folder_.path() / name;
    bytes.empty() ? void() : void(std::ofstream(file) << bytes);
    const QString path = QString::fromStdString(file.string());
    EXPECT_FALSE(window_->openFile(path)) << name;
    EXPECT_TRUE(said().startsWith(path + ": ") && said().contains(why)) << said().toStdString();
  };
  const std::string whole = test::readAll(PALP_SHARE "/meshes/block_50.vtp");
  tells("gone.stl", "", "there is no such file");
  tells("word.stl", "solid x", "not an STL file");
  tells("cut.vtp", whole.substr(0, whole.size() / 2), "export");
  tells("picture.png", "\x89PNG\r\n", "give a surface");
  EXPECT_EQ(closer.count(), 0);
}

} // namespace
} // namespace palp
