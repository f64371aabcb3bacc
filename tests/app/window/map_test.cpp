#include "app/program/sha256.h"
#include "haptics/files/csv_text.h"
#include "tests/app/window/window_rig.h"

#include <QDialog>
#include <QImage>
#include <QLabel>
#include <QPushButton>
#include <QRadioButton>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>

namespace palp
{
namespace
{

using test::WindowTest;

class MapTest : public WindowTest
{
protected:
  MapTest()
  {
    EXPECT_TRUE(window_->openFile(PALP_SHARE "/meshes/block_50.vtp"));
  }

  [[nodiscard]] QAction* action(const char* name) const
  {
    return window_->findChild<QAction*>(name);
  }

  // fills the dialog in, by the names of its fields
  void ask(const std::vector<std::pair<const char*, const char*>>& fields, bool around = false)
  {
    QTimer::singleShot(0, window_.get(),
      [&]
      {
        auto* dialog = window_->findChild<QDialog*>("mapDialog");
        ASSERT_NE(dialog, nullptr);
        if (around)
        {
          dialog->findChild<QRadioButton*>("mapRegion")->click();
        }
        for (const auto& [name, text] : fields)
        {
          type(name, text);
        }
        dialog->accept();
      });
    action("mapAction")->trigger();
  }

  void waitForMap() const
  {
    EXPECT_TRUE(QTest::qWaitFor([this]
      { return said().startsWith("Stiffness map:") || said().contains("give"); },
      kPatience));
    EXPECT_TRUE(said().startsWith("Stiffness map:")) << said().toStdString();
  }

  // pixels of the picture whose color is like that of the bright end of the map
  [[nodiscard]] int countOf(const std::function<bool(const QColor&)>& isLike)
  {
    const QString file = QString::fromStdString((folder_.path() / "map.png").string());
    EXPECT_TRUE(window_->saveScreenshot(file));
    const QImage image(file);
    int count = 0;
    for (int y = 0; y < image.height(); y += 2)
    {
      for (int x = 0; x < image.width(); x += 2)
      {
        count += isLike(image.pixelColor(x, y)) ? 1 : 0;
      }
    }
    return count;
  }

  [[nodiscard]] static bool isReddish(const QColor& color) // as the tissue
  {
    return color.red() > 2 * color.green() && color.red() > 2 * color.blue() && color.red() > 40;
  }
  [[nodiscard]] static bool isMapped(const QColor& color) // from teal to yellow
  {
    return 10 * color.green() > 8 * color.red() && 10 * color.green() > 12 * color.blue();
  }

