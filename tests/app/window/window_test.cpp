#include "app/window/window.h"

#include "app/session/device_words.h"
#include "app/program/ledger.h"
#include "app/panels/plot_panel.h"
#include "app/panels/tool_panel.h"
#include "haptics/contact/indentation_of.h"
#include "haptics/error.h"
#include "tests/app/application.h"
#include "tests/support/csv_table.h"
#include "tests/support/process.h"

#include <QAction>
#include <QComboBox>
#include <QDialog>
#include <QImage>
#include <QLabel>
#include <QLineEdit>
#include <QMessageBox>
#include <QPushButton>
#include <QRegularExpression>
#include <QScreen>
#include <QStatusBar>
#include <QTabBar>
#include <QTest>
#include <QTimer>
#include <QVTKOpenGLNativeWidget.h>
#include <QWheelEvent>
#include <vtkActor2DCollection.h>
#include <vtkCallbackCommand.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkNew.h>
#include <vtkRenderer.h>
#include <vtkRendererCollection.h>
#include <vtkTextActor.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <gtest/gtest.h>
#include <set>

namespace palp
{
namespace
{

bool has(const Sample& sample, Flag flag)
{
  return (sample.flags & static_cast<std::uint32_t>(flag)) != 0;
}

class WindowTest : public ::testing::Test
{
protected:
  WindowTest()
  {
    setenv("PALP_DATA", PALP_SHARE, 1);
    test::application();
    session_ = std::make_unique<Session>(ScenePlan{}, silent_);
    window_ = std::make_unique<Window>(*session_, silent_);
    window_->show();
    EXPECT_TRUE(QTest::qWaitForWindowExposed(window_.get()));
    QApplication::setActiveWindow(window_.get()); // no window manager does it here
    canvas_ = window_->findChild<QVTKOpenGLNativeWidget*>("canvas");
    EXPECT_TRUE(canvas_->isValid()) << "no OpenGL context";
    QTest::qWait(500);
  }

  // the pointer goes down in the middle of the liver and drags, until the tool rests
  void press(int pixelsDown)
  {
    const QPoint middle = canvas_->rect().center();
    QTest::mouseMove(canvas_, middle);
    QTest::qWait(100);
    QTest::mousePress(canvas_, Qt::LeftButton, {}, middle);
    QTest::mouseMove(canvas_, middle + QPoint(0, pixelsDown));
    const double told = session_->newest().time;
    const auto rests = [this, told] // and not since before the drag
    {
      const Sample sample = session_->newest();
      return sample.contact.touching() && sample.pose.velocity.norm() < 1e-5 &&
        sample.time > told + 0.1;
    };
    EXPECT_TRUE(QTest::qWaitFor(rests, kPatience));
  }

  void release()
  {
    QTest::mouseRelease(canvas_, Qt::LeftButton);
  }

  // by the simulated hand, which a machine under load deprives of its force until it is asked for
  // again, and felt whole once the tool has lifted
  void pressWithForce(int pixelsDown)
  {
    press(pixelsDown);
    for (int again = 0; again < kAttempts && !isFelt(session_->newest()); ++again)
    {
      release();
      EXPECT_TRUE(
        QTest::qWaitFor([this] { return !session_->newest().contact.touching(); }, kPatience));
      session_->arm(false);
      const double now = session_->newest().time;
      EXPECT_TRUE(
        QTest::qWaitFor([this, now] { return session_->newest().time > now + 0.05; }, kPatience));
      session_->arm(true);
      press(pixelsDown);
    }
  }

  [[nodiscard]] static bool isFelt(const Sample& sample)
  {
    return sample.state == DeviceState::Active && !has(sample, Flag::Reseated);
  }

  // of the message that work ends in, which is closed
  [[nodiscard]] static QString whatIsSaidOf(const std::function<void()>& work)
  {
    QString said;
    QTimer closer;
    QObject::connect(&closer, &QTimer::timeout,
      [&]
      {
        if (auto* message = qobject_cast<QMessageBox*>(QApplication::activeModalWidget()))
        {
          said = message->text();
          message->accept();
        }
      });
    closer.start(100);
    work();
    return said;
  }

