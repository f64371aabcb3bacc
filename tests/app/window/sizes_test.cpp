#include "app/shell/theme.h"
#include "tests/app/window/window_rig.h"

#include <QAbstractButton>
#include <QDockWidget>
#include <QImage>
#include <QLabel>
#include <QScrollArea>
#include <QStatusBar>
#include <QToolBar>

#include <cstdlib>
#include <filesystem>
#include <gtest/gtest.h>

namespace palp
{
namespace
{

using test::WindowTest;

// the window at the sizes of usual screens, less what title bar and borders take
class Sizes : public WindowTest
{
protected:
  // whether a widget is scrolled, so that what is not seen can be
  [[nodiscard]] static bool isScrolled(const QWidget* widget)
  {
    for (const QWidget* above = widget; above != nullptr; above = above->parentWidget())
    {
      if (qobject_cast<const QScrollArea*>(above) != nullptr)
      {
        return true;
      }
    }
    return false;
  }

  [[nodiscard]] std::string nameOf(const QWidget* widget) const
  {
    const auto* label = qobject_cast<const QLabel*>(widget);
    const auto* button = qobject_cast<const QAbstractButton*>(widget);
    return (widget->objectName() + ' ' +
      (label       ? label->text()
          : button ? button->text()
                   : ""))
      .toStdString();
  }

  // what a text of one line takes, and the widget has
  void expectWhole(const QWidget* widget, const QString& text, int margin) const
  {
    const int needed = widget->fontMetrics().horizontalAdvance(QString(text).remove('&'));
    EXPECT_LE(needed, widget->width() - margin) << nameOf(widget);
  }

  void expectNothingClipped() const
  {
    const QRect inside = window_->rect();
    EXPECT_TRUE(inside.contains(window_->statusBar()->geometry()));
    for (const QWidget* widget : window_->findChildren<QWidget*>())
    {
      if (widget->visibleRegion().isEmpty() || widget->window() != window_.get())
      {
        continue;
      }
      const QRect place(widget->mapTo(window_.get(), QPoint(0, 0)), widget->size());
      const auto* label = qobject_cast<const QLabel*>(widget);
      const auto* button = qobject_cast<const QAbstractButton*>(widget);
      const bool isText =
        (label && !label->text().isEmpty()) || (button && !button->text().isEmpty());
      if (isText && !isScrolled(widget))
      {
        EXPECT_TRUE(inside.contains(place)) << nameOf(widget);
      }
      if (label && label->textFormat() != Qt::RichText && !label->wordWrap() &&
        label->objectName() != "force")
      {
        expectWhole(label, label->text(), 0);
      }
      if (button && !button->text().isEmpty())
      {
        expectWhole(button, button->text(), 4);
      }
    }
    for (QToolBar* bar : window_->findChildren<QToolBar*>())
    {
      const auto* more = bar->findChild<QWidget*>("qt_toolbar_ext_button");
      EXPECT_FALSE(more && more->isVisible()) << bar->objectName().toStdString() << " is cut";
    }
    EXPECT_GE(canvas_->width(), 320);
    EXPECT_GE(canvas_->height(), 320);
  }
};

// share of the columns of the picture in which the liver is, which it is not cut off by
double widthOfLiver(const QImage& picture)
{
  int columns = 0;
  for (int x = 0; x < picture.width(); ++x)
  {
    int red = 0;
    for (int y = 0; y < picture.height(); ++y)
    {
      const QColor color = picture.pixelColor(x, y);
      red += color.red() > color.green() + 30 && color.red() > color.blue() + 30 ? 1 : 0;
    }
    columns += red > 2 ? 1 : 0;
    EXPECT_FALSE(red > 2 && (x == 0 || x + 1 == picture.width())) << "it is cut off";
  }
  return static_cast<double>(columns) / picture.width();
}

TEST_F(Sizes, TheLiverFillsANarrowPicture)
{
  for (const QSize size : { QSize(1008, 720), QSize(1040, 900) })
  {
    window_->resize(size);
    EXPECT_TRUE(QTest::qWaitFor([&] { return window_->size() == size; }, kPatience));
    ASSERT_LT(canvas_->width(), canvas_->height());
    waitForFrames();
    EXPECT_NEAR(widthOfLiver(canvas_->grabFramebuffer()), 0.9, 0.03) << size.height();
  }
}

TEST_F(Sizes, NothingIsClippedBesideTheSupports)
{
  window_->findChild<QAction*>("supportsAction")->trigger();
  const auto* panel = window_->findChild<QDockWidget*>("Supports");
  EXPECT_TRUE(QTest::qWaitFor([panel] { return panel->isVisible(); }, kPatience));
  for (const QSize screen : { QSize(1024, 768), QSize(1280, 720) })
  {
    const QSize size = screen - QSize(16, 48);
    window_->resize(size);
    EXPECT_TRUE(QTest::qWaitFor([&] { return window_->size() == size; }, kPatience));
    waitForFrames();
    expectNothingClipped();
    const auto* solve = window_->findChild<QWidget*>("solveOrgan");
    EXPECT_EQ(solve->visibleRegion(), QRegion(solve->rect())) << "without scrolling";
  }
}

// of which a window of the same size makes no other use
TEST_F(Sizes, NothingIsClippedOnALargeScreen)
{
  const std::string self = std::filesystem::read_symlink("/proc/self/exe").string();
  const test::Finished large =
    test::runCommand("xvfb-run -a -s '-screen 0 2560x1440x24 -noreset' " + self +
      " --gtest_filter=Sizes.NothingIsClippedBesideTheSupports");
  EXPECT_EQ(large.code, 0) << large.out << large.err;
}

TEST_F(Sizes, NothingIsClippedInLightAndDark)
{
  const char* pictures = std::getenv("PALP_SIZES_PICTURES"); // a folder, to look at them
  press(80);
  release();
  EXPECT_TRUE(waitForLift());
  for (const Theme theme : { Theme::Light, Theme::Dark })
  {
    setTheme(theme);
    for (const QSize screen : { QSize(1024, 768), QSize(1280, 720), // 2560 x 1440 at scale 2
           QSize(1280, 800), QSize(1440, 860), QSize(1920, 1080) })
    {
      const QSize size = screen - QSize(16, 48);
      window_->resize(size);
      EXPECT_TRUE(QTest::qWaitFor([&] { return window_->size() == size; }, kPatience))
        << "the window is larger than a screen of " << screen.width() << " x " << screen.height();
      waitFor([](const Sample&) { return true; });
      SCOPED_TRACE(std::to_string(screen.width()) + " x " + std::to_string(screen.height()));
      expectNothingClipped();
      if (pictures != nullptr)
      {
        const QString name = QString("%1/%2_%3x%4.png")
                               .arg(pictures, theme == Theme::Dark ? "dark" : "light")
                               .arg(screen.width())
                               .arg(screen.height());
        EXPECT_TRUE(window_->grab().save(name));
      }
    }
  }
  setTheme(Theme::System);
}

} // namespace
} // namespace palp
