#pragma once

#include <charconv>
#include <cmath>
#include <filesystem>
#include <string>
#include <string_view>
#include <type_traits>

namespace palp
{

/// Lines of a text file and the words in them, for readers that tell where a file is wrong.
///
/// A line ends with LF, CR LF or CR; a mark of UTF-8 at the start is skipped.
class TextLines
{
public:
  /// @param comment  what begins a comment, to the end of its line; 0: nothing does
  /// @throws Error   BadFile: UTF-16
  explicit TextLines(const std::filesystem::path& file, char comment = 0);

  /// Goes to the next line that holds something; false at the end.
  bool next();

  /// What is left of the line, without blanks about it.
  [[nodiscard]] std::string_view rest() const noexcept
  {
    return rest_;
  }

  /// Takes the next word of the line; empty when there is none.
  std::string_view word() noexcept;

  /// Takes the next word as a number.
  /// @param what    that is expected, for the message
  /// @throws Error  BadFile: no such word, or no number; BadMesh: one that is infinite or none
  template <typename Number>
  Number number(const char* what)
  {
    const std::string_view text = word();
    Number value{};
    const char* begin = text.data() + (text.starts_with('+') ? 1 : 0);
    const char* const end = text.data() + text.size();
    const auto [stop, failure] = std::from_chars(begin, end, value);
    if (text.empty() || failure != std::errc{} || stop != end)
    {
      refuseWord(text, what);
    }
    if constexpr (std::is_floating_point_v<Number>)
    {
      if (!std::isfinite(value))
      {
        refuseNumber(text);
      }
    }
    return value;
  }

  /// Everything behind the line.
  [[nodiscard]] std::string_view behind() const noexcept
  {
    return text_;
  }

  /// @throws Error  BadFile: file and line, what is wrong, and what to do
  [[noreturn]] void refuse(const std::string& what) const;

  /// @throws Error  BadFile: the file ends before that
  [[noreturn]] void refuseEnd(const std::string& before) const;

  [[nodiscard]] int line() const noexcept
  {
    return line_;
  }

private:
  [[noreturn]] void refuseWord(std::string_view text, const char* what) const;
  [[noreturn]] void refuseNumber(std::string_view text) const;

  std::string file_;
  std::string whole_;
  std::string_view text_; // what follows
  std::string_view rest_;
  char comment_;
  int line_ = 0;
  bool ended_ = true; // the line has an end of its own
};

} // namespace palp
