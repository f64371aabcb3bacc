#include "tests/app/window/window_rig.h"

#include <QImage>
#include <QLabel>
#include <QPushButton>
#include <QToolButton>

#include <algorithm>
#include <cstdlib>
#include <gtest/gtest.h>
#include <utility>

namespace palp
{
namespace
{

using test::WindowTest;

class MessageOverPicture : public WindowTest
{
protected:
  // what stands in a corner or at the foot of the picture
  void showMarks(const QStringList& names) const
  {
    for (QAction* action : window_->findChildren<QAction*>())
    {
      const QString name = action->text().remove('&');
      kMarks.contains(name) ? action->setChecked(names.contains(name)) : void();
    }
  }

  inline static const QStringList kMarks{ "Axes", "Scale bar", "Readings" };

  // at rest, with smooth edges
  [[nodiscard]] QImage picture() const
  {
    QImage now;
    const auto isStill = [&]
    {
      const QImage before = std::exchange(now, canvas_->grabFramebuffer());
      waitForFrames();
      return before == now;
    };
    EXPECT_TRUE(QTest::qWaitFor(isStill, kPatience));
    return now;
  }

  // clearly: the ground at the sides varies by a shade as edges are made smooth
  [[nodiscard]] static bool differs(const QImage& a, const QImage& b, int x, int y)
  {
    constexpr int kShades = 20;
    return std::abs(qGray(a.pixel(x, y)) - qGray(b.pixel(x, y))) > kShades;
  }

  struct Marks
  {
    int count = 0;   // of their pixels
    int lowest = -1; // row, from above
  };

  [[nodiscard]] Marks marks() const
  {
    showMarks({});
    const QImage without = picture();
    showMarks(kMarks);
    const QImage with = picture();
    Marks found;
    for (int y = 0; y < with.height(); ++y)
    {
      for (int x = 0; x < with.width(); ++x)
      {
        if (with.pixel(x, y) != without.pixel(x, y))
        {
          ++found.count;
          found.lowest = y;
        }
      }
    }
    return found;
  }

