#include "app/check/panel/check_panel.h"
#include "app/check/panel/fault_marks.h"
#include "app/organs/organ_list.h"
#include "data/shapes.h"
#include "haptics/files/csv_text.h"
#include "haptics/units.h"
#include "tests/app/window/window_rig.h"

#include <QDockWidget>
#include <QFileDialog>
#include <QImage>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QTableWidget>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <sstream>

namespace palp
{
namespace
{

using namespace units::literals;
using test::WindowTest;
using Place = Eigen::Vector3d; // [mm]

// where the block below has each fault
const Place kHole(-20.0, 6.0, 0.0);
const Place kDuplicate(0.0, 22.0, 0.0);
const Place kFlipped(20.0, -10.0, 0.0);
const Place kSliver(22.0, 20.0, 0.0);
const Place kBelow(12.0, -10.0, -20.0); // a hole, too, on the other side; as wide
const Place kCrossing(-6.0, -22.0, 0.0);

struct Faults
{
  bool hole = true;
  bool below = false;    // in the place of that
  bool crossing = false; // which no repair takes away
};

std::size_t nearest(const Mesh& mesh, const Place& place)
{
  const auto away = [&](const Triangle& triangle)
  {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const int corner : triangle)
    {
      sum += mesh.points[at(corner)];
    }
    return (1e3 * sum / 3.0 - place).norm();
  };
  return static_cast<std::size_t>(
    std::ranges::min_element(mesh.triangles, {}, away) - mesh.triangles.begin());
}

// a block of 64 x 64 x 20 mm below its top at z = 0, with triangles of 5 mm
Mesh broken(const Faults& faults)
{
  Mesh mesh = makeBox({ 64.0_mm, 64.0_mm, 20.0_mm }, 5.0_mm);
  std::swap(mesh.triangles[nearest(mesh, kFlipped)][0], mesh.triangles[nearest(mesh, kFlipped)][1]);
  mesh.triangles.push_back(mesh.triangles[nearest(mesh, kDuplicate)]);
  const std::size_t split = nearest(mesh, kSliver);
  const auto [a, b, c] = mesh.triangles[split];
  const int middle = static_cast<int>(mesh.points.size());
  mesh.points.push_back(0.498 * mesh.points[at(a)] + 0.5 * mesh.points[at(b)] +
    0.002 * mesh.points[at(c)]); // as high as a fifth of a percent of the triangle
  mesh.triangles[split] = { a, middle, c };
  mesh.triangles.push_back({ middle, b, c });
  mesh.triangles.push_back({ a, b, middle });
  if (faults.crossing)
  {
    const int first = static_cast<int>(mesh.points.size());
    for (const Place& corner :
      { Place(-1.3, 0.3, 2.0), Place(1.3, 0.3, 2.0), Place(0.1, 0.3, -2.0) })
    {
      mesh.points.emplace_back(1e-3 * (kCrossing + corner));
    }
    mesh.triangles.push_back({ first, first + 1, first + 2 });
  }
  for (const auto& [is, place] : { std::pair(faults.hole, kHole), { faults.below, kBelow } })
  {
    is ? void(mesh.triangles.erase(
           mesh.triangles.begin() + static_cast<std::ptrdiff_t>(nearest(mesh, place))))
       : void();
  }
  return mesh;
}

// an OBJ in a unit, with axes that are turned
void write(const std::filesystem::path& file, const Mesh& mesh,
  const Eigen::Vector3d& scale = Eigen::Vector3d::Constant(1e3), const char* head = "")
{
  std::ofstream out(file);
  out << head;
  for (const Eigen::Vector3d& point : mesh.points)
  {
    out << "v " << point.cwiseProduct(scale).transpose() << '\n';
  }
  for (const auto& [a, b, c] : mesh.triangles)
  {
    out << "f " << a + 1 << ' ' << b + 1 << ' ' << c + 1 << '\n';
  }
}

using Rows = std::vector<std::vector<std::string>>;

// what palp check prints of a file, without comments and column names
Rows rowsOf(const std::string& printed)
{
  Rows rows;
  std::istringstream lines(printed);
  for (std::string line; std::getline(lines, line);)
  {
    line.starts_with('#') ? void() : rows.push_back(csvFields(line));
  }
  rows.erase(rows.begin());
  return rows;
}

class Check : public WindowTest
{
protected:
  [[nodiscard]] std::filesystem::path path(const char* name) const
  {
    return folder_.path() / name;
  }

