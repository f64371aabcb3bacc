#pragma once

#include "data/shapes.h"
#include "haptics/files/csv_text.h"
#include "tests/app/window/window_rig.h"
#include "tests/support/obj_file.h"

#include <QDockWidget>
#include <QFileDialog>
#include <QImage>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QTableWidget>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace palp::test
{

using Place = Eigen::Vector3d; // [mm]

// where the block below has each fault
inline const Place kHole(-20.0, 6.0, 0.0);
inline const Place kDuplicate(0.0, 22.0, 0.0);
inline const Place kFlipped(20.0, -10.0, 0.0);
inline const Place kSliver(22.0, 20.0, 0.0);
inline const Place kBelow(12.0, -10.0, -20.0); // a hole, too, on the other side; as wide
inline const Place kCrossing(-6.0, -22.0, 0.0);

struct Faults
{
  bool hole = true;
  bool below = false;    // in the place of that
  bool crossing = false; // which no repair takes away
};

inline std::size_t nearest(const Mesh& mesh, const Place& place)
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
inline Mesh broken(const Faults& faults)
{
  Mesh mesh = makeBox({ 64e-3, 64e-3, 20e-3 }, 5e-3);
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

inline void write(const std::filesystem::path& file, const Mesh& mesh,
  const Eigen::Vector3d& scale = Eigen::Vector3d::Constant(1e3), const char* head = "")
{
  test::writeObj(file, mesh.points, mesh.triangles, scale, head);
}

using Rows = std::vector<std::vector<std::string>>;

// what palp check prints of a file, without comments and column names
inline Rows rowsOf(const std::string& printed)
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

/// The window, and bodies whose faults stand at known places.
class CheckTest : public WindowTest
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

} // namespace palp::test
