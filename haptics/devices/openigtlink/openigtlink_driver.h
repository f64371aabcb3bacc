#pragma once

#include "haptics/devices/driver.h"
#include "haptics/devices/openigtlink/igtl_messages.h"
#include "haptics/files/descriptor.h"

#include <memory>
#include <string>

namespace palp
{

/// A tool that a tracker follows: OpenIGTLink poses in, the force on the tool out as SENSOR.
///
/// Waits for one peer at a time. One that stays silent for a second gives way to the next; one that
/// reads nothing gets no more than it has room for; one that speaks another protocol is let go. The
/// force is for whoever wants to know: nothing here makes a hand feel it.
class OpenIgtLinkDriver final : public Driver
{
public:
  /// @param listening  a socket that listens and does not block
  /// @param tool       see IgtlReader
  OpenIgtLinkDriver(Descriptor listening, std::string tool);

  [[nodiscard]] DeviceLimits limits() const override;
  [[nodiscard]] IoCode tick(
    const Wrench& wrench, double dt, DriverSample& sample) noexcept override;

private:
  void accept(double dt) noexcept;
  void hangUp() noexcept;
  void send(const Eigen::Vector3d& force, double dt) noexcept;
  void receive(std::optional<TrackedPose>& newest) noexcept;

  Descriptor listening_;
  Descriptor peer_;
  IgtlReader reader_;
  double silent_ = 0.0;   // the peer [s]
  double sinceOut_ = 0.0; // since a force was begun [s]
  std::array<std::byte, kIgtlForce> out_{};
  std::size_t sent_ = kIgtlForce; // of it
  bool seen_ = false;             // the tool, ever
};

/// Waits for trackers.
/// @param name    [ADDRESS][:PORT][,TOOL]; 127.0.0.1, 18944 and the first tool without them
/// @throws Error  NoDevice: nothing can listen there, or this build has no libopenigtlink;
/// BadValue:
///                not such a name
[[nodiscard]] std::unique_ptr<Driver> openOpenIgtLink(const std::string& name);

} // namespace palp
