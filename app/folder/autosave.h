#pragma once

#include "app/input/scene_plan.h"
#include "app/press/recording.h"
#include "haptics/files/descriptor.h"

#include <filesystem>
#include <functional>
#include <future>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace palp
{

/// Leaves each press on the disk as it ends, until it is exported or discarded: a program that is
/// killed loses the one in progress at most. Main thread only; writes on another.
class Autosave
{
public:
  /// Of the user's own presses: below XDG_STATE_HOME, or .local/state.
  [[nodiscard]] static std::filesystem::path usualRoot();

  /// @param root  made where it is not there; where that cannot be, nothing is saved
  /// @param most  presses that it keeps; then the oldest goes
  explicit Autosave(std::filesystem::path root, int most = 200);

  ~Autosave();
  Autosave(const Autosave&) = delete;
  Autosave& operator=(const Autosave&) = delete;

  /// What cannot be written is tried again with the next.
  /// @param plan   by which it is repeated
  /// @param press  its samples
  void save(ScenePlan plan, Recording press);

  /// What became of a press: its names, where it was renamed, and whether it was deleted, which can
  /// be taken back.
  /// @param press  its number
  /// @param names  of all that were found in it, in their order; empty: it is not wanted
  void update(int press, std::vector<std::string> names);

  /// Tells once what could not be written; does not wait.
  /// @throws Error  BadFile
  void check();

  /// Whether a press is on the disk; waits until it is written.
  /// @param press  its number
  [[nodiscard]] bool has(int press);

  /// Where presses are kept; empty: nowhere, as no folder can be made there.
  [[nodiscard]] const std::filesystem::path& folder() const noexcept
  {
    return own_;
  }

  /// The number of the last press that was saved, from 1.
  [[nodiscard]] int saved() const noexcept
  {
    return count_;
  }

  /// Nothing of this program needs to be kept any longer.
  /// @param last  number of a press: what came after it is kept
  void clear(int last = std::numeric_limits<int>::max());

  /// Folders of presses, each as an export, that programs left which have ended: the oldest first.
  [[nodiscard]] std::vector<std::filesystem::path> left() const;

  /// Takes one of those over, so that it is kept as this program's own.
  /// @return  its number; 0: it is gone
  int adopt(const std::filesystem::path& press);

  /// Where a press is.
  [[nodiscard]] std::filesystem::path folderOf(int press) const;

  /// Sets those aside, out of left(), until this ends.
  void discard();

  /// Brings back all that was discarded, into left().
  void undiscard();

private:
  // a press that could not be written
  struct Unwritten
  {
    int number;
    ScenePlan plan;
    Recording press;
    std::optional<std::vector<std::string>> names; // of update()
  };

  void writeAll();
  void later(std::function<void()> write);
  [[nodiscard]] std::vector<std::filesystem::path> ended() const;

  std::filesystem::path root_;
  std::filesystem::path own_; // in it; empty: could not be made
  Descriptor lock_;           // of it
  int most_;
  int count_ = 0;                    // of presses in it
  std::vector<Unwritten> unwritten_; // the oldest first; of the other thread while written_ is
  std::future<void> written_;        // all of them
};

} // namespace palp
