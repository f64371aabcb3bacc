#include "app/shell/key_sheet.h"
#include "app/shell/theme.h"
#include "app/shell/window_memory.h"
#include "tests/app/window/window_rig.h"

#include <QDialog>
#include <QDockWidget>
#include <QGuiApplication>
#include <QImage>
#include <QLabel>
#include <QMainWindow>
#include <QMenu>
#include <QMenuBar>
#include <QMimeData>
#include <QPushButton>
#include <QScreen>
#include <QStatusBar>
#include <QToolBar>
#include <QToolButton>
#include <QUrl>

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <variant>

namespace palp
{
namespace
{

using test::WindowTest;

class Manners : public WindowTest
{
protected:
  [[nodiscard]] QDockWidget* dock(const char* name) const
  {
    return window_->findChild<QDockWidget*>(name);
  }
  [[nodiscard]] QStringList recent() const
  {
    auto* menu = window_->findChild<QMenu*>("recentFiles");
    Q_EMIT menu->aboutToShow();
    QStringList names;
    for (const QAction* action : menu->actions())
    {
      names << action->text();
    }
    return names;
  }
  void chooseRecent(int entry) const
  {
    window_->findChild<QMenu*>("recentFiles")->actions().at(entry)->trigger();
  }
  void drop(const QList<QUrl>& urls) const
  {
    QMimeData dragged;
    dragged.setUrls(urls);
    QDragEnterEvent enter({ 400, 300 }, Qt::CopyAction, &dragged, Qt::LeftButton, {});
    QApplication::sendEvent(window_.get(), &enter);
    EXPECT_EQ(enter.isAccepted(), !urls.isEmpty());
    QDropEvent event({ 400, 300 }, Qt::CopyAction, &dragged, Qt::LeftButton, {});
    QApplication::sendEvent(window_.get(), &event);
    QApplication::processEvents(); // it opens what was dropped after that
  }
  void openAnew()
  {
    window_->close();
    window_.reset();
    session_.reset();
    session_ = std::make_unique<Session>(ScenePlan{}, silent_);
    window_ = std::make_unique<Window>(*session_, silent_);
    window_->show();
    EXPECT_TRUE(QTest::qWaitForWindowExposed(window_.get()));
  }