  void type(const char* name, const char* text) const
  {
    auto* box = window_->findChild<QAbstractSpinBox*>(name);
    box->selectAll();
    QTest::keyClicks(box, text);
    QTest::keyClick(box, Qt::Key_Return);
  }

  // how often anything is drawn within some time
  [[nodiscard]] int picturesIn(int milliseconds) const
  {
    int drawn = 0;
    std::vector<std::pair<vtkRenderWindow*, unsigned long>> watched;
    for (auto* canvas : window_->findChildren<QVTKOpenGLNativeWidget*>())
    {
      vtkNew<vtkCallbackCommand> count;
      count->SetClientData(&drawn);
      count->SetCallback(
        [](vtkObject*, unsigned long, void* data, void*) { ++*static_cast<int*>(data); });
      watched.emplace_back(
        canvas->renderWindow(), canvas->renderWindow()->AddObserver(vtkCommand::EndEvent, count));
    }
    QTest::qWait(milliseconds);
    for (const auto& [window, observer] : watched)
    {
      window->RemoveObserver(observer);
    }
    return drawn;
  }

  // what the lines of text in the scene say
  [[nodiscard]] QString readings() const
  {
    QString text;
    vtkRenderer* renderer = canvas_->renderWindow()->GetRenderers()->GetFirstRenderer();
    vtkActor2DCollection* actors = renderer->GetActors2D();
    actors->InitTraversal();
    while (vtkActor2D* actor = actors->GetNextActor2D())
    {
      const auto* line = vtkTextActor::SafeDownCast(actor);
      if (line != nullptr && actor->GetVisibility() != 0)
      {
        text += QString(const_cast<vtkTextActor*>(line)->GetInput()) + '\n';
      }
    }
    return text;
  }

  // the largest force that any sample so far has
  [[nodiscard]] double peakForce()
  {
    double peak = 0.0;
    for (const Sample& sample : session_->recording().samples)
    {
      peak = std::max(peak, sample.response.force);
    }
    return peak;
  }

  static constexpr int kPatience = 10'000; // [ms], for a machine that does much else
  static constexpr int kAttempts = 10;

