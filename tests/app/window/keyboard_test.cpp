#include "tests/app/window/window_rig.h"

#include <QAction>
#include <QDialog>
#include <QImage>
#include <QLabel>
#include <QLineEdit>

#include <cmath>
#include <gtest/gtest.h>
#include <utility>
#include <vtkCamera.h>

namespace palp
{
namespace
{

// nobody touches the mouse
class Keyboard : public test::WindowTest
{
protected:
  Keyboard()
  {
    canvas_->setFocus();
  }

  void keys(Qt::Key key, int times, Qt::KeyboardModifiers modifiers = Qt::NoModifier) const
  {
    for (int i = 0; i < times; ++i)
    {
      QTest::keyClick(canvas_, key, modifiers);
    }
  }

  [[nodiscard]] vtkCamera& camera() const
  {
    return *canvas_->renderWindow()->GetRenderers()->GetFirstRenderer()->GetActiveCamera();
  }

  [[nodiscard]] Eigen::Vector3d sight() const
  {
    return Eigen::Vector3d(camera().GetDirectionOfProjection());
  }
};

TEST_F(Keyboard, PressesByTenthsOfAMillimeterAndSlides)
{
  keys(Qt::Key_PageDown, 21);
  keys(Qt::Key_PageUp, 1);
  waitForRest();
  EXPECT_NEAR(session_->newest().contact.depth, 2.0e-3, 0.02e-3);
  const Eigen::Vector3d before = session_->newest().contact.center;
  keys(Qt::Key_Right, 8);
  waitForRest();
  const Eigen::Vector3d moved = session_->newest().contact.center - before;
  EXPECT_NEAR(session_->newest().contact.depth, 2.0e-3, 0.05e-3);
  const Eigen::Vector3d right = sight().cross(Eigen::Vector3d(camera().GetViewUp()));
  EXPECT_GT(moved.dot(right), 3e-3);
  EXPECT_LT(std::abs(moved.dot(right.cross(sight()))), 0.5 * moved.norm());
  keys(Qt::Key_PageDown, 5);
  waitForRest();
  EXPECT_NEAR(session_->newest().contact.depth, 2.5e-3, 0.05e-3);
  keys(Qt::Key_Escape, 1);
  EXPECT_TRUE(waitForLift());
}

TEST_F(Keyboard, TurnsTheViewAndZooms)
{
  const Eigen::Vector3d before = sight();
  const double distance = camera().GetDistance();
  keys(Qt::Key_Right, 3, Qt::ControlModifier);
  EXPECT_NEAR(std::acos(std::min(1.0, sight().dot(before))), 15.0 * M_PI / 180.0, 0.07);
  keys(Qt::Key_Plus, 2);
  EXPECT_NEAR(camera().GetDistance(), distance / 1.21, 0.01 * distance);
  keys(Qt::Key_Home, 1);
  EXPECT_TRUE(QTest::qWaitFor(
    [&] { return std::abs(camera().GetDistance() - distance) < 0.02 * distance; }, kPatience));
}

// each side of a patient in LPS, and the tool's own
TEST_F(Keyboard, LooksFromEachSide)
{
  const std::vector<Eigen::Vector3d> ways{ { 0, 1, 0 }, { 0, -1, 0 }, { -1, 0, 0 }, { 1, 0, 0 },
    { 0, 0, -1 }, { 0, 0, 1 } };
  for (std::size_t i = 0; i < ways.size(); ++i)
  {
    keys(static_cast<Qt::Key>(Qt::Key_1 + i), 1, Qt::ControlModifier);
    EXPECT_LT((sight() - ways[i]).norm(), 1e-6) << i;
  }
  keys(Qt::Key_PageDown, 10);
  waitForRest();
  keys(Qt::Key_7, 1, Qt::ControlModifier);
  EXPECT_LT((sight() - session_->newest().pose.axis).norm(), 1e-3);
}

TEST_F(Keyboard, EscapeClosesTheSheetOfKeysToo)
{
  QTest::keyClick(window_.get(), Qt::Key_H);
  ASSERT_NE(window_->findChild<QDialog*>("keySheet"), nullptr);
  QTest::keyClick(window_.get(), Qt::Key_Escape);
  EXPECT_TRUE(QTest::qWaitFor(
    [this] { return window_->findChild<QDialog*>("keySheet") == nullptr; }, kPatience));
}

TEST_F(Keyboard, ExportsFromWithinAField)
{
  const auto* exporting = window_->findChild<QAction*>("exportAction");
  int asked = 0;
  window_->findChild<QAction*>("exportAction")->disconnect();
  QObject::connect(exporting, &QAction::triggered, [&asked] { ++asked; });
  for (auto* field : window_->findChildren<QLineEdit*>())
  {
    if (field->isVisible() && field->isEnabled())
    {
      field->setFocus();
      QTest::keyClick(field, Qt::Key_E, Qt::ControlModifier);
      EXPECT_EQ(asked, 1) << field->objectName().toStdString();
      asked = 0;
    }
  }
}

// first what is typed and refused, then what was changed
TEST_F(Keyboard, UndoesFromWithinAField)
{
  const auto modulus = [this] { return session_->scene().law.material().youngModulus; };
  const double before = modulus();
  type("young", "20");
  ASSERT_EQ(modulus(), 20e3);
  auto* field = window_->findChild<QAbstractSpinBox*>("young");
  auto* reason = window_->findChild<QLabel*>("youngReason");
  field->setFocus();
  type("young", "30 apples");
  ASSERT_TRUE(reason->isVisible());
  QTest::keyClick(field, Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(field->text(), "20 kPa");
  EXPECT_FALSE(reason->isVisible());
  EXPECT_EQ(modulus(), 20e3);
  QTest::keyClick(field, Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(modulus(), before);
  EXPECT_EQ(field->text(), "50 kPa");
  type("young", "20");
  auto* place = window_->findChild<QLineEdit*>("pressPlace");
  place->setFocus();
  QTest::keyClick(place, Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(modulus(), before);
}

TEST_F(Keyboard, HidesTheToolAndShowsItAgain)
{
  const auto differing = [](const QImage& a, const QImage& b)
  {
    int pixels = 0;
    for (int y = 0; y < a.height(); ++y)
    {
      for (int x = 0; x < a.width(); ++x)
      {
        pixels += a.pixel(x, y) != b.pixel(x, y) ? 1 : 0;
      }
    }
    return pixels;
  };
  const auto still = [&]
  {
    waitForFrames();
    return canvas_->grabFramebuffer();
  };
  window_->resize(kUsual);
  keys(Qt::Key_PageDown, 10);
  waitForRest();
  const QImage shown = still();
  keys(Qt::Key_T, 1);
  const QImage outlined = still();
  keys(Qt::Key_T, 1);
  const QImage hidden = still();
  EXPECT_GT(differing(shown, hidden), 300);
  EXPECT_GT(differing(outlined, hidden), 100);
  EXPECT_LT(differing(outlined, hidden), 0.7 * differing(shown, hidden)) << "a line alone";
  keys(Qt::Key_T, 1);
  EXPECT_LT(differing(shown, still()), 30);
}

} // namespace
} // namespace palp