  const QString block_ = PALP_SHARE "/meshes/block_50.vtp";
};

// every key that a menu has, found by walking the menus by another way
TEST_F(Manners, TheKeySheetNamesEveryKeyOfTheMenus)
{
  std::size_t keys = 0;
  for (const QAction* action : window_->findChildren<QAction*>())
  {
    keys += action->shortcut().isEmpty() ? 0 : 1;
  }
  EXPECT_GE(keys, 12U);
  EXPECT_EQ(keysOf(*window_->menuBar()).size(), keys);

  QTest::keyClick(window_.get(), Qt::Key_F1);
  auto* sheet = window_->findChild<QDialog*>("keySheet");
  ASSERT_NE(sheet, nullptr);
  QString text;
  for (const QLabel* label : sheet->findChildren<QLabel*>())
  {
    text += label->text() + '\n';
  }
  for (const char* said : { "Left button, drag down", "Wheel", "Esc", "Ctrl+S", "F1 or H", "Home" })
  {
    EXPECT_TRUE(text.contains(said)) << said;
  }
  EXPECT_LE(sheet->sizeHint().height(), 700) << "on a screen of 768 pixels";
  QTest::keyClick(window_.get(), Qt::Key_H);
  EXPECT_TRUE(QTest::qWaitFor([this] { return !window_->findChild<QDialog*>("keySheet"); }));
}

TEST_F(Manners, PanelsThatWereClosedStayClosedAndTheWindowKeepsItsSize)
{
  const QSize size(1100, 780);
  window_->resize(size);
  EXPECT_FALSE(dock("Diagnostics")->isVisible()) << "at first";
  dock("Diagnostics")->toggleViewAction()->trigger();
  EXPECT_TRUE(dock("Diagnostics")->isVisible());
  dock("Force over depth")->close();
  openAnew();
  EXPECT_TRUE(dock("Diagnostics")->isVisible());
  EXPECT_FALSE(dock("Force over depth")->isVisible());
  EXPECT_TRUE(dock("Force over time")->isVisible());
  EXPECT_EQ(window_->size(), size);

  dock("Force over depth")->toggleViewAction()->trigger();
  EXPECT_TRUE(dock("Force over depth")->isVisible());
}

TEST_F(Manners, TellsThePunctualityOfTheServoOnlyToWhoAsks)
{
  const auto* text = window_->findChild<QLabel*>("timing");
  waitForFrames(3);
  EXPECT_TRUE(text->text().isEmpty());
  dock("Diagnostics")->show();
  EXPECT_TRUE(QTest::qWaitFor([text] { return text->text().contains("late ticks"); }, kPatience));
}

TEST_F(Manners, OpensAgainWhatWasOpenedAndDropsWhatIsGone)
{
  EXPECT_EQ(recent(), QStringList("none so far"));
  const auto copy = folder_.path() / "a & b.vtp";
  std::filesystem::copy_file(block_.toStdString(), copy);
  ASSERT_TRUE(window_->openFile(QString::fromStdString(copy.string())));
  ASSERT_TRUE(window_->openFile(block_));
  EXPECT_EQ(recent(), QStringList({ "block_50.vtp", "a && b.vtp" }));
  chooseRecent(1);
  EXPECT_EQ(session_->body().name, "a & b.vtp");
  EXPECT_EQ(recent(), QStringList({ "a && b.vtp", "block_50.vtp" })) << "the newest first";

  std::filesystem::remove(copy);
  chooseRecent(0);
  EXPECT_TRUE(said().contains("no longer"));
  EXPECT_EQ(session_->body().name, "a & b.vtp") << "is kept";
  EXPECT_EQ(recent(), QStringList("block_50.vtp"));
}

TEST_F(Manners, TakesWhatIsDropped)
{
  drop({});
  drop({ QUrl::fromLocalFile(block_) });
  EXPECT_EQ(session_->body().name, "block_50.vtp");
  EXPECT_TRUE(window_->windowTitle().contains("block_50.vtp"));
  const auto write = [this](const char* name, const char* text)
  {
    const auto file = folder_.path() / name;
    std::ofstream(file) << text;
    return QUrl::fromLocalFile(QString::fromStdString(file.string()));
  };
  drop({ write("tool.csv", "radius_mm,height_mm\n0,0\n2,1\n4,4\n") });
  EXPECT_TRUE(std::holds_alternative<ProfileTip>(session_->recording().scene.law.tip()));
  drop({ write("way.csv", "time_s,x_mm,y_mm,z_mm\n0,0,0,40\n1,0,0,39\n") });
  EXPECT_TRUE(session_->recording().device.starts_with("path:")) << said().toStdString();
  drop({ write("block.json",
    R"({"palp_scene": 1, "meshes": [{"bundled": "block_30"}], "tool": "cone:30deg:8mm",
        "tissue": {"young": "20kPa", "poisson": 0.4}, "law": {"mode": "paper"}, "device": "mouse",
        "dent": {"surface": "paper"}})") });
  EXPECT_EQ(session_->body().name, "block_30.vtp") << said().toStdString();
  EXPECT_TRUE(std::holds_alternative<ConeTip>(session_->recording().scene.law.tip()));
  EXPECT_NEAR(session_->recording().scene.law.material().youngModulus, 20e3, 1e-6);
  drop({ write("nothing.json", "{") });
  EXPECT_TRUE(said().contains("nothing.json"));
  drop({ QUrl::fromLocalFile(PALP_SHARE "/meshes/sphere_30.vtp"), QUrl::fromLocalFile(block_) });
  EXPECT_EQ(session_->body().name, "sphere_30.vtp + block_50.vtp");
  EXPECT_TRUE(said().contains("one body")) << "says so";
}

// first start: a hint, which goes by itself and comes once
TEST_F(Manners, GreetsOnce)
{
  window_->greet();
  EXPECT_TRUE(said().contains("Drag down"));
  auto* bar = window_->findChild<MessageBar*>();
  auto* end = bar->findChild<QTimer*>();
  EXPECT_TRUE(end->isActive() && end->isSingleShot());
  end->start(1); // as if it were over
  EXPECT_TRUE(QTest::qWaitFor([bar] { return !bar->isVisible(); }, kPatience));
  window_->greet();
  EXPECT_TRUE(said().isEmpty());
}

TEST_F(Manners, TheBarOfToolsDoesWhatTheMenusDo)
{
  auto* bar = window_->findChild<QToolBar*>("toolBar");
  ASSERT_EQ(bar->actions().size(), 5);
  for (QAction* action : bar->actions())
  {
    EXPECT_FALSE(action->icon().isNull());
    EXPECT_FALSE(action->toolTip().isEmpty());
    bool isInMenu = false;
    for (const QWidget* widget : action->associatedWidgets())
    {
      isInMenu = isInMenu || qobject_cast<const QMenu*>(widget) != nullptr;
    }
    EXPECT_TRUE(isInMenu) << action->text().toStdString();
  }
  bar->actions().back()->trigger();
  EXPECT_TRUE(
    QTest::qWaitFor([this] { return dock("Section and comparison")->isVisible(); }, kPatience));
  dock("Section and comparison")->close();
  EXPECT_FALSE(bar->actions().back()->isChecked());
}

// where nothing plays it says so, and does not pretend
TEST_F(Manners, TheForceIsHeardOrItSaysWhyNot)
{
  auto* sound = window_->findChild<QAction*>("sound");
  sound->trigger();
  EXPECT_TRUE(said().contains(sound->isChecked() ? "octave" : "No sound output"))
    << said().toStdString();
  if (sound->isChecked())
  {
    sound->trigger();
    EXPECT_FALSE(sound->isChecked());
    EXPECT_TRUE(said().contains("not heard"));
  }
}

// the corner of a picture, as it is on the screen
TEST_F(Manners, ADarkThemeIsDarkEverywhereAndIsRemembered)
{
  const auto lightness = [](QWidget* widget, QPoint at)
  { return widget->grab().toImage().pixelColor(at).lightness(); };
  auto* chart = window_->findChild<QVTKOpenGLNativeWidget*>("timeChart");
  const auto choose = [this](const char* theme)
  {
    window_->findChild<QAction*>(theme)->trigger();
    waitFor([](const Sample&) { return true; });
  };
  choose("lightTheme");
  const auto isAll = [&](const std::function<bool(int)>& is)
  {
    return is(lightness(canvas_, { 5, canvas_->height() / 2 })) &&
      is(lightness(chart, { 2, chart->height() - 3 })) &&
      is(lightness(chart, { chart->width() / 2, chart->height() / 2 })) &&
      is(lightness(window_->statusBar(), { 3, 3 }));
  };
  const auto isLight = [](int value) { return value > 150; };
  const auto isDim = [](int value) { return value < 100; };
  EXPECT_TRUE(QTest::qWaitFor([&] { return isAll(isLight); }, kPatience));
  choose("darkTheme");
  EXPECT_TRUE(QTest::qWaitFor([&] { return isAll(isDim); }, kPatience));
  EXPECT_EQ(rememberedTheme(), Theme::Dark);
  auto* stop = window_->findChild<QPushButton*>("stop");
  ASSERT_FALSE(stop->isEnabled());
  EXPECT_TRUE(isDim(lightness(stop, { 3, stop->height() / 3 })));

  const QString file = QString::fromStdString((folder_.path() / "curves.png").string());
  ASSERT_TRUE(window_->saveCurves(file));
  EXPECT_TRUE(isLight(QImage(file).pixelColor(3, 3).lightness())) << "to print";
  choose("systemTheme");
  EXPECT_TRUE(QTest::qWaitFor([&] { return isAll(isLight); }, kPatience));
}

TEST_F(WindowTest, AMessageIsReadWholeAndTakesNothingAway)
{
  const QSize canvas = canvas_->size();
  const QString far = "/nowhere/" + QString("a long way off/").repeated(30) + "shot.png";
  EXPECT_FALSE(window_->saveScreenshot(far)); // and goes on without a box that waits
  EXPECT_TRUE(said().contains("shot.png") && said().contains("No such file"));
  auto* bar = window_->findChild<MessageBar*>();
  const auto* text = bar->findChild<QLabel*>("message");
  const auto isWhole = [&]
  {
    return bar->width() == canvas_->width() && canvas_->rect().contains(bar->geometry()) &&
      text->height() >= text->heightForWidth(text->width());
  };
  EXPECT_TRUE(QTest::qWaitFor(isWhole, kPatience));
  EXPECT_GT(text->height(), 2 * text->fontMetrics().height());
  EXPECT_EQ(canvas_->size(), canvas);
  EXPECT_TRUE(window_->findChild<QLabel*>("force")->isVisible());
  window_->resize(window_->size() - QSize(150, 0));
  EXPECT_TRUE(QTest::qWaitFor(isWhole, kPatience));
  bar->findChild<QToolButton*>("closeMessage")->click();
  EXPECT_TRUE(said().isEmpty());
}

TEST(WindowMemory, AWindowIsNoLargerThanTheScreen)
{
  test::application();
  QMainWindow large;
  large.resize(QGuiApplication::primaryScreen()->size() + QSize(400, 300));
  WindowMemory().save(large);
  QMainWindow next;
  WindowMemory().restore(next);
  const QRect room = QGuiApplication::primaryScreen()->availableGeometry();
  EXPECT_TRUE(room.contains(next.geometry()));
  EXPECT_GT(next.width(), room.width() * 9 / 10);
  large.resize(700, 500);
  WindowMemory().save(large);
  WindowMemory().restore(next);
  EXPECT_EQ(next.size(), QSize(700, 500));
  QSettings(QSettings::IniFormat, QSettings::UserScope, "palp", "window").clear(); // of other tests
}

} // namespace
} // namespace palp
