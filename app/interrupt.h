#pragma once

#include <csignal>
#include <stop_token>
#include <thread>

namespace palp
{

/// While it lives, Ctrl-C asks the work to stop instead of ending the program.
///
/// Made before any other thread, which then inherits that the signals wait here.
class Interrupt
{
public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  [[nodiscard]] std::stop_token token() const
  {
    return source_.get_token();
  }

private:
  std::stop_source source_;
  sigset_t signals_{};
  sigset_t before_{};
  std::jthread listener_;
};

} // namespace palp
