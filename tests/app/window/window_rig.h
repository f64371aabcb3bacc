#pragma once

#include "app/graphs/plot_panel.h"
#include "app/program/build_trace.h"
#include "app/shell/message_bar.h"
#include "app/window/window.h"
#include "tests/app/application.h"
#include "tests/support/process.h"

#include <QAbstractSpinBox>
#include <QAction>
#include <QDeadlineTimer>
#include <QPushButton>
#include <QTest>
#include <QTimer>
#include <QVTKOpenGLNativeWidget.h>

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <gtest/gtest.h>
#include <vtkActor2DCollection.h>
#include <vtkCallbackCommand.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkNew.h>
#include <vtkRenderer.h>
#include <vtkRendererCollection.h>
#include <vtkTextActor.h>

namespace palp::test
{

inline bool has(const Sample& sample, Flag flag)
{
  return (sample.flags & static_cast<std::uint32_t>(flag)) != 0;
}

/// The window of a session with the bundled liver, and a hand on its mouse.
class WindowTest : public ::testing::Test
{
protected:
  explicit WindowTest(const ScenePlan& plan = {})
  {
    setenv("PALP_DATA", PALP_SHARE, 1);
    test::application();
    session_ = std::make_unique<Session>(plan, silent_);
    window_ = std::make_unique<Window>(*session_, silent_);
    window_->resize(kSmall);
    window_->show();
    EXPECT_TRUE(QTest::qWaitForWindowExposed(window_.get()));
    QApplication::setActiveWindow(window_.get()); // no window manager does it here
    canvas_ = window_->findChild<QVTKOpenGLNativeWidget*>("canvas");
    EXPECT_TRUE(canvas_->isValid()) << "no OpenGL context";
    const auto begun = [this]
    { return canvas_->renderWindow()->GetNeverRendered() == 0 && session_->newest().time > 0.1; };
    EXPECT_TRUE(QTest::qWaitFor(begun, kPatience));
  }

  // until the servo has gone on for a while and something is so
  void waitFor(const std::function<bool(const Sample&)>& isSo) const
  {
    const double before = session_->newest().time;
    const auto isNow = [&]
    {
      const Sample sample = session_->newest();
      return sample.time > before + 0.1 && isSo(sample);
    };
    EXPECT_TRUE(QTest::qWaitFor(isNow, kPatience));
  }

  void waitForRest() const
  {
    waitFor([](const Sample& sample) { return sample.pose.velocity.norm() < 1e-5; });
  }

  [[nodiscard]] bool waitForLift() const
  {
    return QTest::qWaitFor([this] { return !session_->newest().contact.touching(); }, kPatience);
  }

  // until so many presses were released and recorded since the start
  void waitForPresses(std::size_t count) const
  {
    EXPECT_TRUE(
      QTest::qWaitFor([&] { return session_->presses().presses().size() >= count; }, kPatience));
  }

  // until the picture was looked after so often: after twelve times without change it is smooth
  void waitForFrames(int count = 14) const
  {
    int seen = 0;
    const auto counting = QObject::connect(
      window_->findChild<QTimer*>("frames"), &QTimer::timeout, [&seen] { ++seen; });
    EXPECT_TRUE(QTest::qWaitFor([&] { return seen >= count; }, kPatience));
    QObject::disconnect(counting);
  }

  // the pointer goes down in the middle of the liver and drags, until the tool rests
  void press(int pixelsDown, bool mayFade = false)
  {
    const QPoint middle = canvas_->rect().center();
    QTest::mouseMove(canvas_, middle);
    waitFor([](const Sample&) { return true; });
    QTest::mousePress(canvas_, Qt::LeftButton, {}, middle);
    QTest::mouseMove(canvas_, middle + QPoint(0, pixelsDown));
    waitFor(
      [mayFade](const Sample& sample)
      {
        return (mayFade && has(sample, Flag::WatchdogExpired)) ||
          (sample.contact.touching() && sample.pose.velocity.norm() < 1e-5);
      });
  }

  void release()
  {
    QTest::mouseRelease(canvas_, Qt::LeftButton);
  }

  // by the simulated hand, until it rests with its whole force; a machine under load deprives it of
  // that by a late tick, and then it has to lift, and to be asked for again
  Sample pressWithForce(int pixelsDown)
  {
    const QDeadlineTimer patience(4 * kPatience);
    press(pixelsDown, true);
    Sample felt = session_->newest();
    while (!isFelt(felt) && !patience.hasExpired())
    {
      release();
      EXPECT_TRUE(waitForLift());
      session_->arm(false);
      const double now = session_->newest().time;
      EXPECT_TRUE(
        QTest::qWaitFor([this, now] { return session_->newest().time > now + 0.05; }, kPatience));
      session_->arm(true);
      press(pixelsDown, true);
      felt = session_->newest();
    }
    return felt;
  }

  [[nodiscard]] static bool isFelt(const Sample& sample)
  {
    return sample.state == DeviceState::Active && sample.contact.touching() &&
      !has(sample, Flag::Rebased) && !has(sample, Flag::WatchdogExpired);
  }

  // in front, where the picture has its place beside them
  [[nodiscard]] PlotPanel* showPlots() const
  {
    window_->findChild<QAction*>("plotsAction")->setChecked(true);
    auto* panel = window_->findChild<PlotPanel*>();
    EXPECT_TRUE(QTest::qWaitFor([panel] { return panel->isVisible(); }, kPatience));
    return panel;
  }

  // in the bar of messages
  [[nodiscard]] QString said() const
  {
    return window_->findChild<MessageBar*>()->text();
  }

  // there, by a button that is taken away with the others
  void answer(const QString& choice) const
  {
    const auto buttons = window_->findChild<MessageBar*>()->findChildren<QPushButton*>();
    const auto found = std::ranges::find(buttons, choice, &QPushButton::text);
    ASSERT_NE(found, buttons.end()) << choice.toStdString();
    (*found)->click();
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

  static constexpr int kPatience = 30'000; // [ms], for a machine that does much else
  // the picture is drawn by processors that tests have to share
  static constexpr QSize kSmall{ 1076, 752 };
  static constexpr QSize kUsual{ 1440, 860 };
  static constexpr int kAttempts = 10;

  test::TemporaryFolder folder_;
  BuildTrace silent_{ false };
  std::unique_ptr<Session> session_;
  std::unique_ptr<Window> window_;
  QVTKOpenGLNativeWidget* canvas_ = nullptr;
};

} // namespace palp::test
