#include "haptics/servo/device_thread.h"

#include <atomic>
#include <gtest/gtest.h>
#include <vector>

namespace palp
{
namespace
{

using namespace std::chrono_literals;

// what the transport saw, kept beyond the life of the device
struct Record
{
  std::atomic<double> last = -1.0; // force [N]
  std::atomic<int> calls = 0;
};

// blocks as a USB transfer does
class SlowDevice final : public Device
{
public:
  SlowDevice(Record& record, std::chrono::milliseconds block)
    : record_(record)
    , block_(block)
  {
  }

  [[nodiscard]] DeviceLimits limits() const override
  {
    return { .model = "slow", .maxForce = 3.0 };
  }

  [[nodiscard]] std::optional<ToolPose> exchange(
    const Eigen::Vector3d& force, double) noexcept override
  {
    std::this_thread::sleep_for(block_);
    record_.last = force.z();
    ++record_.calls;
    ToolPose pose;
    pose.apex = Eigen::Vector3d::Constant(record_.calls.load());
    return pose;
  }

private:
  Record& record_;
  std::chrono::milliseconds block_;
};

TEST(DeviceThread, PassesForceAndPoseWithoutWaiting)
{
  Record record;
  DeviceThread device(std::make_unique<SlowDevice>(record, 5ms));
  EXPECT_EQ(device.limits().model, "slow");
  double newest = 0.0;
  while (newest < 5.0 || record.last.load() != 1.5)
  {
    if (const auto pose = device.exchange({ 0.0, 0.0, 1.5 }, 0.001))
    {
      EXPECT_GE(pose->apex.x(), newest); // never an older one
      EXPECT_EQ(pose->apex.x(), pose->apex.z());
      EXPECT_GE(device.status().age, 0.0);
      newest = pose->apex.x();
    }
    std::this_thread::sleep_for(1ms);
  }
}

TEST(DeviceThread, AForceThatIsNotRenewedEnds)
{
  Record record;
  DeviceThread device(std::make_unique<SlowDevice>(record, 1ms));
  while (record.last.load() != 1.5)
  {
    (void)device.exchange({ 0.0, 0.0, 1.5 }, 0.001);
  }
  while (record.last.load() != 0.0) // the servo has stalled
  {
    std::this_thread::sleep_for(1ms);
  }
}

TEST(DeviceThread, EndsWithZeroForce)
{
  Record record;
  {
    DeviceThread device(std::make_unique<SlowDevice>(record, 1ms));
    while (record.last.load() != 1.5)
    {
      (void)device.exchange({ 0.0, 0.0, 1.5 }, 0.001);
    }
  }
  EXPECT_EQ(record.last.load(), 0.0);
}

} // namespace
} // namespace palp
