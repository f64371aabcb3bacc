#pragma once

#include <atomic>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <vector>

namespace palp
{

/// Work on a thread of its own, one at a time, while the event loop of the window goes on. Main
/// thread only. Its end waits for work that was given up.
class Background
{
public:
  using Work = std::function<void(const std::atomic<bool>& isWanted)>;

  /// Returns once the work has ended or was given up. Meanwhile the user may change anything, so
  /// the work holds copies of all that it uses.
  ///
  /// @param work    is told whether it is still wanted
  /// @param follow  called again and again, once the work takes longer than people notice
  /// @return        false: it was given up, and ends some time
  /// @throws Error  BadValue: other work goes on; what the work throws
  bool run(const Work& work, const std::function<void()>& follow);

  /// The same for work that makes something; none: it was given up.
  template <typename Made>
  std::optional<Made> make(
    const std::function<Made(const std::atomic<bool>&)>& work, const std::function<void()>& follow)
  {
    const auto made = std::make_shared<std::optional<Made>>();
    const bool hasEnded = run(
      [made, work](const std::atomic<bool>& isWanted) { made->emplace(work(isWanted)); }, follow);
    return hasEnded ? std::move(*made) : std::nullopt;
  }

  void giveUp() noexcept;

  [[nodiscard]] bool isBusy() const noexcept
  {
    return wanted_ != nullptr;
  }

private:
  std::shared_ptr<std::atomic<bool>> wanted_; // null: nothing goes on
  std::vector<std::future<void>> givenUp_;
};

} // namespace palp
