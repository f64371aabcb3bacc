// Pictures of the window's main states, to be looked at: no test.
// window_sheet FOLDER WIDTHxHEIGHT...: of screens of these sizes, light and dark; each becomes
// FOLDER/STATE_SIZE_THEME.png. A scale of 2 is asked for by QT_SCALE_FACTOR, with half the size.
#include "app/panels/open_dialog.h"
#include "app/shell/theme.h"
#include "tests/app/panels/label_map.h"
#include "tests/app/window/window_rig.h"

#include <QComboBox>
#include <QDockWidget>
#include <QLineEdit>
#include <QMenu>
#include <QMenuBar>
#include <QPainter>
#include <QPushButton>
#include <QToolButton>
#include <QWheelEvent>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>

namespace palp
{
namespace
{

QString folder;
std::vector<QSize> screens;

class Sheet : public test::WindowTest
{
protected:
  using WindowTest::WindowTest;

  // the window with a dialog or a menu over it
  void save(const char* state, QSize screen, QWidget* over) const
  {
    for (const Theme theme : { Theme::Light, Theme::Dark })
    {
      setTheme(theme);
      QTest::qWait(700);
      QPixmap picture = window_->grab();
      if (over != nullptr)
      {
        const QPoint at = over->mapToGlobal(QPoint()) - window_->mapToGlobal(QPoint());
        QPainter(&picture).drawPixmap(at, over->grab());
      }
      const QString name = QString("%1/%2_%3x%4_%5.png")
                             .arg(folder, state)
                             .arg(screen.width())
                             .arg(screen.height())
                             .arg(theme == Theme::Dark ? "dark" : "light");
      EXPECT_TRUE(picture.save(name));
      std::printf("%s\n", name.toStdString().c_str());
    }
    setTheme(Theme::Light);
  }

  // at each size: come to the state, look, go
  void show(
    const char* state, const std::function<void()>& enter,
    const std::function<void()>& leave = [] {})
  {
    for (const QSize screen : screens)
    {
      window_->resize(screen - QSize(16, 48));
      QTest::qWait(300);
      enter();
      save(state, screen, nullptr);
      leave();
    }
  }

  // of the window, or that holds it up
  void showDialog(const char* state, const std::function<void()>& open, const QWidget* of = nullptr)
  {
    for (const QSize screen : screens)
    {
      window_->resize(screen - QSize(16, 48));
      QTest::qWait(300);
      QTimer look;
      QObject::connect(&look, &QTimer::timeout,
        [&]
        {
          auto* dialog = of != nullptr ? of->findChild<QDialog*>()
                                       : qobject_cast<QDialog*>(QApplication::activeModalWidget());
          if (dialog != nullptr)
          {
            look.stop();
            save(state, screen, dialog);
            dialog->reject();
          }
        });
      look.start(500);
      open();
      EXPECT_TRUE(QTest::qWaitFor([&] { return !look.isActive(); }, kPatience));
    }
  }

  void showMenu(const char* state, const QString& name)
  {
    for (const QSize screen : screens)
    {
      window_->resize(screen - QSize(16, 48));
      QTest::qWait(300);
      for (QAction* action : window_->menuBar()->actions())
      {
        if (action->text().remove('&') == name)
        {
          const QPoint below = window_->menuBar()->actionGeometry(action).bottomLeft();
          action->menu()->popup(window_->menuBar()->mapToGlobal(below));
          save(state, screen, action->menu());
          action->menu()->close();
        }
      }
    }
  }

  void pressAt(const char* place, int presses) const
  {
    auto* field = window_->findChild<QLineEdit*>("pressPlace");
    field->setText(place);
    QTest::keyClick(field, Qt::Key_Return);
    EXPECT_TRUE(QTest::qWaitFor(
      [&] { return session_->presses().presses().size() == std::size_t(presses); }, kPatience));
  }

  void trigger(const char* action) const
  {
    window_->findChild<QAction*>(action)->trigger();
  }

  void bringUp(const char* title) const
  {
    window_->findChild<QDockWidget*>(title)->raise();
  }