  [[nodiscard]] static test::Finished command(
    const std::filesystem::path& file, const std::string& options = "--unit mm")
  {
    return test::runCommand(PALP_PROGRAM " check " + file.string() + " " + options);
  }

  bool open(const char* name)
  {
    return window_->openFile(QString::fromStdString(path(name).string()));
  }

  void check()
  {
    window_->findChild<QAction*>("checkAction")->trigger();
    waitForFrames();
  }

  void openBroken(const Faults& faults)
  {
    write(path("block.obj"), broken(faults));
    ASSERT_TRUE(open("block.obj")) << said().toStdString();
    check();
    ASSERT_TRUE(dock()->isVisible()) << said().toStdString();
  }

  [[nodiscard]] QDockWidget* dock() const
  {
    return window_->findChild<QDockWidget*>("Surface check");
  }
  [[nodiscard]] QTableWidget* table() const
  {
    return dock()->findChild<QTableWidget*>("faults");
  }
  [[nodiscard]] std::string verdict() const
  {
    return dock()->findChild<QLabel*>("checkVerdict")->text().toStdString();
  }
  [[nodiscard]] std::string measures() const
  {
    return dock()->findChild<QLabel*>("checkMeasures")->text().toStdString();
  }

  [[nodiscard]] Rows rows() const
  {
    Rows rows;
    for (int row = 0; row < table()->rowCount(); ++row)
    {
      std::vector<std::string>& cells = rows.emplace_back();
      for (int column = 0; column < table()->columnCount(); ++column)
      {
        cells.push_back(table()->item(row, column)->text().toStdString());
      }
    }
    return rows;
  }

  [[nodiscard]] int rowOf(const std::string& fault) const
  {
    const Rows all = rows();
    const auto found = std::ranges::find(all, fault, [](const auto& row) { return row.front(); });
    EXPECT_NE(found, all.end()) << fault;
    return static_cast<int>(found - all.begin());
  }

  [[nodiscard]] Place placeOf(const std::string& fault) const
  {
    Place place;
    char comma = ' ';
    std::istringstream(rows()[static_cast<std::size_t>(rowOf(fault))][2]) >> place.x() >> comma >>
      place.y() >> comma >> place.z();
    return place;
  }

  void lookFromAbove()
  {
    QTest::keyClick(window_.get(), Qt::Key_5, Qt::ControlModifier);
    waitForFrames();
  }

  // pixels of the marks' color within 30 of a place as it is seen, or in all of the picture
  [[nodiscard]] int marks(const std::optional<Place>& near = std::nullopt)
  {
    constexpr double kNear = 30.0;
    waitForFrames();
    const QImage image = canvas_->grabFramebuffer();
    vtkRenderer& renderer = *canvas_->renderWindow()->GetRenderers()->GetFirstRenderer();
    Eigen::Vector3d seen = Eigen::Vector3d::Zero();
    if (near)
    {
      renderer.SetWorldPoint(1e-3 * near->x(), 1e-3 * near->y(), 1e-3 * near->z(), 1.0);
      renderer.WorldToDisplay();
      renderer.GetDisplayPoint(seen.data());
    }
    int count = 0;
    for (int y = 0; y < image.height(); ++y)
    {
      for (int x = 0; x < image.width(); ++x)
      {
        const bool isNear = std::hypot(x - seen.x(), image.height() - 1 - y - seen.y()) < kNear;
        const QColor color = image.pixelColor(x, y);
        const bool isMark = color.red() > 200 && color.blue() > 190 && color.green() < 110;
        count += isMark && (isNear || !near) ? 1 : 0;
      }
    }
    return count;
  }

  // types into the dialog for a repair, and accepts it
  void repair(const std::filesystem::path& file, const char* largestHole)
  {
    QTimer::singleShot(0, window_.get(),
      [this, file, largestHole]
      {
        auto* dialog = window_->findChild<QFileDialog*>("repairDialog");
        ASSERT_NE(dialog, nullptr);
        suggested_ = dialog->selectedFiles().value(0).toStdString();
        type("largestHole", largestHole);
        auto* name = dialog->findChild<QLineEdit*>("fileNameEdit");
        name->setText(QString::fromStdString(file.string()));
        QMetaObject::invokeMethod(dialog, "accept");
      });
    dock()->findChild<QPushButton*>("repairSurface")->click();
  }

