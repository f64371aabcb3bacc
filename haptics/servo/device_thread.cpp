#include "haptics/servo/device_thread.h"

namespace palp
{
namespace
{

constexpr std::chrono::milliseconds kStale(20); // a force not renewed for so long is not sent

double seconds(std::chrono::nanoseconds duration) noexcept
{
  return std::chrono::duration<double>(duration).count();
}

} // namespace

DeviceThread::DeviceThread(std::unique_ptr<Device> device, std::chrono::nanoseconds fastest)
  : device_(std::move(device))
  , limits_(device_->limits())
  , fastest_(fastest)
  , thread_([this](const std::stop_token& stop) { run(stop); })
{
}

DeviceThread::~DeviceThread() = default; // the thread stops and joins first

std::optional<ToolPose> DeviceThread::exchange(const Eigen::Vector3d& force, double) noexcept
{
  const Clock::time_point now = Clock::now();
  command_.publish({ force, now });
  const Answer& answer = answer_.read();
  if (answer.first)
  {
    return std::nullopt;
  }
  status_ = answer.status;
  status_.age += seconds(now - answer.taken);
  return answer.pose;
}

void DeviceThread::run(const std::stop_token& stop) noexcept
{
  Clock::time_point last = Clock::now() - fastest_;
  while (!stop.stop_requested())
  {
    const Clock::time_point now = Clock::now();
    const Command& command = command_.read();
    const bool fresh = now - command.given < kStale;
    const Eigen::Vector3d force = fresh ? command.force : Eigen::Vector3d(Eigen::Vector3d::Zero());
    const std::optional<ToolPose> pose = device_->exchange(force, seconds(now - last));
    answer_.publish({ pose, device_->status(), Clock::now(), false });
    last = now;
    std::this_thread::sleep_until(now + fastest_); // at once when the transport has blocked
  }
  (void)device_->exchange(Eigen::Vector3d::Zero(), seconds(fastest_));
}

} // namespace palp
