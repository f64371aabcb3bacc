#pragma once

#include <iosfwd>
#include <string>
#include <utility>
#include <vector>

namespace palp
{

/// What this process holds at one moment.
struct Footprint
{
  double sinceStart = 0.0; ///< of the process [s]; the kernel tells it in steps of 10 ms
  double memory = 0.0;     ///< resident [bytes]
  double peak = 0.0;       ///< largest so far [bytes]
  int threads = 0;
  std::vector<std::string> libraries; ///< shared objects that are mapped, by file name, sorted
};

[[nodiscard]] Footprint footprint();

/// Which parts were built, what each cost, and what was left out, with the reasons.
///
/// Measures only when it is enabled; else it just does the work.
class BuildTrace
{
public:
  explicit BuildTrace(bool enabled);

  /// Does a part's work and books it. Parts do not nest.
  /// @return  what the work returns
  template <typename Work>
  auto build(const char* part, const char* why, Work work)
  {
    const Booking booking(*this, part, why);
    return work();
  }

  /// Books what is not built.
  void skip(const char* part, const char* why, bool leftOut = true);

  /// Tables of both and a line with the sums.
  void write(std::ostream& out) const;

private:
  struct Entry
  {
    std::string part;
    std::string why;
    double time = 0.0;   ///< [s]
    double memory = 0.0; ///< [bytes]
    int threads = 0;
    std::size_t libraries = 0;
  };

  // books what happened in its lifetime
  class Booking
  {
  public:
    Booking(BuildTrace& trace, const char* part, const char* why);
    ~Booking();
    Booking(const Booking&) = delete;
    Booking& operator=(const Booking&) = delete;

  private:
    BuildTrace& trace_;
    Entry entry_;
    double begin_ = 0.0; // [s]
    Footprint before_;
  };

  bool enabled_;
  std::vector<Entry> built_;
  std::vector<std::pair<const char*, const char*>> leftOut_;
};

} // namespace palp
