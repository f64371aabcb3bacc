#include "haptics/devices/simulated/playhead.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace palp
{
namespace
{

constexpr double kTick = 1e-3; // [s]
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

// time and place in whole microseconds, which no sum rounds: a speed is whole tenths
struct Whole
{
  long long length; // [us]
  long long time;   // [us]
  bool loops;

  [[nodiscard]] long long place() const
  {
    return loops ? (length > 0 ? time % length : 0) : std::min(time, length);
  }
};

TEST(Playhead, GoesAsFastAsAskedAndStaysWithinTheLength)
{
  for (const long long length : { 0LL, 1LL, 100LL, 1'000LL, 1'300LL, 7'000LL, 250'000LL })
  {
    for (const bool loops : { false, true })
    {
      for (int tenths = 1; tenths <= 40; ++tenths)
      {
        Playhead head(1e-6 * static_cast<double>(length));
        (void)head.obey({ .loops = loops, .speed = 0.1 * tenths });
        Whole whole{ length, 0, loops };
        for (int tick = 0; tick < 1000; ++tick)
        {
          (void)head.advance(kTick);
          whole.time += 100LL * tenths;
          ASSERT_GE(head.time(), 0.0);
          ASSERT_LE(head.time(), head.length());
          const double apart = std::abs(head.time() - 1e-6 * static_cast<double>(whole.place()));
          const double around = std::abs(head.length() - apart); // its end is its beginning
          ASSERT_LT(loops ? std::min(apart, around) : apart, 1e-9)
            << length << " us, " << tenths << " tenths, tick " << tick;
        }
      }
    }
  }
}

TEST(Playhead, TellsHowOftenItBeginsAnew)
{
  for (int tenths = 1; tenths <= 40; ++tenths)
  {
    Playhead head(0.0505);
    (void)head.obey({ .loops = true, .speed = 0.1 * tenths });
    int begun = 0;
    for (int tick = 0; tick < 1000; ++tick)
    {
      begun += head.advance(kTick) ? 1 : 0;
    }
    EXPECT_EQ(begun, tenths * 1000 / 505) << tenths;
  }
}

TEST(Playhead, RatesWhatItDoes)
{
  Playhead head(0.1);
  (void)head.advance(kTick);
  EXPECT_EQ(head.rate(), 1.0);
  (void)head.obey({ .speed = 2.5 });
  (void)head.advance(kTick);
  EXPECT_EQ(head.rate(), 2.5);
  (void)head.obey({ .plays = false, .speed = 2.5 });
  const double paused = head.time();
  EXPECT_FALSE(head.advance(10.0));
  EXPECT_EQ(head.rate(), 0.0);
  EXPECT_EQ(head.time(), paused);

  (void)head.obey({ .speed = 2.5 });
  (void)head.advance(1.0);
  EXPECT_EQ(head.rate(), 2.5) << "on the way to the end";
  (void)head.advance(kTick);
  EXPECT_EQ(head.rate(), 0.0) << "there";
  (void)head.obey({ .loops = true });
  (void)head.advance(kTick);
  EXPECT_EQ(head.rate(), 1.0) << "and on, where it loops";

  Playhead point(0.0);
  (void)point.obey({ .loops = true });
  EXPECT_FALSE(point.advance(kTick));
  EXPECT_EQ(point.rate(), 0.0);
}

TEST(Playhead, GoesWhereItIsSoughtOnceAndNeverBeyondItsEnds)
{
  for (const double length : { 0.0, 1e-6, 2.0 })
  {
    Playhead head(length);
    std::uint64_t seeks = 0;
    for (const double place : { -kInf, -1.0, 0.0, 0.3, length, length + 1e-9, 1e300, kInf })
    {
      const PlayOrder order{ .plays = false, .place = place, .seeks = ++seeks };
      const bool isFinite = std::isfinite(place);
      const double before = head.time();
      EXPECT_EQ(head.obey(order), isFinite);
      const double expected = place < 0.0 ? 0.0 : place > length ? length : place;
      EXPECT_EQ(head.time(), isFinite ? expected : before);
    }
  }
  Playhead head(2.0);
  const PlayOrder order{ .place = 1.0, .seeks = 1 };
  EXPECT_TRUE(head.obey(order));
  (void)head.advance(0.25);
  EXPECT_FALSE(head.obey(order)) << "heard before";
  EXPECT_EQ(head.time(), 1.25);
}

TEST(Playhead, TakesNoSpeedBeyondItsRangeAndNoTimeThatIsNone)
{
  const auto after = [](double speed, double dt)
  {
    Playhead head(100.0);
    (void)head.obey({ .speed = speed });
    (void)head.advance(dt);
    return head.time();
  };
  EXPECT_DOUBLE_EQ(after(0.0, 1.0), 0.1);
  EXPECT_DOUBLE_EQ(after(-3.0, 1.0), 0.1);
  EXPECT_DOUBLE_EQ(after(1e9, 1.0), 4.0);
  EXPECT_DOUBLE_EQ(after(kNaN, 1.0), 1.0);
  for (const double dt : { 0.0, -1.0, kNaN, kInf })
  {
    EXPECT_EQ(after(1.0, dt), 0.0) << dt;
  }
}

} // namespace
} // namespace palp
