#include "haptics/files/input_text.h"

#include "haptics/error.h"
#include "haptics/files/descriptor.h"

#include <algorithm>
#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <unistd.h>

namespace palp
{
namespace
{

constexpr std::size_t kMost = 512U << 20; // [bytes]

std::string whatIsNoFile(const struct stat& is, const std::string& what)
{
  if (S_ISDIR(is.st_mode))
  {
    return "a folder; give " + what + " in it";
  }
  const bool isDevice = S_ISCHR(is.st_mode) || S_ISBLK(is.st_mode) || S_ISSOCK(is.st_mode);
  return isDevice ? "a device, not a file; give " + what : "";
}

// whether there is anything to read, or the end; a pipe waits for who writes into it
bool hasMore(const Descriptor& in)
{
  constexpr int kPatience = 5000; // [ms]
  pollfd wanted{ .fd = in.get(), .events = POLLIN, .revents = 0 };
  return poll(&wanted, 1, kPatience) > 0;
}

} // namespace

std::string readText(const std::filesystem::path& file, const std::string& what)
{
  const auto refuse = [&](const std::string& why)
  { throw Error(ErrorCode::BadFile, printable(file.string()) + ": " + why); };
  struct stat is = {};
  (void)stat(file.c_str(), &is); // opening says why
  if (const std::string why = whatIsNoFile(is, what); !why.empty())
  {
    refuse(why);
  }
  const Descriptor in(open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  std::string text;
  std::vector<char> piece(1 << 16);
  text.reserve(std::min(static_cast<std::size_t>(is.st_size), kMost));
  for (ssize_t count = 1; count > 0;)
  {
    if (std::max(text.size(), static_cast<std::size_t>(is.st_size)) > kMost)
    {
      refuse("larger than 512 MB; give less of it");
    }
    if (S_ISFIFO(is.st_mode) && !hasMore(in))
    {
      refuse("a pipe into which nothing is written; give a file");
    }
    count = read(in.get(), piece.data(), piece.size());
    if (count < 0)
    {
      refuse("cannot be read; check name and permission");
    }
    text.append(piece.data(), static_cast<std::size_t>(count));
  }
  constexpr std::string_view byteOrderMark = "\xEF\xBB\xBF"; // as spreadsheets begin a CSV file
  return text.starts_with(byteOrderMark) ? text.substr(byteOrderMark.size()) : text;
}

std::string shortened(const std::string& text)
{
  constexpr std::size_t most = 200; // [bytes]
  return printable(text.size() <= most ? text : text.substr(0, most) + "...");
}

std::string inQuotes(std::string_view text)
{
  constexpr std::size_t most = 40; // [bytes]
  const bool whole = text.size() <= most;
  return std::string("'")
    .append(printable(std::string(text.substr(0, most))))
    .append(whole ? "'" : "...'");
}

std::string printable(std::string text)
{
  for (std::size_t i = 0; i < text.size(); ++i)
  {
    const auto byte = static_cast<unsigned char>(text[i]);
    const bool twoBytes = byte == 0xC2 && i + 1 < text.size() && // U+0080 to U+009F
      static_cast<unsigned char>(text[i + 1]) < 0xA0;
    if (byte < ' ' || byte == 0x7F || twoBytes)
    {
      text[i] = '?';
    }
  }
  return text;
}

std::string counted(std::size_t number, const std::string& one, const std::string& many)
{
  return std::to_string(number) + ' ' + (number == 1 ? one : many.empty() ? one + 's' : many);
}

std::string_view trimmed(std::string_view text)
{
  constexpr const char* blanks = " \t\r";
  const std::size_t first = std::min(text.find_first_not_of(blanks), text.size());
  return text.substr(first, text.find_last_not_of(blanks) + 1 - first);
}

std::string lowered(std::string text)
{
  std::ranges::transform(text, text.begin(),
    [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return text;
}

std::vector<std::string_view> split(std::string_view text, char separator)
{
  std::vector<std::string_view> parts;
  for (std::size_t begin = 0; begin <= text.size();)
  {
    const std::size_t end = std::min(text.find(separator, begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

} // namespace palp
