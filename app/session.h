#pragma once

#include "app/body.h"
#include "app/program.h"
#include "app/recording.h"
#include "haptics/devices/device.h"
#include "haptics/devices/simulated_hand.h"
#include "haptics/servo/servo.h"

#include <functional>
#include <memory>
#include <string>

namespace palp
{

/// A live press: body, tissue, the device that holds the tool, the servo thread, the recording.
///
/// The only writer of the scene. Main thread only.
class Session
{
public:
  static constexpr double kClearance = 0.015; ///< of a hovering tool above the surface [m]

  /// @throws Error  as loadBody, loadExtents, useDevice
  explicit Session(const ViewOptions& options);

  /// Replaces the body; tissue and device stay.
  /// @throws Error  BadFile, BadMesh; the old body then stays
  void open(const std::filesystem::path& file, const std::string& unit);

  void setTissue(const ForceLaw& law, ContactRule rule, double damping);

  /// mouse, hand, path:FILE, replay:FILE, or what openDriver knows; the recording begins anew.
  /// @throws Error  BadValue, BadFile, NoDevice; the old device then stays
  void useDevice(const std::string& name);

  /// Whether the user wants to feel force; off for every device but a simulated hand until asked.
  void arm(bool armed);

  /// Zero force at once and until taken back; then the device must be armed again.
  void stop(bool stopped);

  /// False for devices that no hand can feel.
  [[nodiscard]] bool rendersForce() const
  {
    return device_->limits().rendersForce;
  }
  /// What the device can render without trembling [N/m]; infinite where no hand can feel it.
  [[nodiscard]] double stableStiffness() const;
  [[nodiscard]] bool armed() const noexcept
  {
    return recording_.scene.armed;
  }

  /// Moves the tool of mouse and hand; other devices move themselves.
  void aim(const HandTarget& target);

  /// Fetches what the servo thread did since the last call.
  /// @param each  called for each new sample, in order
  void update(const std::function<void(const Sample&)>& each);

  [[nodiscard]] const Sample& newest() noexcept
  {
    return servo_->newest();
  }
  [[nodiscard]] const Timing& timing() const noexcept
  {
    return servo_->timing();
  }
  [[nodiscard]] const std::string& schedule() const noexcept
  {
    return servo_->schedule();
  }
  [[nodiscard]] const Body& body() const noexcept
  {
    return body_;
  }
  [[nodiscard]] const Calibration& calibration() const noexcept
  {
    return calibration_;
  }

  /// The last ten minutes.
  [[nodiscard]] const Recording& recording() const noexcept
  {
    return recording_;
  }

private:
  [[nodiscard]] std::unique_ptr<Device> makeDevice(const std::string& name);
  [[nodiscard]] HandTarget restingPlace() const;

  PressOptions options_;
  Body body_;
  Calibration calibration_;
  Recording recording_; // its scene is the one that the servo thread has
  std::function<void(const HandTarget&)> moveTool_;
  std::unique_ptr<Device> device_;
  std::unique_ptr<Servo> servo_; // last: it uses the device
};

} // namespace palp
