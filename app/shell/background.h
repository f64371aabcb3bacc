#pragma once

#include "haptics/threads/followed_work.h"

#include <QObject>

#include <deque>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace palp
{

/// Work on a thread of its own, one at a time, while the event loop of the window goes on. Main
/// thread only. Its end waits for work that was given up.
class Background
{
public:
  using Work = std::function<void()>;
  using Follow = std::function<void(const FollowedWork::Step& step)>;

  /// Returns once the work has ended or was given up. Meanwhile the user may change anything, so
  /// the work holds copies of all that it uses; it is not copied itself.
  ///
  /// @param work    finds whether it is still wanted, and tells how far it is, by FollowedWork
  /// @param follow  called again and again, once the work takes longer than people notice
  /// @return        false: it was given up, and ends some time
  /// @throws Error  BadValue: other work goes on; what the work throws
  bool run(Work work, const Follow& follow);

  /// The same for work that makes something; none: it was given up.
  template <typename Made>
  std::optional<Made> make(std::function<Made()> work, const Follow& follow)
  {
    const auto made = std::make_shared<std::optional<Made>>();
    const bool hasEnded = run([made, work = std::move(work)] { made->emplace(work()); }, follow);
    return hasEnded ? std::move(*made) : std::nullopt;
  }

  void giveUp() noexcept;

  [[nodiscard]] bool isBusy() const noexcept
  {
    return going_ != nullptr;
  }

  /// Calls what runs work once none goes on any longer, from the event loop, in the order of the
  /// calls.
  /// @param start  does not throw
  void later(Work start);

  [[nodiscard]] std::size_t waiting() const noexcept
  {
    return waiting_.size();
  }

  /// Gives up also what waits.
  void giveUpAll() noexcept;

private:
  void next();

  std::shared_ptr<FollowedWork> going_; // null: nothing goes on
  std::deque<Work> waiting_;
  std::unique_ptr<QObject> here_ = std::make_unique<QObject>(); // calls back while it is
  std::vector<std::future<void>> givenUp_;
};

} // namespace palp
