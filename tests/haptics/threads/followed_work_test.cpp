#include "haptics/threads/followed_work.h"

#include "haptics/error.h"

#include <gtest/gtest.h>
#include <thread>

namespace palp
{
namespace
{

TEST(FollowedWork, IsFoundByItsThreadAlone)
{
  EXPECT_NO_THROW(tellDone(0.5)) << "nobody follows";
  FollowedWork work;
  {
    const FollowedWork::OfThread followed(work);
    EXPECT_EQ(FollowedWork::ofThisThread(), &work);
    std::thread([] { EXPECT_EQ(FollowedWork::ofThisThread(), nullptr); }).join();
  }
  EXPECT_EQ(FollowedWork::ofThisThread(), nullptr);
}

TEST(FollowedWork, TellsItsStepsAndEndsOnceItIsGivenUp)
{
  FollowedWork work;
  double last = 0.0;
  std::thread worker(
    [&work]
    {
      const FollowedWork::OfThread followed(work);
      work.begin("counting");
      EXPECT_THROW(
        for (double done = 0.0;; done = done < 0.9 ? done + 0.001 : done) { tellDone(done); },
        Error);
    });
  while (last < 0.9)
  {
    const FollowedWork::Step step = work.step();
    EXPECT_GE(step.done.value_or(0.0), last) << "it goes on";
    EXPECT_TRUE(step.what.empty() || step.what == "counting");
    last = step.done.value_or(0.0);
  }
  work.giveUp();
  worker.join();
  EXPECT_FALSE(work.isWanted());
  work.begin("drawing");
  EXPECT_FALSE(work.step().done) << "of another step nobody knows";
}

} // namespace
} // namespace palp