  [[nodiscard]] QPushButton* choice(const QString& text) const
  {
    for (auto* button : window_->findChild<MessageBar*>()->findChildren<QPushButton*>())
    {
      if (button->text() == text)
      {
        return button;
      }
    }
    return nullptr;
  }

  std::string suggested_; // name of a repaired file
};

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

TEST_F(Check, RepairsAsTheCommandLineAndOpensThat)
{
  openBroken({});
  for (const char* kind : { ".vtp", ".stl" })
  {
    const std::filesystem::path mine = path("mine").replace_extension(kind);
    const std::filesystem::path other = path("other").replace_extension(kind);
    const test::Finished printed =
      command(path("block.obj"), "--unit mm --close-holes 30mm --repair " + other.string());
    EXPECT_EQ(printed.code, 0) << printed.out << printed.err;
    repair(mine, "30");
    EXPECT_TRUE(suggested_.ends_with("/block_repaired.vtp")) << suggested_;
    ASSERT_TRUE(QTest::qWaitFor([this] { return choice("Open it") != nullptr; }, kPatience))
      << said().toStdString();
    EXPECT_EQ(test::readAll(mine), test::readAll(other));
    const std::string from = "# repaired: ";
    const std::size_t begin = printed.out.find(from) + from.size();
    const std::string done = printed.out.substr(begin, printed.out.find('\n', begin) - begin);
    EXPECT_NE(done.find("1 hole closed"), std::string::npos);
    EXPECT_TRUE(said().contains(QString::fromStdString(done))) << said().toStdString();
    EXPECT_TRUE(said().contains("nothing disturbs a press")) << said().toStdString();
  }
  waitForFrames(); // the answers of before go
  choice("Open it")->click();
  ASSERT_EQ(session_->body().name, "mine.stl") << said().toStdString();
  EXPECT_EQ(session_->body().unit, "mm");
  check();
  EXPECT_EQ(verdict().find("disturbed"), std::string::npos) << verdict();
}

TEST_F(Check, NeverReplacesWhatItChecked)
{
  openBroken({});
  const std::string before = test::readAll(path("block.obj"));
  bool isRefused = false;
  QTimer::singleShot(100, window_.get(),
    [&]
    {
      auto* box = qobject_cast<QDialog*>(QApplication::activeModalWidget());
      isRefused = box != nullptr && box->objectName() != "repairDialog";
      isRefused ? box->accept() : void();
      window_->findChild<QFileDialog*>("repairDialog")->reject();
    });
  repair(path("block.obj"), "0");
  EXPECT_TRUE(isRefused);
  EXPECT_EQ(test::readAll(path("block.obj")), before);
}

TEST_F(Check, ACanceledRepairLeavesNoFile)
{
  write(path("fine.obj"), makeBox({ 64.0_mm, 64.0_mm, 20.0_mm }, 0.4_mm));
  ASSERT_TRUE(open("fine.obj")) << said().toStdString();
  check();
  dock()->findChild<QPushButton*>("repairSurface")->setEnabled(true); // of what has no fault
  QTimer cancel;
  bool isCanceled = false;
  QObject::connect(&cancel, &QTimer::timeout,
    [&]
    {
      if (said().startsWith("Repairing") && choice("Cancel") != nullptr)
      {
        isCanceled = true;
        choice("Cancel")->click();
      }
    });
  cancel.start(5);
  repair(path("fine.vtp"), "0");
  EXPECT_TRUE(isCanceled);
  EXPECT_TRUE(said().contains("canceled")) << said().toStdString();
  window_.reset(); // which waits for what was given up
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_.path()), {}), 1);
}

TEST_F(Check, SaysThatThereIsNoFault)
{
  ASSERT_TRUE(window_->openFile(PALP_SHARE "/meshes/block_50.vtp"));
  check();
  EXPECT_EQ(rows(), Rows{});
  EXPECT_TRUE(verdict().starts_with("No fault")) << verdict();
  EXPECT_EQ(marks(), 0);
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