  test::TemporaryFolder folder_;
  Ledger silent_{ false };
  std::unique_ptr<Session> session_;
  std::unique_ptr<Window> window_;
  QVTKOpenGLNativeWidget* canvas_ = nullptr;
};

TEST_F(WindowTest, PressesAsDeepAsTheDrag)
{
  press(100);
  const Contact contact = session_->newest().contact;
  EXPECT_NEAR(contact.depth, 6e-3, 0.02e-3); // a button's millimetre, 0.05 mm a pixel
  EXPECT_NEAR(session_->newest().response.force,
    session_->recording().scene.law({ .depth = contact.depth }).force, 1e-9);
  const QString status = window_->findChild<QLabel*>("force")->text();
  EXPECT_TRUE(status.contains("N") && status.contains("mm")) << status.toStdString();
  release();
  EXPECT_TRUE(
    QTest::qWaitFor([this] { return !session_->newest().contact.touching(); }, kPatience));
}

// by the wheel, and by whatever takes the pointer away
TEST_F(WindowTest, LetsGoOfAHeldPress)
{
  const QPoint middle = canvas_->rect().center();
  const auto hold = [&]
  {
    QTest::mouseMove(canvas_, middle + QPoint(1, 0));
    QTest::mouseMove(canvas_, middle);
    for (int i = 0; i < 4; ++i)
    {
      QWheelEvent notch(middle, canvas_->mapToGlobal(middle), {}, QPoint(0, -120), Qt::NoButton,
        Qt::NoModifier, Qt::NoScrollPhase, false);
      QApplication::sendEvent(canvas_, &notch);
    }
    EXPECT_TRUE(QTest::qWaitFor(
      [this] { return std::abs(session_->newest().contact.depth - 2e-3) < 0.02e-3; }, kPatience));
  };
  const auto lets = [this]
  { return QTest::qWaitFor([this] { return !session_->newest().contact.touching(); }, kPatience); };
  hold();
  QTest::keyClick(window_.get(), Qt::Key_Escape);
  EXPECT_TRUE(lets()) << "Escape";
  hold();
  QTest::mouseMove(canvas_, QPoint(3, 3)); // beside the liver
  EXPECT_TRUE(lets()) << "left the surface";
  hold();
  QEvent leave(QEvent::Leave);
  QApplication::sendEvent(canvas_, &leave);
  EXPECT_TRUE(lets()) << "left the view";
  hold();
  QWidget other;
  other.show();
  QApplication::setActiveWindow(&other);
  EXPECT_TRUE(lets()) << "lost the focus";
}

// held at 4 mm, the pointer jumps over the liver; the depth is what was asked for
TEST_F(WindowTest, AHeldPressThatMovesIsNoDeeper)
{
  const QPoint middle = canvas_->rect().center();
  QTest::mouseMove(canvas_, middle);
  for (int i = 0; i < 8; ++i)
  {
    QWheelEvent notch(middle, canvas_->mapToGlobal(middle), {}, QPoint(0, -120), Qt::NoButton,
      Qt::NoModifier, Qt::NoScrollPhase, false);
    QApplication::sendEvent(canvas_, &notch);
  }
  for (const QPoint place : { QPoint(-80, 0), QPoint(80, -20), QPoint(-40, -30), QPoint(60, 10) })
  {
    QTest::qWait(300);
    QTest::mouseMove(canvas_, middle + place);
  }
  QTest::qWait(300);
  ASSERT_NE(session_->recording().deepest(), nullptr);
  EXPECT_NEAR(session_->recording().deepest()->contact.depth, 4e-3, 0.1e-3);
}

TEST_F(WindowTest, HoveringNeverTouches)
{
  for (const QPoint place : { QPoint(-150, 0), QPoint(120, -30), QPoint(0, 60), QPoint(-60, -60) })
  {
    QTest::mouseMove(canvas_, canvas_->rect().center() + place);
    QTest::qWait(150);
  }
  EXPECT_EQ(peakForce(), 0.0);
}

// the straight way to another place would lead through the liver
TEST_F(WindowTest, GoesToAnotherPlaceOverTheSurface)
{
  press(60);
  const QPoint middle = canvas_->rect().center();
  for (const QPoint place : { QPoint(-150, 0), QPoint(120, -30), QPoint(-60, -60) })
  {
    release();
    QTest::mouseMove(canvas_, middle + place);
    QTest::mousePress(canvas_, Qt::LeftButton, {}, middle + place);
    QTest::mouseMove(canvas_, middle + place + QPoint(0, 60));
    const auto there = [this]
    {
      const Sample sample = session_->newest();
      return sample.contact.touching() && sample.pose.velocity.norm() < 1e-5;
    };
    QTest::qWait(100);
    EXPECT_TRUE(QTest::qWaitFor(there, kPatience));
  }
  release();
  ASSERT_NE(session_->recording().deepest(), nullptr);
  EXPECT_LT(session_->recording().deepest()->contact.depth, 4e-3 + 0.1e-3);
}

TEST_F(WindowTest, AStifferTissuePushesBackHarder)
{
  press(100);
  const double soft = session_->newest().response.force;
  type("young", "100");
  EXPECT_TRUE(QTest::qWaitFor([&]
    { return std::abs(session_->newest().response.force - 2.0 * soft) < 0.01 * soft; },
    kPatience));
  release();
}

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
    return std::abs(sample.response.force - law(indentationOf(sample.contact)).force) < 1e-9;
  };
  EXPECT_TRUE(QTest::qWaitFor(answers, kPatience));
  const Sample sample = session_->newest();
  EXPECT_GT(std::abs(sample.response.force - paper(indentationOf(sample.contact)).force), 0.02);
  release();
}

TEST_F(WindowTest, ARefusedProfileLeavesEverythingAsItWas)
{
  const std::string file = (folder_.path() / "falling.csv").string();
  std::ofstream(file) << "radius_mm,height_mm\n0,0\n1,2\n2,1\n";
  const QString said =
    whatIsSaidOf([&] { window_->findChild<ToolPanel*>()->askForProfile(file.c_str()); });
  EXPECT_TRUE(said.contains("falling.csv") && said.contains("the height falls"))
    << said.toStdString();
  EXPECT_TRUE(std::holds_alternative<SphereTip>(session_->recording().scene.law.tip()));
  EXPECT_EQ(window_->findChild<QComboBox*>("kind")->currentText(), "Sphere");
}

