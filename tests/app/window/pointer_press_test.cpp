#include "tests/app/window/window_rig.h"

#include <QAction>
#include <QCheckBox>
#include <QDockWidget>
#include <QLabel>
#include <QRegularExpression>
#include <QWheelEvent>

#include <gtest/gtest.h>
#include <vtkCamera.h>

namespace palp
{
namespace
{

using test::WindowTest;

TEST_F(WindowTest, PressesAsDeepAsTheDrag)
{
  press(100);
  const Contact contact = session_->newest().contact;
  EXPECT_NEAR(contact.depth, 6e-3, 0.02e-3); // a button's millimeter, 0.05 mm a pixel
  EXPECT_NEAR(session_->newest().response.force,
    session_->recording().scene.law({ .depth = contact.depth }).force, 1e-9);
  const QString status = window_->findChild<QLabel*>("force")->text();
  EXPECT_TRUE(status.contains("N") && status.contains("mm")) << status.toStdString();
  release();
  EXPECT_TRUE(
    QTest::qWaitFor([this] { return !session_->newest().contact.touching(); }, kPatience));
}

// half as deep as asked in the tissue in use then, and as much less as another is stiffer
TEST_F(WindowTest, AToolMayLagWhereItIsStiff)
{
  auto* lag = window_->findChild<QCheckBox*>("lag");
  EXPECT_TRUE(QTest::qWaitFor([lag] { return lag->isEnabled(); }, kPatience));
  const auto depth = [this]
  {
    press(100);
    const double deep = session_->newest().contact.depth;
    release();
    EXPECT_TRUE(waitForLift());
    return deep;
  };
  QTest::mouseClick(lag, Qt::LeftButton, {}, QPoint(8, lag->height() / 2));
  EXPECT_TRUE(said().contains("lags") || session_->lags());
  EXPECT_NEAR(depth(), 3e-3, 0.03e-3);
  type("young", "61"); // 22 % more
  EXPECT_NEAR(depth(), 3e-3 / 1.22, 0.03e-3);
  QTest::mouseClick(lag, Qt::LeftButton, {}, QPoint(8, lag->height() / 2));
  EXPECT_NEAR(depth(), 6e-3, 0.03e-3);
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
  for (const QPoint position :
    { QPoint(-80, 0), QPoint(80, -20), QPoint(-40, -30), QPoint(60, 10) })
  {
    waitForRest();
    QTest::mouseMove(canvas_, middle + position);
  }
  waitForRest();
  ASSERT_NE(session_->recording().deepest(), nullptr);
  EXPECT_NEAR(session_->recording().deepest()->contact.depth, 4e-3, 0.1e-3);
}

// the contact stays where it is in the picture, and what is below the pointer
TEST_F(WindowTest, TurnsAboutTheContactAndZoomsToThePointer)
{
  press(60);
  vtkRenderer& renderer = *canvas_->renderWindow()->GetRenderers()->GetFirstRenderer();
  const Eigen::Vector3d contact = session_->newest().contact.center;
  const auto seenAt = [&]
  {
    renderer.SetWorldPoint(contact.x(), contact.y(), contact.z(), 1.0);
    renderer.WorldToDisplay();
    return Eigen::Vector2d(renderer.GetDisplayPoint());
  };
  const auto towards = [&]
  { return Eigen::Vector3d(renderer.GetActiveCamera()->GetDirectionOfProjection()); };
  const Eigen::Vector2d before = seenAt();
  const Eigen::Vector3d way = towards();
  const QPoint middle = canvas_->rect().center();
  for (const auto& [from, to] :
    { std::pair(QPoint(0, 60), QPoint(90, 20)), { QPoint(90, 20), QPoint(60, 110) } })
  {
    QTest::mousePress(canvas_, Qt::RightButton, {}, middle + from);
    QTest::mouseMove(canvas_, middle + to);
    QTest::mouseRelease(canvas_, Qt::RightButton, {}, middle + to);
    EXPECT_LT((seenAt() - before).norm(), 1.0);
  }
  EXPECT_GT(std::acos(towards().dot(way)), 5.0 * M_PI / 180.0);
  release();
  EXPECT_TRUE(waitForLift());

  const double ratio = canvas_->devicePixelRatioF();
  const QPoint aside(qRound(before.x() / ratio), qRound(canvas_->height() - before.y() / ratio));
  QTest::mouseMove(canvas_, aside);
  const double distance = renderer.GetActiveCamera()->GetDistance();
  for (int i = 0; i < 4; ++i)
  {
    QWheelEvent notch(aside, canvas_->mapToGlobal(aside), {}, QPoint(0, 120), Qt::NoButton,
      Qt::ControlModifier, Qt::NoScrollPhase, false);
    QApplication::sendEvent(canvas_, &notch);
  }
  EXPECT_LT(renderer.GetActiveCamera()->GetDistance(), 0.8 * distance);
  EXPECT_LT((seenAt() - before).norm(), 3.0 * ratio);
}

TEST_F(WindowTest, HoveringNeverTouches)
{
  for (const QPoint position :
    { QPoint(-150, 0), QPoint(120, -30), QPoint(0, 60), QPoint(-60, -60) })
  {
    QTest::mouseMove(canvas_, canvas_->rect().center() + position);
    waitForRest();
  }
  EXPECT_EQ(peakForce(), 0.0);
}

TEST_F(WindowTest, TheWheelBesideTheBodyPressesNothing)
{
  press(60);
  release();
  EXPECT_TRUE(waitForLift());
  const QPoint beside(3, 3);
  QTest::mouseMove(canvas_, beside);
  for (int i = 0; i < 3; ++i)
  {
    QWheelEvent notch(beside, canvas_->mapToGlobal(beside), {}, QPoint(0, -120), Qt::NoButton,
      Qt::NoModifier, Qt::NoScrollPhase, false);
    QApplication::sendEvent(canvas_, &notch);
  }
  waitForRest();
  EXPECT_FALSE(session_->newest().contact.touching());
  EXPECT_EQ(session_->presses().presses().size(), 1U);
}

// the straight way to another place would lead through the liver
TEST_F(WindowTest, GoesToAnotherPlaceOverTheSurface)
{
  press(60);
  const QPoint middle = canvas_->rect().center();
  for (const QPoint position : { QPoint(-150, 0), QPoint(120, -30), QPoint(-60, -60) })
  {
    release();
    QTest::mouseMove(canvas_, middle + position);
    QTest::mousePress(canvas_, Qt::LeftButton, {}, middle + position);
    QTest::mouseMove(canvas_, middle + position + QPoint(0, 60));
    waitForRest();
    EXPECT_TRUE(session_->newest().contact.touching());
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

TEST_F(WindowTest, NamesTheRulesThatADeepPressBreaks)
{
  press(160); // 9 mm with a tool of 10 mm radius
  const auto* rules = window_->findChild<QLabel*>("rules");
  EXPECT_TRUE(QTest::qWaitFor([&] { return rules->text().contains("depth"); }, kPatience))
    << rules->text().toStdString();
  release();
  EXPECT_TRUE(QTest::qWaitFor([&] { return rules->text().contains("no contact"); }, kPatience));
}

TEST_F(WindowTest, AllReadingsAreOfOneSample)
{
  const QRegularExpression force("([0-9.]+) N");
  const QRegularExpression depth("depth ([0-9.]+) mm");
  const QPoint middle = canvas_->rect().center();
  QTest::mouseMove(canvas_, middle);
  QTest::mousePress(canvas_, Qt::LeftButton, {}, middle);
  int compared = 0;
  for (int i = 0; i < 1000 && (i < 60 || compared <= 10); ++i)
  {
    QTest::mouseMove(canvas_, middle + QPoint(0, 10 + 3 * (i % 60)));
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

// while the servo thread goes on
// how often a widget's part of the window is drawn, and the window with it
class PaintCount final : public QObject
{
public:
  explicit PaintCount(QWidget* watched)
  {
    watched->installEventFilter(this);
  }
  [[nodiscard]] int within(int milliseconds)
  {
    painted_ = 0;
    QTest::qWait(milliseconds);
    return painted_;
  }
  bool eventFilter(QObject* watched, QEvent* event) override
  {
    painted_ += event->type() == QEvent::Paint ? 1 : 0;
    return QObject::eventFilter(watched, event);
  }

private:
  int painted_ = 0;
};

TEST_F(WindowTest, AnUntouchedWindowDrawsAndRecordsNothing)
{
  (void)showPlots();
  press(60);
  release();
  EXPECT_TRUE(
    QTest::qWaitFor([this] { return !session_->newest().contact.touching(); }, kPatience));
  const auto settled = [this] { return picturesIn(300) == 0; };
  EXPECT_TRUE(QTest::qWaitFor(settled, kPatience));
  const std::size_t recorded = session_->recording().samples.size();
  const std::uint64_t ticks = session_->timing().ticks;
  EXPECT_EQ(picturesIn(1500), 0);
  window_->findChild<QDockWidget*>("Diagnostics")->show();
  PaintCount timing(window_->findChild<QLabel*>("timing"));
  const auto idles = [&] { return timing.within(2500) == 0; };
  EXPECT_TRUE(QTest::qWaitFor(idles, kPatience)) << "the times that always change a little";
  EXPECT_EQ(session_->recording().samples.size(), recorded);
  EXPECT_GT(session_->timing().ticks, ticks + 100);
  EXPECT_FALSE(std::isnan(session_->newest().time));

  // and wakes up again, with a curve that goes level over the rest
  press(60);
  release();
  const std::vector<Sample>& samples = session_->recording().samples;
  ASSERT_GT(samples.size(), recorded + 1);
  EXPECT_GT(samples[recorded].time - samples[recorded - 1].time, 1.0);
  EXPECT_LT((samples[recorded].pose.apex - samples[recorded - 1].pose.apex).norm(), 1e-7);
}

} // namespace
} // namespace palp
