#include "haptics/devices/falcon/falcon.h"
#include "haptics/devices/falcon/falcon_driver.h"
#include "haptics/devices/hid/hid_drivers.h"
#include "haptics/servo/safety.h"
#include "haptics/units.h"
#include "tests/haptics/felt_tissue.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <memory>
#include <string>
#include <vector>

namespace palp
{
namespace
{

using namespace units::literals;

// a board that answers every packet with the same state
class Echo final : public SerialTransport
{
public:
  [[nodiscard]] IoResult read(MutableBytes into, std::chrono::microseconds) noexcept override
  {
    const auto body = encode(FalconCommand{});
    into[0] = std::byte{ 1 };
    into[1] = std::byte{ 0x60 };
    std::ranges::copy(body, into.begin() + 2);
    return { IoCode::Ok, body.size() + 2 };
  }
  [[nodiscard]] IoCode write(Bytes) noexcept override
  {
    return IoCode::Ok;
  }
  [[nodiscard]] bool request(std::uint8_t, std::uint16_t) noexcept override
  {
    return true;
  }
};

struct StatedArm
{
  DeviceLimits limits;
  double stiffest; // that it is to render in a hand [N/m]
};

std::vector<StatedArm> arms()
{
  return { { FalconDriver(std::make_unique<Echo>(), {}).limits(), 600.0 },
    { WoodenDriver(std::make_unique<Echo>(), WoodenArm{}, 14).limits(), 800.0 },
    { Phd1Driver(std::make_unique<Echo>()).limits(), 500.0 } };
}

// at the 1 ms that each states until its delay is measured
TEST(FeltTissue, ArmsRenderWhatAHandOnThemHolds)
{
  for (const auto& [limits, stiffest] : arms())
  {
    EXPECT_GE(SafetyChain(limits).stiffnessLimit(0.0), stiffest) << limits.model;
  }
}

TEST(FeltTissue, DiffersByMoreThanAHandNeedsToTellItApart)
{
  for (const auto& [limits, unused] : arms())
  {
    expectTissuesToBeToldApart(limits);
  }
}

// what a bus is measured to take is believed, not what was stated
TEST(FeltTissue, IsSofterOnAnArmThatIsMeasuredToBeLate)
{
  SafetyChain chain(arms().front().limits);
  const double stated = chain.stiffnessLimit(0.0);
  for (const auto& [delay, low, high] :
    { std::tuple{ 3.0_ms, 0.3, 0.6 }, std::tuple{ 0.5_ms, 1.1, 2.0 } })
  {
    for (int tick = 0; tick < 1000; ++tick)
    {
      DeviceStatus status;
      status.delay = delay;
      (void)chain.admit(ToolPose{}, status, {}, 1.0_ms);
    }
    EXPECT_NEAR(chain.delay(), delay, 0.11_ms);
    EXPECT_GE(chain.stiffnessLimit(0.0), low * stated) << delay;
    EXPECT_LE(chain.stiffnessLimit(0.0), high * stated) << delay;
  }
}

} // namespace
} // namespace palp