// R_d of a cone is known for one thickness only
TEST_F(WindowTest, AToolWithoutAnExtentLeavesEverythingAsItWas)
{
  ScenePlan plan;
  plan.press.layer = "40mm";
  window_.reset();
  session_ = std::make_unique<Session>(plan, silent_);
  window_ = std::make_unique<Window>(*session_, silent_);
  auto* kind = window_->findChild<QComboBox*>("kind");
  const QString said = whatIsSaidOf([&] { kind->setCurrentText("Cone"); });
  EXPECT_TRUE(said.contains("for a cone")) << said.toStdString();
  EXPECT_TRUE(std::holds_alternative<SphereTip>(session_->recording().scene.law.tip()));
  EXPECT_EQ(kind->currentText(), "Sphere");
}

TEST_F(WindowTest, WhatFailsLeavesEverythingAsItWas)
{
  const std::string file = (folder_.path() / "path.csv").string();
  std::ofstream(file) << "time_s,x_mm,y_mm,z_mm\n0,0,0,200\n1,0,0,200\n";
  session_->useDevice("path:" + file);
  const std::string body = session_->body().name;
  std::filesystem::remove(file);
  EXPECT_THROW(session_->open({ .file = PALP_SHARE "/meshes/sphere_50.vtp" }), Error);
  EXPECT_EQ(session_->body().name, body);
  EXPECT_EQ(session_->recording().mesh, body);
  EXPECT_EQ(session_->recording().device, "path:" + file);
}

TEST_F(WindowTest, EscapeStopsNoMouse)
{
  QTest::keyClick(window_.get(), Qt::Key_Escape);
  press(100);
  EXPECT_GT(session_->newest().force.norm(), 1.0);
  EXPECT_TRUE(window_->findChild<QLabel*>("force")->text().startsWith("Force"));
  release();
  const auto isHint = [this]
  { return window_->findChild<QLabel*>("force")->text().startsWith("Drag down"); };
  EXPECT_TRUE(QTest::qWaitFor(isHint, kPatience));
}

TEST_F(WindowTest, TheSimulatedHandYieldsToTheForceUntilItIsStopped)
{
  window_->findChild<QComboBox*>("device")->setCurrentText("hand");
  pressWithForce(300);
  const Sample felt = session_->newest();
  EXPECT_GT(felt.contact.depth, 0.5e-3);
  EXPECT_LT(felt.contact.depth, 14e-3) << describeFlags(felt.flags); // asked for 16 mm
  EXPECT_GT(felt.force.norm(), 0.1) << describe(felt.state) << ": " << describeFlags(felt.flags);

  QTest::keyClick(window_.get(), Qt::Key_Escape);
  EXPECT_TRUE(
    QTest::qWaitFor([this] { return session_->newest().force.norm() == 0.0; }, kPatience));
  EXPECT_FALSE(session_->armed());
  release();
}

TEST_F(WindowTest, ShowsThatTheHandFeelsLessThanTheLawAsksForAndWhy)
{
  window_->findChild<QComboBox*>("device")->setCurrentText("hand");
  type("young", "1GPa");
  const auto* limits = window_->findChild<QLabel*>("limits");
  bool told = false;
  pressWithForce(100);
  EXPECT_TRUE(QTest::qWaitFor(
    [&] { return told = told || limits->text().contains("stiffness limited"); }, kPatience))
    << limits->text().toStdString();
  const QString force = window_->findChild<QLabel*>("rendered")->text();
  EXPECT_TRUE(force.contains("model") && force.contains("sent")) << force.toStdString();
  release();
}

// an arm that a test plugs in and out, kept beyond the life of the session
struct MadeUpArm
{
  std::atomic<bool> plugged = true;
  std::atomic<bool> homed = false;
  std::atomic<double> depth = -5e-3; // that it goes to [m]
  std::atomic<double> force = 0.0;   // last told [N]
  Eigen::Vector3d top;               // of the body [m]
};