  // the readings make way for what else stands there, so they are seen beside it alone
  void expectMarksApart() const
  {
    constexpr int kApart = 2; // [pixels]
    showMarks(kMarks);
    (void)picture(); // in which the labels of the color bar find their places
    const QImage all = picture();
    showMarks({ "Axes", "Scale bar" });
    const QImage bars = picture();
    showMarks({});
    const QImage none = picture();
    int touching = 0;
    int atSides = 0;
    int drawn = 0;
    for (int y = kApart; y < none.height() - kApart; ++y)
    {
      for (int x = 0; x < none.width(); ++x)
      {
        const bool isInside = x >= kApart && x < none.width() - kApart;
        const bool isBar = differs(bars, none, x, y);
        const bool isMark = differs(all, none, x, y);
        for (const auto& [right, down] :
          { std::pair(-kApart, 0), { kApart, 0 }, { 0, -kApart }, { 0, kApart }, { 0, 0 } })
        {
          touching += isBar && isInside && differs(all, bars, x + right, y + down) ? 1 : 0;
        }
        atSides += isMark && (x == 0 || x == none.width() - 1) ? 1 : 0;
        drawn += isMark ? 1 : 0;
      }
    }
    EXPECT_GT(drawn, 3000);
    EXPECT_EQ(touching, 0);
    EXPECT_EQ(atSides, 0);
  }
};

TEST_F(MessageOverPicture, CoversNothingThatTheFootOfThePictureTells)
{
  auto* bar = window_->findChild<MessageBar*>();
  press(80);
  for (const QSize size : { QSize(1008, 720), QSize(1424, 812) })
  {
    window_->resize(size);
    bar->tell({});
    const Marks alone = marks();
    ASSERT_GT(alone.count, 2000);
    EXPECT_GT(alone.lowest, canvas_->height() - 60) << "they stand above the foot";
    bar->warn("liver.stl: 12 edges have one triangle only; the surface is open there, and what is "
              "pressed near its rim is not what a closed body would give; close the holes with "
              "palp check liver.stl --close-holes 20mm --repair clean.vtp, and open that one");
    const Marks above = marks();
    EXPECT_LT(above.lowest, bar->y()) << size.width();
    EXPECT_GT(above.count, 0.9 * alone.count) << size.width();
    bar->tell({});
    EXPECT_EQ(marks().lowest, alone.lowest) << "they come down again";
  }
  release();
}

// a picture takes longer than what works in the background may hold up the window
TEST_F(MessageOverPicture, ALineWithAButtonMovesNothing)
{
  window_->resize(kUsual); // where the line is not longer than the picture is wide
  auto* bar = window_->findChild<MessageBar*>();
  bar->tell({});
  (void)picture();
  bar->follow("Saving the figure", "drawing", 50, [] {});
  EXPECT_EQ(picturesIn(600), 0);
  bar->unfollow("Saving the figure");
  EXPECT_EQ(picturesIn(600), 0);
}

// where the picture is narrowest: the least window, with a panel beside the charts; and where what
// is read is beside the bar, as wide as it comes
TEST_F(MessageOverPicture, NoMarkStandsOnAnotherOrIsCut)
{
  window_->findChild<QAction*>("trainingAction")->trigger();
  for (const auto& [size, pixels] : { std::pair(QSize(1008, 720), 80), { QSize(1250, 672), 50 } })
  {
    window_->resize(size);
    press(pixels);
    expectMarksApart();
    release();
    EXPECT_TRUE(waitForLift());
  }
}

TEST_F(MessageOverPicture, AQuestionIsReadWholeBesideItsAnswers)
{
  window_->resize(QSize(1008, 720));
  auto* bar = window_->findChild<MessageBar*>();
  bar->ask("Not exported yet: 2 presses of before", { { "Restore", {} }, { "Discard", {} } });
  const auto* text = bar->findChild<QLabel*>("message");
  const auto isWhole = [text] { return text->height() >= text->heightForWidth(text->width()); };
  EXPECT_TRUE(QTest::qWaitFor(isWhole, 3000));
}

// before it is seen, its parts have other sizes
TEST(MessageBar, AQuestionIsReadWholeThatIsAskedBeforeItIsSeen)
{
  test::application();
  QWidget over;
  over.resize(330, 600);
  MessageBar bar(&over);
  bar.ask("Not exported yet: 2 presses of before", { { "Restore", {} }, { "Discard", {} } });
  over.setStyleSheet("QPushButton { min-width: 80px; }"); // as that of a desktop
  over.show();
  const auto* text = bar.findChild<QLabel*>("message");
  const auto isWhole = [text] { return text->height() >= text->heightForWidth(text->width()); };
  EXPECT_TRUE(QTest::qWaitFor(isWhole, 3000)) << text->height();
}

TEST_F(WindowTest, WhatIsAddedToAQuestionLeavesItsAnswers)
{
  auto* bar = window_->findChild<MessageBar*>();
  int restored = 0;
  bar->ask("Not exported yet: 2 presses", { { "Restore", [&] { ++restored; } } });
  bar->add("Drawn with 60 triangles");
  EXPECT_EQ(said(), "Not exported yet: 2 presses. Drawn with 60 triangles");
  answer("Restore");
  EXPECT_EQ(restored, 1);
  bar->tell({});
  bar->add("Drawn with 70 triangles");
  EXPECT_EQ(said(), "Drawn with 70 triangles");
}

// or until the user does something
TEST_F(WindowTest, AWarningStandsUntilItCanHaveBeenRead)
{
  auto* bar = window_->findChild<MessageBar*>();
  const auto shown = [bar] { return bar->findChild<QLabel*>("message")->text(); };
  EXPECT_FALSE(window_->saveScreenshot("/proc/nope.png"));
  const QString warning = shown();
  EXPECT_TRUE(warning.startsWith("/proc/nope.png: ")) << warning.toStdString();
  bar->follow("Exporting", "writing", 50, [] {});
  EXPECT_EQ(shown(), warning + "\nExporting: writing");
  bar->unfollow("Exporting");
  EXPECT_EQ(shown(), warning);
  bar->tell("Written");
  EXPECT_EQ(shown(), warning + "\nWritten");
  EXPECT_EQ(said(), "Written") << "the newest";
  waitForFrames(1);
  QTest::keyClick(canvas_, Qt::Key_Plus);
  EXPECT_EQ(shown(), warning + "\nWritten") << "while nothing is newer";
  bar->tell("Opened");
  EXPECT_EQ(shown(), "Opened");
  bar->warn("Device lost");
  bar->findChild<QToolButton*>("closeMessage")->click();
  bar->tell("Connected");
  EXPECT_EQ(shown(), "Connected");
}

} // namespace
} // namespace palp
