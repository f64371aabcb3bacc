#include "app/shell/background.h"

#include "haptics/error.h"
#include "tests/app/application.h"

#include <QTest>
#include <QTimer>

#include <algorithm>
#include <chrono>
#include <gtest/gtest.h>
#include <stdexcept>
#include <thread>
#include <vector>

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
  std::atomic<int> pictures = 0;
  std::atomic<int> told = 0;
  QTimer picture;
  QObject::connect(&picture, &QTimer::timeout, [&] { ++pictures; });
  picture.start(10);
  const auto made = background_.make<int>(
    [&]
    {
      tellDone(0.25);
      const auto end = std::chrono::steady_clock::now() + 60s; // for a loop that waits for it
      while ((pictures < 20 || told < 4) && std::chrono::steady_clock::now() < end)
      {
        std::this_thread::sleep_for(1ms);
      }
      return pictures.load();
    },
    [&](const FollowedWork::Step& step)
    {
      ++told;
      EXPECT_EQ(step.done, 0.25);
    });
  EXPECT_TRUE(made);
  EXPECT_GE(made.value_or(0), 20);
  EXPECT_GE(told, 4);
}

// as it would be late by that, too
TEST_F(BackgroundTest, TheLoopGoesOnDuringShortWork)
{
  constexpr int kAttempts = 10; // of a machine that does much else
  bool hasTurned = false;
  for (int i = 0; i < kAttempts && !hasTurned; ++i)
  {
    std::atomic<bool> turned = false;
    QTimer::singleShot(0, [&] { turned = true; });
    background_.run(
      [&]
      {
        std::this_thread::sleep_for(22ms);
        hasTurned = turned;
      },
      [](const auto&) {});
    QApplication::processEvents();
  }
  EXPECT_TRUE(hasTurned);
}

TEST_F(BackgroundTest, IsGivenUpAtOnceAndDoesOneWorkAtATime)
{
  std::atomic<bool> ended = false;
  std::atomic<bool> mayEnd = false;
  QTimer::singleShot(100,
    [&]
    {
      EXPECT_TRUE(background_.isBusy());
      EXPECT_THROW(background_.run([] {}, [](const auto&) {}), Error);
      background_.giveUp();
    });
  EXPECT_FALSE(background_.run(
    [&]
    {
      while (FollowedWork::ofThisThread()->isWanted() || !mayEnd)
      {
        std::this_thread::sleep_for(1ms);
      }
      ended = true;
    },
    [](const auto&) {}));
  EXPECT_FALSE(ended) << "nobody waits for it";
  EXPECT_FALSE(background_.isBusy());
  EXPECT_EQ(background_.make<int>([] { return 1; }, [](const auto&) {}), 1);
  mayEnd = true;
  background_ = {};
  EXPECT_TRUE(ended) << "but the end does";
}

TEST_F(BackgroundTest, DoesWhatWaitsInItsOrder)
{
  std::vector<int> done;
  const auto none = [](const FollowedWork::Step&) {};
  const auto work = [&](int number)
  {
    return background_.run([] { std::this_thread::sleep_for(60ms); }, none) ? done.push_back(number)
                                                                            : void();
  };
  QTimer::singleShot(0,
    [&]
    {
      EXPECT_TRUE(background_.isBusy());
      background_.later([&] { work(2); });
      background_.later([&] { work(3); });
      EXPECT_EQ(background_.waiting(), 2U);
    });
  work(1);
  EXPECT_TRUE(QTest::qWaitFor([&] { return done.size() == 3; }, 30'000));
  EXPECT_EQ(done, (std::vector{ 1, 2, 3 }));
  background_.later([&] { work(4); });
  background_.giveUpAll();
  QTest::qWait(100);
  EXPECT_EQ(done.size(), 3U);
}

TEST_F(BackgroundTest, PassesOnWhatIsThrown)
{
  for (const auto pause : { 0ms, 100ms })
  {
    const auto fail = [pause]
    {
      std::this_thread::sleep_for(pause);
      throw std::runtime_error("no");
    };
    EXPECT_THROW(background_.run(fail, [](const auto&) {}), std::runtime_error);
    EXPECT_FALSE(background_.isBusy());
  }
}

} // namespace
} // namespace palp