class MadeUpDevice final : public Device
{
public:
  explicit MadeUpDevice(MadeUpArm& arm)
    : arm_(arm)
  {
  }
  [[nodiscard]] DeviceLimits limits() const override
  {
    return {
      .model = "made up", .rendersForce = true, .needsHoming = true, .maxForce = 3.0, .damping = 1.0
    };
  }
  [[nodiscard]] std::optional<ToolPose> exchange(
    const Eigen::Vector3d& force, double) noexcept override
  {
    arm_.force = force.norm();
    depth_ += std::clamp(arm_.depth - depth_, -1e-4, 1e-4);
    const ToolPose pose{ .apex = arm_.top - depth_ * Eigen::Vector3d::UnitZ() };
    return arm_.plugged ? std::optional(pose) : std::nullopt;
  }
  [[nodiscard]] DeviceStatus status() const noexcept override
  {
    return { .homed = arm_.homed };
  }

private:
  MadeUpArm& arm_;
  double depth_ = -5e-3; // [m]
};

class DeviceTest : public WindowTest
{
protected:
  DeviceTest()
  {
    const auto points = session_->body().haptic->points();
    arm_.top = *std::max_element(points.begin(), points.end(),
      [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return a.z() < b.z(); });
    session_->useDevice("made up", std::make_unique<MadeUpDevice>(arm_));
  }
  ~DeviceTest() override // before the arm
  {
    window_.reset();
    session_.reset();
  }

  [[nodiscard]] bool waitForState(const char* words)
  {
    return QTest::qWaitFor([&] { return state_->text().contains(words); }, kPatience);
  }
  void arm()
  {
    QTest::mouseClick(armButton_, Qt::LeftButton);
  }
  // a machine that does much else loses ticks, and then the force has to be asked for again
  void armAndPress()
  {
    const auto pushes = [&] { return arm_.force > 0.5; };
    for (int i = 0; i < kAttempts && !pushes(); ++i)
    {
      arm_.depth = -5e-3;
      QTest::qWait(200); // the panel shows what the device did
      if (!session_->armed())
      {
        arm();
      }
      (void)waitForState("force on");
      arm_.depth = 3e-3;
      (void)QTest::qWaitFor(pushes, kPatience / kAttempts);
    }
    EXPECT_TRUE(pushes());
  }
  [[nodiscard]] bool waitForNoForce()
  {
    return QTest::qWaitFor([&] { return arm_.force == 0.0; }, kPatience);
  }

  MadeUpArm arm_;
  QLabel* state_ = window_->findChild<QLabel*>("state");
  QPushButton* armButton_ = window_->findChild<QPushButton*>("arm");
};

TEST_F(DeviceTest, ThatIsPluggedInAgainIsHomedAndArmedAnew)
{
  EXPECT_TRUE(waitForState("needs homing"));
  arm_.homed = true;
  EXPECT_TRUE(waitForState("ready, force off"));
  armAndPress();

  arm_.plugged = false;
  EXPECT_TRUE(waitForState("plug it in again"));
  EXPECT_TRUE(waitForNoForce());
  EXPECT_TRUE(QTest::qWaitFor([&] { return !armButton_->isChecked(); }, kPatience));
  arm(); // does not help
  QTest::qWait(200);
  EXPECT_TRUE(waitForState("plug it in again"));

  arm_.homed = false;
  arm_.plugged = true;
  EXPECT_TRUE(waitForState("needs homing"));
  arm_.homed = true;
  EXPECT_TRUE(waitForState("was unplugged")) << "ready, and says why there is no force";
  EXPECT_TRUE(QTest::qWaitFor([&] { return !armButton_->isChecked(); }, kPatience));
  EXPECT_EQ(arm_.force, 0.0);
  armAndPress();
}

