#pragma once

#include "haptics/devices/driver.h"
#include "haptics/devices/falcon/falcon.h"
#include "haptics/devices/falcon/falcon_kinematics.h"

#include <memory>
#include <vector>

namespace palp
{

/// A Novint Falcon. Its firmware is not free and comes from a file of the user's, once after power
/// on; the user homes it by pulling the grip out, pushing it in, and pulling it out once more.
class FalconDriver final : public Driver
{
public:
  /// Probes whether firmware runs already; loads it if not.
  ///
  /// @param firmware  whole file; may be empty when the device has been loaded before
  /// @throws Error    NoDevice: no firmware runs and none was given, or it could not be loaded
  FalconDriver(std::unique_ptr<SerialTransport> transport, const std::vector<std::byte>& firmware);

  [[nodiscard]] DeviceLimits limits() const override;
  [[nodiscard]] IoCode tick(
    const Wrench& wrench, double dt, DriverSample& sample) noexcept override;

private:
  [[nodiscard]] bool request(std::uint8_t what, std::uint16_t value) noexcept;
  [[nodiscard]] bool enterNormalMode() noexcept;
  [[nodiscard]] bool answers() noexcept;
  [[nodiscard]] bool load(const std::vector<std::byte>& firmware) noexcept;
  [[nodiscard]] bool sendAndExpect(Bytes sent, Bytes expected) noexcept;
  [[nodiscard]] IoCode exchange(const FalconCommand& command, std::optional<FalconState>& state,
    std::chrono::microseconds wait) noexcept;

  std::unique_ptr<SerialTransport> transport_;
  FalconReader reader_;
  Eigen::Vector3d position_ = falconCenter();
  bool counted_ = false; // its encoders have found their zero
  bool homed_ = false;   // and the grip was pulled out since
  int purges_ = 0;       // exchanges that are to begin by forgetting what was not read
};

} // namespace palp