  void wheel(int notches) const
  {
    const QPoint middle = canvas_->rect().center();
    for (int i = 0; i < notches; ++i)
    {
      QWheelEvent notch(middle, canvas_->mapToGlobal(middle), {}, QPoint(0, -120), Qt::NoButton,
        Qt::NoModifier, Qt::NoScrollPhase, false);
      QApplication::sendEvent(canvas_, &notch);
    }
  }
};

// at 1440x860, light: data/window.png
TEST_F(Sheet, Readme)
{
  pressAt("-34.54, -17.88, 70.18, 3 mm", 1);
  bringUp("Force over time");
  show(
    "0_readme",
    [&]
    {
      window_->findChild<MessageBar*>()->tell({});
      press(110);
    },
    [&]
    {
      release();
      EXPECT_TRUE(waitForLift());
    });
}

TEST_F(Sheet, Pressing)
{
  show("1_start", [&] { window_->findChild<MessageBar*>()->tell({}); });
  show("2_greeting", [&] { window_->greet(); });
  show(
    "3_pressing", [&] { press(90); },
    [&]
    {
      release();
      EXPECT_TRUE(waitForLift());
    });
  show(
    "4_held_slide",
    [&]
    {
      const QPoint middle = canvas_->rect().center();
      QTest::mouseMove(canvas_, middle);
      waitFor([](const Sample&) { return true; });
      wheel(8);
      for (int i = 0; i < 40; ++i)
      {
        QTest::mouseMove(canvas_, middle + QPoint(i, i / 4));
        QTest::qWait(10);
      }
      waitForRest();
    },
    [&]
    {
      QTest::keyClick(canvas_, Qt::Key_Escape);
      EXPECT_TRUE(waitForLift());
    });
}

TEST_F(Sheet, PressesAndPlots)
{
  EXPECT_TRUE(window_->openFile(PALP_SHARE "/meshes/sphere_50.vtp"));
  pressAt("0, 0, 50, 5 mm", 1);
  pressAt("20, -30, 34.6, 4 mm", 2);
  pressAt("-20, -30, 34.6, 6 mm", 3);
  show("5_presses", [&] { bringUp("Presses"); });
  show("6_plots",
    [&]
    {
      (void)showPlots();
      bringUp("Section and comparison");
    });
}

TEST_F(Sheet, Map)
{
  EXPECT_TRUE(window_->openFile(PALP_SHARE "/meshes/sphere_50.vtp"));
  QTimer::singleShot(
    500, [] { qobject_cast<QDialog*>(QApplication::activeModalWidget())->accept(); });
  trigger("mapAction");
  EXPECT_TRUE(QTest::qWaitFor([&] { return said().startsWith("Stiffness map:"); }, 4 * kPatience));
  show("7_map", [] {});
}

TEST_F(Sheet, Training)
{
  trigger("trainingAction");
  show("8_training_before", [] {});
  for (auto* button : window_->findChildren<QPushButton*>())
  {
    button->text().remove('&') == "Start" ? button->click() : void();
  }
  show(
    "9_training", [&] { press(70); }, [&] { release(); });
}

TEST_F(Sheet, Messages)
{
  show("10_error",
    [&]
    {
      EXPECT_FALSE(window_->openFiles({ "/tmp/no_such_folder/with a long name/liver.json" }) &&
        said().isEmpty());
      window_->findChild<QLineEdit*>("pressPlace")->setText("900, 0, 0");
      QTest::keyClick(window_->findChild<QLineEdit*>("pressPlace"), Qt::Key_Return);
    });
  const std::string odd = folder_.path() / "odd.obj"; // of no organ's size
  std::ofstream(odd) << "v 0 0 0\nv 9e9 0 0\nv 0 9e9 0\nf 1 2 3\n";
  showDialog("11_open", [&] { window_->openFile(odd.c_str()); });
  showDialog("12_figure", [&] { trigger("figureAction"); });
  showDialog("13_export", [&] { trigger("exportAction"); });
  showDialog("14_map_dialog", [&] { trigger("mapAction"); });
}

TEST_F(Sheet, Menus)
{
  showMenu("16_file_menu", "File");
  showMenu("17_device_menu", "Device");
  showMenu("18_view_menu", "View");
  trigger("sound");
  show("19_no_sound", [] {});
}

TEST_F(Sheet, Newer)
{
  const auto list = [this](const char* name) { return window_->findChild<QComboBox*>(name); };
  const std::string image = test::writeLabelMap(folder_.path() / "labels.mha");
  showDialog("20_open_image", [&] { window_->openFile(image.c_str()); });
  showDialog("21_axes", [&] { window_->findChild<QToolButton*>("axes")->click(); });
  const auto showKeys = [&] { trigger("keysAction"); };
  showDialog("22_keys", showKeys, window_.get());
  window_->findChild<QDockWidget*>("Diagnostics")->toggleViewAction()->trigger();
  list("kind")->setCurrentIndex(4);
  list("law")->setCurrentIndex(2);
  type("young", "50 MN");
  show("23_refused", [&] { window_->findChild<MessageBar*>()->tell({}); });
  type("young", "50 kPa");
  pressAt("-34.54, -17.88, 70.18, 3 mm", 1);
  trigger("reviewAction");
  show("24_review", [] {});
  QTest::keyClick(window_.get(), Qt::Key_Escape);
  list("device")->setCurrentText("hand");
  auto* bar = window_->findChild<MessageBar*>();
  show("25_hand", [=] { bar->ask("Not exported yet: 2 presses", { { "Restore", {} } }); });
}

TEST_F(Sheet, Supports)
{
  trigger("supportsAction");
  window_->findChild<QPushButton*>("paintSupports")->setChecked(true);
  show("26_supports",
    [&]
    {
      QTest::mousePress(canvas_, Qt::LeftButton);
      QTest::mouseMove(canvas_, canvas_->rect().center() + QPoint(30, 20));
      QTest::mouseRelease(canvas_, Qt::LeftButton);
    });
}

ScenePlan severalOrgans()
{
  setenv("PALP_DATA", PALP_SHARE, 1);
  ScenePlan plan;
  plan.meshes = { { .bundled = "liver" },
    { .bundled = "sphere_30", .origin = Eigen::Vector3d(0.02, -0.07, 0.03) },
    { .bundled = "sphere_50", .origin = Eigen::Vector3d(0.12, 0.02, 0.06) } };
  plan.organs = { { .name = "liver" },
    { .name = "gallbladder", .role = OrganRole::Through, .color = { 90, 160, 60 } },
    { .name = "kidney", .color = { 170, 90, 70 } } };
  return plan;
}

struct OrganSheet : public Sheet
{
  OrganSheet()
    : Sheet(severalOrgans())
  {
  }
};

TEST_F(OrganSheet, Organs)
{
  show(
    "15_organs", [&] { press(60); }, [&] { release(); });
}

} // namespace
} // namespace palp

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  if (argc < 3)
  {
    std::fprintf(stderr, "window_sheet FOLDER WIDTHxHEIGHT...\n");
    return 2;
  }
  palp::folder = argv[1];
  std::filesystem::create_directories(argv[1]);
  for (int i = 2; i < argc; ++i)
  {
    const QStringList sides = QString(argv[i]).split('x');
    palp::screens.emplace_back(sides.value(0).toInt(), sides.value(1).toInt());
  }
  return RUN_ALL_TESTS();
}
