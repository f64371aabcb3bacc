#include "haptics/threads/rtkit.h"
#include "tests/support/private_bus.h"

#include <chrono>
#include <gtest/gtest.h>
#include <sstream>
#include <unistd.h>

namespace palp
{
namespace
{

class Rtkit : public testing::Test
{
protected:
  void startDouble(const std::string& how)
  {
    bus_.start({ PALP_RTKIT_DOUBLE, log(), how });
    test::PrivateBus::await(log());
  }

  [[nodiscard]] std::string log() const
  {
    return bus_.folder() / "granted";
  }

  test::PrivateBus bus_;
};

TEST_F(Rtkit, GrantsAThreadOfThisProgramAndNoOther)
{
  bus_.startDaemon();
  startDouble("");
  EXPECT_TRUE(askRtkit(gettid()));
  std::istringstream granted(test::readAll(log()));
  pid_t process = 0;
  pid_t thread = 0;
  int priority = 0;
  granted >> process >> thread >> priority;
  EXPECT_EQ(process, getpid());
  EXPECT_EQ(thread, gettid());
  EXPECT_EQ(priority, 20);
  EXPECT_FALSE(askRtkit(1));
}

TEST_F(Rtkit, IsDoneWithoutWhereNobodyIsThereOrAnswers)
{
  EXPECT_FALSE(askRtkit(gettid())) << "no bus";
  bus_.startDaemon();
  EXPECT_FALSE(askRtkit(gettid())) << "nobody of that name";
  startDouble("mute");
  const auto start = std::chrono::steady_clock::now();
  EXPECT_FALSE(askRtkit(gettid())) << "no answer";
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
}

} // namespace
} // namespace palp
