// A program that drives an arm until it dies: argument 1 is the descriptor of its board, 2 how many
// megabytes it holds, which the system takes back before it says that the program has ended.

#include "haptics/devices/bus_device.h"
#include "haptics/devices/file_transport.h"
#include "haptics/devices/guard/guarded_driver.h"
#include "haptics/devices/hid/hid_drivers.h"

#include <cstdlib>
#include <thread>
#include <vector>

int main(int, char** arguments)
{
  using namespace std::chrono_literals;
  const Eigen::Vector3d push(0.5, 0.0, 0.5); // [N]
  const int board = std::atoi(arguments[1]);
  const std::vector<char> memory(std::strtoul(arguments[2], nullptr, 10) << 20U, 'x');
  palp::BusDevice device(
    [board]
    {
      return palp::guarded(std::make_unique<palp::FileTransport>(board), palp::woodenZero(64),
        [](std::unique_ptr<palp::Transport> wire)
        { return std::make_unique<palp::WoodenDriver>(std::move(wire), palp::WoodenArm{}, 64); });
    },
    {});
  for (;;)
  {
    (void)device.exchange(push, 0.001);
    device.answer(push);
    std::this_thread::sleep_for(1ms);
  }
}
