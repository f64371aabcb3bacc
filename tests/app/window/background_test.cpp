#include "app/shell/background.h"

#include "haptics/error.h"
#include "tests/app/application.h"

#include <QElapsedTimer>
#include <QTimer>

#include <algorithm>
#include <chrono>
#include <gtest/gtest.h>
#include <stdexcept>
#include <thread>

namespace palp
{
namespace
{

using namespace std::chrono_literals;

class BackgroundTest : public ::testing::Test
{
protected:
  BackgroundTest()
  {
    test::application();
  }

  Background background_;
};

// as a picture would be late that waits for the work
TEST_F(BackgroundTest, TheLoopGoesOnMeanwhile)
{
  QElapsedTimer since;
  qint64 longest = 0;
  QTimer picture;
  QObject::connect(&picture, &QTimer::timeout,
    [&] { longest = since.isValid() ? std::max(longest, since.restart()) : (since.start(), 0); });
  picture.start(10);
  int told = 0;
  const auto made = background_.make<int>(
    [](const std::atomic<bool>&)
    {
      std::this_thread::sleep_for(700ms);
      return 7;
    },
    [&] { ++told; });
  EXPECT_EQ(made, 7);
  EXPECT_GT(told, 3);
  EXPECT_LT(longest, 300) << "[ms], of work of 700";
}

TEST_F(BackgroundTest, IsGivenUpAtOnceAndDoesOneWorkAtATime)
{
  std::atomic<bool> ended = false;
  QTimer::singleShot(100,
    [&]
    {
      EXPECT_TRUE(background_.isBusy());
      EXPECT_THROW(background_.run([](const auto&) {}, [] {}), Error);
      background_.giveUp();
    });
  QElapsedTimer clock;
  clock.start();
  EXPECT_FALSE(background_.run(
    [&](const std::atomic<bool>& isWanted)
    {
      while (isWanted)
      {
        std::this_thread::sleep_for(1ms);
      }
      std::this_thread::sleep_for(1s);
      ended = true;
    },
    [] {}));
  EXPECT_FALSE(ended) << "nobody waits for it";
  EXPECT_FALSE(background_.isBusy());
  EXPECT_EQ(background_.make<int>([](const auto&) { return 1; }, [] {}), 1);
  background_ = {};
  EXPECT_TRUE(ended) << "but the end does";
}

TEST_F(BackgroundTest, PassesOnWhatIsThrown)
{
  for (const auto pause : { 0ms, 100ms })
  {
    const auto fail = [pause](const std::atomic<bool>&)
    {
      std::this_thread::sleep_for(pause);
      throw std::runtime_error("no");
    };
    EXPECT_THROW(background_.run(fail, [] {}), std::runtime_error);
    EXPECT_FALSE(background_.isBusy());
  }
}

} // namespace
} // namespace palp
