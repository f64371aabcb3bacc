#include "haptics/devices/serial/wooden_text.h"

#include <charconv>
#include <string_view>
#include <utility>

namespace palp
{
namespace
{

constexpr std::size_t kWords = 7;
constexpr std::size_t kReport = 2 * kWords;
constexpr std::string_view kZero = "0 0 0 0 0 0 0\n";

// seven numbers of 16 bits, and nothing else
bool parse(std::string_view line, MutableBytes into) noexcept
{
  std::array<std::int16_t, kWords> words{};
  const char* at = line.data();
  const char* end = at + line.size();
  for (std::int16_t& word : words)
  {
    while (at != end && *at == ' ')
    {
      ++at;
    }
    const auto [next, error] = std::from_chars(at, end, word);
    if (error != std::errc{})
    {
      return false;
    }
    at = next;
  }
  while (at != end && (*at == ' ' || *at == '\r'))
  {
    ++at;
  }
  if (at != end || into.size() < kReport)
  {
    return false;
  }
  for (std::size_t i = 0; i < kWords; ++i)
  {
    writeInt(into, 2 * i, words[i]);
  }
  return true;
}

} // namespace

WoodenText::WoodenText(std::unique_ptr<Transport> line)
  : line_(std::move(line))
{
}

IoResult WoodenText::read(MutableBytes into, std::chrono::microseconds timeout) noexcept
{
  using Clock = std::chrono::steady_clock;
  const auto deadline = Clock::now() + timeout;
  for (;;)
  {
    if (takeLine(into))
    {
      return { IoCode::Ok, kReport };
    }
    const auto left = std::max(std::chrono::microseconds(0),
      std::chrono::duration_cast<std::chrono::microseconds>(deadline - Clock::now()));
    filled_ = filled_ < text_.size() ? filled_ : 0; // no line is so long
    const IoResult result =
      line_->read(std::as_writable_bytes(std::span(text_).subspan(filled_)), left);
    if (result.code != IoCode::Ok)
    {
      return { result.code, 0 };
    }
    filled_ += result.size;
  }
}

// drops lines that are none of its board's
bool WoodenText::takeLine(MutableBytes into) noexcept
{
  for (;;)
  {
    const std::string_view text(text_.data(), filled_);
    const std::size_t end = text.find('\n');
    if (end == text.npos)
    {
      return false;
    }
    const bool whole = parse(text.substr(0, end), into);
    std::copy(text_.data() + end + 1, text_.data() + filled_, text_.data());
    filled_ -= end + 1;
    if (whole)
    {
      return true;
    }
  }
}

IoCode WoodenText::write(Bytes bytes) noexcept
{
  if (bytes.size() < 1 + kReport)
  {
    return IoCode::Gone;
  }
  std::array<char, kLongest + 1> line{};
  char* at = line.data();
  for (std::size_t i = 0; i < kWords; ++i) // behind the number of the report
  {
    at = std::to_chars(at, line.data() + line.size(), readInt<std::int16_t>(bytes, 1 + 2 * i)).ptr;
    *at++ = i + 1 < kWords ? ' ' : '\n';
  }
  return line_->write(std::as_bytes(std::span(line.data(), at)));
}

ZeroPacket woodenTextZero() noexcept
{
  ZeroPacket zero{ .size = kZero.size(), .from = 0, .to = kZero.size() };
  std::ranges::copy(std::as_bytes(std::span(kZero)), zero.bytes.begin());
  return zero;
}

} // namespace palp