TEST_F(DeviceTest, IsStoppedByTheButtonUntilArmedAnew)
{
  arm_.homed = true;
  EXPECT_TRUE(waitForState("ready, force off"));
  armAndPress();
  QTest::mouseClick(window_->findChild<QPushButton*>("stop"), Qt::LeftButton);
  EXPECT_TRUE(waitForNoForce());
  EXPECT_TRUE(waitForState("stopped"));
  EXPECT_FALSE(session_->armed());
  armAndPress();
}

TEST_F(DeviceTest, IsLeftWithoutForceWhenTheWindowCloses)
{
  arm_.homed = true;
  EXPECT_TRUE(waitForState("ready, force off"));
  armAndPress();
  window_.reset();
  session_.reset();
  EXPECT_EQ(arm_.force, 0.0);
}

TEST(ViewProgram, WithAMouseMapsNoUsbLibrary)
{
  const test::Finished finished =
    test::runCommand("PALP_DATA=" PALP_SHARE " " PALP_VIEW " scene liver_mouse --explain");
  ASSERT_EQ(finished.code, 0) << finished.err;
  EXPECT_NE(finished.out.find("USB 0"), std::string::npos) << finished.out;
}

// last of all uses of the module here: once mapped, it stays
TEST(UsbModule, ComesWhenDevicesAreLookedFor)
{
  EXPECT_EQ(test::readAll("/proc/self/maps").find("palp-usb.so"), std::string::npos);
  const std::vector<std::string> names = Session::devices();
  EXPECT_NE(std::find(names.begin(), names.end(), "mouse"), names.end());
  EXPECT_NE(test::readAll("/proc/self/maps").find("palp-usb.so"), std::string::npos);
}

TEST(ViewProgram, WithoutAUsableDisplayEndsWithItsExitCode)
{
  const test::Finished finished =
    test::runCommand("DISPLAY=:987 PALP_DATA=" PALP_SHARE " " PALP_VIEW " view");
  EXPECT_EQ(finished.code, 4);
  EXPECT_NE(finished.err.find("palp run"), std::string::npos) << finished.err;
}

TEST(ViewProgram, EndsInOrderOnSigterm)
{
  // once it takes the signal, bit 14 of those it has a handler for
  const test::Finished finished = test::runCommand(
    "PALP_DATA=" PALP_SHARE " " PALP_VIEW " view & running=$!; until grep -q "
    "'^SigCgt:.*[4567cdef][0-9a-f]\\{3\\}$' /proc/$running/status; do kill -0 $running || exit; "
    "sleep 0.05; done; sleep 1; kill -TERM $running; wait $running");
  EXPECT_EQ(finished.code, 0) << finished.err;
}

TEST_F(WindowTest, NamesTheRulesThatADeepPressBreaks)
{
  press(160); // 9 mm with a tool of 10 mm radius
  const auto* rules = window_->findChild<QLabel*>("rules");
  EXPECT_TRUE(QTest::qWaitFor([&] { return rules->text().contains("depth"); }, kPatience))
    << rules->text().toStdString();
  release();
  EXPECT_TRUE(QTest::qWaitFor([&] { return rules->text().contains("no contact"); }, kPatience));
}

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

// made when it is asked for; what it saves is what the press shows
TEST_F(WindowTest, ShowsTheSectionOfAPressOnRequest)
{
  EXPECT_EQ(window_->findChild<PlotPanel*>(), nullptr);
  window_->findChild<QAction*>("plotsAction")->setChecked(true);
  auto* panel = window_->findChild<PlotPanel*>();
  ASSERT_NE(panel, nullptr);
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

TEST_F(WindowTest, ExportsWhatWasMeasured)
{
  press(100);
  ASSERT_TRUE(QTest::qWaitFor([&] { return peakForce() > 1.0; }, kPatience));
  release();
  QTest::qWait(200);
  ASSERT_TRUE(window_->exportData(QString::fromStdString(folder_.path().string())));
  const test::CsvTable samples = test::readCsv(folder_.path() / "samples.csv");
  const auto& force = samples["force_N"];
  ASSERT_GT(force.size(), 100u); // rest is not recorded
  EXPECT_NEAR(*std::max_element(force.begin(), force.end()), peakForce(), 1e-12);
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "deformed.vtp"));
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "servo.csv"));
}

