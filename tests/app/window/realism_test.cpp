#include "app/shell/window_memory.h"
#include "pipeline/figure/gl_renderer.h"
#include "tests/app/window/window_rig.h"

#include <QImage>

#include <gtest/gtest.h>
#include <utility>

namespace palp
{
namespace
{

using test::WindowTest;

class RealismTest : public WindowTest
{
protected:
  [[nodiscard]] QAction* action() const
  {
    return window_->findChild<QAction*>("realisticAction");
  }

  [[nodiscard]] QImage still() const
  {
    QImage picture;
    const auto isStill = [&]
    {
      const QImage before = std::exchange(picture, canvas_->grabFramebuffer());
      QTest::qWait(700);
      return before == picture;
    };
    EXPECT_TRUE(QTest::qWaitFor(isStill, kPatience));
    return picture;
  }

  struct Change
  {
    double body = 0.0;   // share of pixels that differ clearly, in the middle
    double ground = 0.0; // and in the upper corners
  };

  [[nodiscard]] static Change changeOf(const QImage& a, const QImage& b)
  {
    const auto share = [&](const QRect& part)
    {
      int changed = 0;
      for (int y = part.top(); y <= part.bottom(); ++y)
      {
        for (int x = part.left(); x <= part.right(); ++x)
        {
          changed += std::abs(qGray(a.pixel(x, y)) - qGray(b.pixel(x, y))) > 8 ? 1 : 0;
        }
      }
      return 1.0 * changed / (part.width() * part.height());
    };
    const QPoint middle = a.rect().center();
    return { .body = share(QRect(middle - QPoint(60, 60), QSize(120, 120))),
      .ground = share(QRect(0, 0, 60, 60)) };
  }
};

// this machine has no graphics card, or this test nothing to say of its default
TEST_F(RealismTest, IsOffWithoutACardTurnedOnByHandAndRemembered)
{
  QTest::mouseMove(canvas_, QPoint(5, 5)); // off the body
  const QImage plain = still();
  EXPECT_EQ(action()->isChecked(), !drawsInSoftware(rendererNameOf(*canvas_->renderWindow())));
  EXPECT_FALSE(WindowMemory().isRealistic()) << "nobody said so";
  if (action()->isChecked())
  {
    action()->trigger();
  }
  action()->trigger();
  const QImage wet = still();
  EXPECT_GT(changeOf(plain, wet).body, 0.3);
  EXPECT_LT(changeOf(plain, wet).ground, 0.01);
  EXPECT_EQ(WindowMemory().isRealistic(), true);
  ASSERT_TRUE(window_->openFile(PALP_SHARE "/meshes/sphere_50.vtp"));
  const QImage ball = still();

  window_ = std::make_unique<Window>(*session_, silent_); // the next start
  window_->show();
  canvas_ = window_->findChild<QVTKOpenGLNativeWidget*>("canvas");
  EXPECT_TRUE(QTest::qWaitFor([this] { return action()->isChecked(); }, kPatience));
  EXPECT_LT(changeOf(ball, still()).body, 0.1) << "the same wet ball";

  action()->trigger();
  EXPECT_FALSE(action()->isChecked());
  const QImage dull = still();
  EXPECT_GT(changeOf(ball, dull).body, 0.3);
  EXPECT_EQ(WindowMemory().isRealistic(), false);
  EXPECT_FALSE(action()->toolTip().isEmpty());
}

} // namespace
} // namespace palp
