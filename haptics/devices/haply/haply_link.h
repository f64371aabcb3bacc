#pragma once

#include "haptics/devices/haply/haply_message.h"
#include "haptics/files/descriptor.h"
#include "haptics/threads/latest.h"

#include <atomic>
#include <chrono>
#include <memory>
#include <string>
#include <thread>

namespace palp
{

/// A WebSocket to the service of Haply on this machine, kept by a thread of its own: parsing JSON
/// allocates, which no servo may. Each command gets one state in reply.
class HaplyLink
{
public:
  /// Connects, and waits for the first message.
  /// @throws Error  NoDevice: no service, another one, or no arm; and what to do
  explicit HaplyLink(std::uint16_t port);
  ~HaplyLink();
  HaplyLink(const HaplyLink&) = delete;
  HaplyLink& operator=(const HaplyLink&) = delete;

  /// Sends a force and waits for the state that answers it.
  /// @return    false: none came in time
  /// @realtime  no allocation, no lock, no exception
  [[nodiscard]] bool exchange(
    const Eigen::Vector3d& force, std::chrono::microseconds wait) noexcept;

  /// The newest. @realtime  no allocation, no lock, no exception
  [[nodiscard]] const HaplyState& state() noexcept
  {
    return states_.read();
  }

  /// The service has ended, or said what is none of its messages; then it was sent zero force.
  [[nodiscard]] bool gone() const noexcept
  {
    return gone_;
  }

  /// Whether the last command that went out asked for force.
  [[nodiscard]] bool pushes() const noexcept
  {
    return pushes_;
  }

  /// Its socket, as long as this lives.
  [[nodiscard]] int descriptor() const noexcept
  {
    return socket_.get();
  }

private:
  struct Service; // of libwebsockets
  friend struct Service;

  void stop() noexcept;
  [[nodiscard]] bool waitForReply(std::chrono::microseconds wait) noexcept;

  Latest<Eigen::Vector3d> forces_{ Eigen::Vector3d::Zero() }; // to its thread
  Latest<HaplyState> states_;                                 // from it
  std::atomic<bool> gone_ = false;
  std::atomic<bool> pushes_ = false;
  std::atomic<int> asked_ = 0; // commands
  Descriptor replies_;         // rung by it
  Descriptor socket_;          // a copy of its own, before the first message
  std::unique_ptr<Service> service_;
  std::jthread thread_; // last: it uses all the others
};

} // namespace palp