TEST_F(WindowTest, AsksBeforeAnExportReplacesFiles)
{
  const auto file = folder_.path() / "samples.csv";
  std::ofstream(file) << "mine";
  const auto exporting = [&]
  { EXPECT_TRUE(window_->exportData(QString::fromStdString(folder_.path().string()))); };
  EXPECT_TRUE(whatIsSaidOf(exporting).contains("samples.csv")); // and closed without a yes
  EXPECT_EQ(test::readAll(file), "mine");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_.path()), {}), 1);

  QTimer yes;
  QObject::connect(&yes, &QTimer::timeout,
    []
    {
      if (auto* message = qobject_cast<QMessageBox*>(QApplication::activeModalWidget()))
      {
        message->button(QMessageBox::Yes)->click();
      }
    });
  yes.start(100);
  exporting();
  EXPECT_TRUE(test::readAll(file).starts_with("# palp"));
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "servo.csv"));
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

// while the servo thread goes on
TEST_F(WindowTest, AnUntouchedWindowDrawsAndRecordsNothing)
{
  window_->findChild<QAction*>("plotsAction")->setChecked(true);
  press(60);
  release();
  EXPECT_TRUE(
    QTest::qWaitFor([this] { return !session_->newest().contact.touching(); }, kPatience));
  const auto settled = [this] { return picturesIn(300) == 0; };
  EXPECT_TRUE(QTest::qWaitFor(settled, kPatience));
  const std::size_t recorded = session_->recording().samples.size();
  const std::uint64_t ticks = session_->timing().ticks;
  EXPECT_EQ(picturesIn(1500), 0);
  EXPECT_EQ(session_->recording().samples.size(), recorded);
  EXPECT_GT(session_->timing().ticks, ticks + 100);
  EXPECT_FALSE(std::isnan(session_->newest().time));

  // and wakes up again, with a curve that goes level over the rest
  press(60);
  release();
  const std::vector<Sample>& samples = session_->recording().samples;
  ASSERT_GT(samples.size(), recorded + 1);
  EXPECT_GT(samples[recorded].time - samples[recorded - 1].time, 1.0);
  EXPECT_EQ(samples[recorded].pose.apex, samples[recorded - 1].pose.apex);
}

TEST_F(WindowTest, AllReadingsAreOfOneSample)
{
  const QRegularExpression force("([0-9.]+) N");
  const QRegularExpression depth("depth ([0-9.]+) mm");
  const QPoint middle = canvas_->rect().center();
  QTest::mouseMove(canvas_, middle);
  QTest::mousePress(canvas_, Qt::LeftButton, {}, middle);
  int compared = 0;
  for (int pixels = 10; pixels < 200; pixels += 3)
  {
    QTest::mouseMove(canvas_, middle + QPoint(0, pixels));
    QTest::qWait(15);
    const QString scene = readings();
    const QString status = window_->findChild<QLabel*>("force")->text();
    const QString panel = window_->findChild<QLabel*>("rendered")->text();
    if (scene.contains(depth))
    {
      ++compared;
      EXPECT_EQ(force.match(scene).captured(1), force.match(status).captured(1));
      EXPECT_EQ(force.match(scene).captured(1), force.match(panel).captured(1));
      EXPECT_EQ(depth.match(scene).captured(1), depth.match(status).captured(1));
    }
  }
  EXPECT_GT(compared, 10);
  release();
}

TEST_F(WindowTest, ThisPressIsNotTheDeepestOfTheRecording)
{
  window_->findChild<QAction*>("plotsAction")->setChecked(true);
  auto* panel = window_->findChild<PlotPanel*>();
  panel->findChild<QTabBar*>("plotTabs")->setCurrentIndex(1);
  for (const int pixels : { 160, 40 })
  {
    press(pixels);
    release();
    EXPECT_TRUE(
      QTest::qWaitFor([this] { return !session_->newest().contact.touching(); }, kPatience));
    QTest::qWait(200);
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
    EXPECT_TRUE(window_->statusBar()->currentMessage().contains(name));
  }
  const QImage picture(QString::fromStdString((folder_.path() / "curves.png").string()));
  EXPECT_EQ(picture.size(), QSize(1600, 1500)); // two charts
}