  // the numbers of a column, of the rows that have one
  [[nodiscard]] static std::vector<double> column(
    const std::filesystem::path& file, const std::string& name)
  {
    std::ifstream in(file);
    std::vector<std::string> names;
    std::vector<double> numbers;
    for (std::string line; std::getline(in, line);)
    {
      const std::vector<std::string> cells = csvFields(line);
      if (names.empty() && !line.starts_with('#'))
      {
        names = cells;
      }
      else if (!names.empty())
      {
        const auto at = std::ranges::find(names, name) - names.begin();
        numbers.push_back(csvNumber(cells.at(static_cast<std::size_t>(at))).value_or(NAN));
      }
    }
    return numbers;
  }
};

TEST_F(MapTest, ARefusalInItsDialogIsReadWhole)
{
  QTimer::singleShot(0, window_.get(),
    [&]
    {
      auto* dialog = window_->findChild<QDialog*>("mapDialog");
      ASSERT_NE(dialog, nullptr);
      type("mapDepth", "5 kPa");
      type("mapSpacing", "1000 mm");
      int refusals = 0;
      for (const QLabel* label : dialog->findChildren<QLabel*>())
      {
        if (label->isVisible() && label->wordWrap() && label->text().contains("still in use"))
        {
          EXPECT_GE(label->height(), label->heightForWidth(label->width()));
          ++refusals;
        }
      }
      EXPECT_EQ(refusals, 2);
      dialog->reject();
    });
  action("mapAction")->trigger();
}

// the block has one stiffness on its faces, by the paper's law: of the color of the map's end
TEST_F(MapTest, ColorsTheBodyAndGoesAndComes)
{
  const int plain = countOf(isReddish);
  ASSERT_GT(plain, 3000);
  ask({ { "mapDepth", "2" }, { "mapSpacing", "12" } });
  waitForMap();
  EXPECT_LT(countOf(isReddish), plain / 4);
  EXPECT_GT(countOf(isMapped), plain / 2);
  action("mapColors")->trigger();
  waitForRest();
  EXPECT_GT(countOf(isReddish), plain * 9 / 10);
  action("mapColors")->trigger();
  waitForRest();
  EXPECT_GT(countOf(isMapped), plain / 2);
  action("clearMapAction")->trigger();
  waitForRest();
  EXPECT_GT(countOf(isReddish), plain * 9 / 10);
  EXPECT_FALSE(action("mapColors")->isEnabled());
}

TEST_F(MapTest, IsNotLostWithoutAQuestion)
{
  ask({ { "mapDepth", "2" }, { "mapSpacing", "20" } });
  waitForMap();
  const QString other = PALP_SHARE "/meshes/sphere_50.vtp";
  EXPECT_FALSE(window_->openFile(other));
  EXPECT_TRUE(said().startsWith("The stiffness map is not exported yet")) << said().toStdString();
  EXPECT_FALSE(window_->close());
  EXPECT_TRUE(window_->isVisible());
  ASSERT_TRUE(window_->exportData(QString::fromStdString((folder_.path() / "out").string())));
  EXPECT_TRUE(window_->openFile(other));
  ask({ { "mapDepth", "2" }, { "mapSpacing", "20" } });
  waitForMap();
  EXPECT_FALSE(window_->close());
  answer("Quit without it");
  EXPECT_FALSE(window_->isVisible());
}

// Hertz: dF/dd = 2 E/(1 - nu^2) sqrt(R d), of the paper's Eq. (2)
TEST_F(MapTest, IsExportedWithTheFolder)
{
  press(60);
  release();
  EXPECT_TRUE(waitForLift());
  EXPECT_TRUE(
    QTest::qWaitFor([this] { return !session_->presses().presses().empty(); }, kPatience));
  ask({ { "mapDepth", "2" }, { "mapSpacing", "6" }, { "mapRadius", "15" } }, true);
  waitForMap();
  ASSERT_TRUE(window_->exportData(QString::fromStdString((folder_.path() / "out").string())));
  const auto file = folder_.path() / "out/stiffness_map.csv";
  const std::vector<double> stiffness = column(file, "stiffness_N_per_mm");
  const std::vector<double> x = column(file, "x_mm");
  const std::vector<double> y = column(file, "y_mm");
  const std::vector<double> z = column(file, "z_mm");
  ASSERT_GT(stiffness.size(), 8U);
  const double hertz = 2.0 * 50e3 / (1.0 - 0.33 * 0.33) * std::sqrt(10e-3 * 2e-3) * 1e-3;
  const Eigen::Vector3d center =
    session_->presses().presses().back().summary.deepest.center * 1e3; // [mm]
  int flat = 0;
  for (std::size_t i = 0; i < stiffness.size(); ++i)
  {
    const Eigen::Vector3d place(x[i], y[i], z[i]);
    EXPECT_LE((place - center).norm(), 15.0);
    flat += std::abs(stiffness[i] - hertz) < 1e-4 * hertz ? 1 : 0;
  }
  EXPECT_GT(flat, 5);
  const std::string provenance = test::readAll(folder_.path() / "out/provenance.json");
  for (const char* name : { "stiffness_map.csv", "stiffness_map.vtp" })
  {
    const std::string hash = sha256Of(test::readAll(folder_.path() / "out" / name));
    EXPECT_NE(provenance.find(hash), std::string::npos) << name;
  }
  const test::Finished again = test::runCommand(PALP_PROGRAM " run " +
    (folder_.path() / "out").string() + " --out " + (folder_.path() / "again").string());
  EXPECT_EQ(again.code, 0) << again.err;
}

TEST_F(MapTest, OfAnotherToolIsMarkedAndNotExported)
{
  ask({ { "mapDepth", "2" }, { "mapSpacing", "20" } });
  waitForMap();
  type("radius", "5");
  press(60);
  release();
  EXPECT_TRUE(waitForLift());
  ASSERT_TRUE(window_->exportData(QString::fromStdString((folder_.path() / "out").string())));
  EXPECT_TRUE(said().contains("not the stiffness map")) << said().toStdString();
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "out/stiffness_map.csv"));
  EXPECT_TRUE(action("mapColors")->isEnabled()) << "still seen, with a bar that says of before";
  EXPECT_FALSE(window_->openFile(PALP_SHARE "/meshes/sphere_50.vtp"));
  EXPECT_TRUE(said().endsWith("taken back (Ctrl+Z)")) << said().toStdString();
  answer("Clear it");
  EXPECT_FALSE(action("mapColors")->isEnabled());
  EXPECT_TRUE(window_->openFile(PALP_SHARE "/meshes/sphere_50.vtp"));
}

// not the tool of now
TEST_F(MapTest, AFigureTellsWhatTheMapWasPressedBy)
{
  const auto caption = [this]
  {
    const QString file = QString::fromStdString((folder_.path() / "figure.png").string());
    EXPECT_TRUE(window_->saveFigure(file, { 640, 480 }, { .hasCaption = true }));
    const QImage figure(file);
    EXPECT_FALSE(figure.isNull());
    return figure.copy(0, 0, 300, 36);
  };
  ask({ { "mapDepth", "2" }, { "mapSpacing", "20" } });
  waitForMap();
  const QImage before = caption();
  type("radius", "5");
  waitForFrames();
  EXPECT_EQ(caption(), before);
  action("clearMapAction")->trigger();
  waitForFrames();
  EXPECT_NE(caption(), before) << "of the press, without a map";
}

TEST_F(MapTest, OfAToolThatIsChangedMeanwhileSaysHowItIsExported)
{
  ask({ { "mapDepth", "2" }, { "mapSpacing", "3" } });
  type("radius", "5");
  waitForMap();
  EXPECT_TRUE(said().contains("of the tool and the tissue before")) << said().toStdString();
  QTest::keyClick(window_.get(), Qt::Key_Z, Qt::ControlModifier);
  press(60);
  release();
  EXPECT_TRUE(waitForLift());
  ASSERT_TRUE(window_->exportData(QString::fromStdString((folder_.path() / "out").string())));
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "out/stiffness_map.csv"));
}

TEST_F(MapTest, CanBeCancelled)
{
  ask({ { "mapDepth", "2" }, { "mapSpacing", "1.2" } });
  const auto cancel = [this]() -> QPushButton*
  {
    for (auto* button : window_->findChild<MessageBar*>()->findChildren<QPushButton*>())
    {
      if (button->text() == "Cancel")
      {
        return button;
      }
    }
    return nullptr;
  };
  ASSERT_TRUE(QTest::qWaitFor([&] { return cancel() != nullptr; }, kPatience));
  cancel()->click();
  waitFor([](const Sample&) { return true; });
  EXPECT_TRUE(said().isEmpty());
  EXPECT_FALSE(action("mapColors")->isEnabled());
}

} // namespace
} // namespace palp
