#pragma once

#include "app/press/presses.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace palp
{

/// A moment of a press.
struct CurvePoint
{
  double depth; ///< of the contact [m]
  double force; ///< of the law [N]
};

/// A press that is kept with what it was made by, whatever becomes of its recording.
struct KeptPress
{
  int id = 0; ///< of its own in a log, from 1
  PressSummary summary{};
  std::string organ{}; ///< that was pressed; empty: the only body
  std::string mesh{};  ///< name of the body
  ForceLaw law;
  ContactRule rule = ContactRule::Exact;
  double damping = 0.0;            ///< b [N s/m]
  bool isInBody = false;           ///< which gave way by an organ file
  std::string outside{};           ///< see outsideLimits; empty also where no sample is rated
  std::vector<CurvePoint> curve{}; ///< from touch to release, kCurve of its samples at most
  int saved = 0;                   ///< number by which Autosave has it; 0: none; or kElsewhere

  static constexpr int kElsewhere = -1; ///< in an export, or in the sheet of a search
  static constexpr std::size_t kCurve = 400;
};

/// Tells the names of the presses of a recording, in their order, as a log calls them: empty where
/// one was removed, and its own where the log has none. For any thread.
using PressNames = std::function<std::vector<std::string>(const Recording& recording)>;

/// The presses of a session, each found by itself when its tool is released. Main thread only.
class PressLog
{
public:
  static constexpr std::size_t kMost = 500; ///< presses; then the oldest goes

  /// Takes the next sample of a recording; before that of keep(), whatever is kept of it.
  void follow(const Sample& sample) noexcept;

  /// Whether a press goes on that keep() has not kept yet.
  [[nodiscard]] bool isPressing() const noexcept
  {
    return begin_.has_value();
  }

  /// What the next press is called that keep() keeps; empty: by its number.
  void nameNext(std::string name)
  {
    next_ = std::move(name);
  }

  /// Whether the tool was released of a press that keep() has not kept yet.
  [[nodiscard]] bool isReleased() const noexcept
  {
    return isPressing() && now_ - lastTouch_ >= kBounce;
  }

  /// Keeps the press that the tool was released of since, if any.
  /// @return  its samples, with the one before, and its name
  std::optional<Recording> keep(const Recording& recording);

  /// The same of the press that the end of a recording ends.
  std::optional<Recording> end(const Recording& recording);

  /// Keeps all presses of a recording that is whole.
  /// @return  how many
  std::size_t keepAll(const Recording& recording);

  /// The oldest first.
  [[nodiscard]] const std::vector<KeptPress>& presses() const noexcept
  {
    return presses_;
  }

  /// As they are called now.
  [[nodiscard]] PressNames names() const;

  /// Null where it is gone.
  [[nodiscard]] const KeptPress* find(int id) const noexcept;

  /// Those that were kept last are saved under a number, see KeptPress.
  void noteSaved(int number) noexcept;

  /// All up to one are exported.
  void noteExported(int id) noexcept;

  /// The id of the last that was kept; 0: none.
  [[nodiscard]] int newest() const noexcept
  {
    return found_;
  }

  /// The names of the presses that are saved under a number, in their order.
  [[nodiscard]] std::vector<std::string> namesOf(int saved) const;

  ///@{
  /// Does nothing where it is gone.
  void rename(int id, const std::string& name);
  void remove(int id);
  ///@}

  /// Puts a removed press back to where it was.
  void restore(KeptPress press);

  /// Another number after each change.
  [[nodiscard]] int version() const noexcept
  {
    return version_;
  }

private:
  [[nodiscard]] std::string freeName(const std::string& wanted) const;
  [[nodiscard]] std::string nextName() const;
  [[nodiscard]] std::vector<KeptPress>::iterator firstKept() noexcept; // of those kept last

  std::vector<KeptPress> presses_; // ids rise
  std::vector<PressSummary> gone_; // removed, without a name
  std::optional<double> begin_;    // of the press that goes on [s]
  double lastTouch_ = 0.0;         // of it [s]
  double now_ = 0.0;               // of the last sample [s]
  std::string next_;
  int found_ = 0;
  int firstNew_ = 1; // of those that were kept last
  int version_ = 0;
};

} // namespace palp