TEST_F(WindowTest, SaysWhatItDidWhereNothingElseShowsIt)
{
  const auto said = [this] { return window_->statusBar()->currentMessage(); };
  const QString shot = QString::fromStdString((folder_.path() / "shot.png").string());
  ASSERT_TRUE(window_->saveScreenshot(shot));
  EXPECT_TRUE(said().contains(shot) && said().contains("pixels")) << said().toStdString();
  auto* devices = window_->findChild<QComboBox*>("device");
  devices->setCurrentIndex(devices->count() - 1); // scan
  EXPECT_TRUE(said().contains("evice")) << said().toStdString();
  EXPECT_EQ(devices->currentText(), "mouse");
  EXPECT_TRUE(devices->itemText(devices->count() - 1).contains("Scan")) << "can be asked again";
}

// a change of the tool ends a recording, and loses nothing
TEST_F(WindowTest, KeepsAndExportsWhatAChangeEnds)
{
  press(100);
  release();
  EXPECT_TRUE(
    QTest::qWaitFor([this] { return !session_->newest().contact.touching(); }, kPatience));
  QTest::qWait(200);
  const double peak = peakForce();
  window_->findChild<QComboBox*>("kind")->setCurrentIndex(1);
  EXPECT_TRUE(window_->statusBar()->currentMessage().contains("kept"));
  ASSERT_EQ(session_->earlier().size(), 1U);
  EXPECT_TRUE(std::holds_alternative<SphereTip>(session_->earlier()[0].recording.scene.law.tip()));
  ASSERT_TRUE(window_->exportData(QString::fromStdString(folder_.path().string())));
  const test::CsvTable samples = test::readCsv(folder_.path() / "earlier-1" / "samples.csv");
  const auto& force = samples["force_N"];
  EXPECT_NEAR(*std::max_element(force.begin(), force.end()), peak, 1e-9);
}

TEST_F(WindowTest, FitsASmallScreenWithItsStatusBar)
{
  window_->findChild<QAction*>("plotsAction")->setChecked(true);
  // 1280 x 720 and 1024 x 768 without a title bar; on a higher screen the panels ask for more
  const int screen = window_->screen()->availableSize().height();
  const QSize small(1008, std::max(672, screen * 7 / 10));
  window_->resize(small);
  QTest::qWait(200);
  EXPECT_EQ(window_->size(), small);
  EXPECT_GE(canvas_->width(), 300);
  const QRect bar(
    window_->statusBar()->mapTo(window_.get(), QPoint()), window_->statusBar()->size());
  EXPECT_TRUE(window_->rect().contains(bar));
}

// a mask of a ball
std::string writeMask(const std::filesystem::path& file)
{
  constexpr int kSide = 40;
  std::ofstream out(file, std::ios::binary);
  out << "ObjectType = Image\nNDims = 3\nDimSize = 40 40 40\nElementSpacing = 2 2 2\n"
         "ElementType = MET_UCHAR\nElementDataFile = LOCAL\n";
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
  QStringList levels{ "0,5", "7", "0.5" }; // typed in turn
  QTimer typist;
  QObject::connect(&typist, &QTimer::timeout,
    [&]
    {
      auto* dialog = qobject_cast<QDialog*>(QApplication::activeModalWidget());
      if (dialog != nullptr && !levels.isEmpty())
      {
        reasons.push_back(dialog->findChild<QLabel*>("why")->text());
        dialog->findChild<QLineEdit*>("level")->setText(levels.takeFirst());
        dialog->accept();
      }
    });
  typist.start(200);
  ASSERT_TRUE(window_->openFile(QString::fromStdString(file)));
  ASSERT_EQ(reasons.size(), 3U);
  EXPECT_TRUE(reasons[0].contains("level")) << reasons[0].toStdString();
  EXPECT_TRUE(reasons[1].contains("comma")) << reasons[1].toStdString();
  EXPECT_TRUE(reasons[2].contains("7")) << reasons[2].toStdString();
  EXPECT_EQ(session_->body().name, "mask.mha");
  press(60);
  release();
}

} // namespace
} // namespace palp
