#include "haptics/files/input_text.h"

#include "haptics/error.h"

#include <algorithm>
#include <fstream>
#include <system_error>
#include <vector>

namespace palp
{

std::string readText(const std::filesystem::path& file, const std::string& what)
{
  const auto refuse = [&](const std::string& why)
  { throw Error(ErrorCode::BadFile, printable(file.string()) + ": " + why); };
  std::error_code unknown; // opening says why
  const auto kind = std::filesystem::status(file, unknown).type();
  using Kind = std::filesystem::file_type;
  if (kind == Kind::directory)
  {
    refuse("a folder; give " + what + " in it");
  }
  if (kind == Kind::character || kind == Kind::block || kind == Kind::socket)
  {
    refuse("a device, not a file; give " + what);
  }
  std::ifstream stream(file, std::ios::binary);
  constexpr std::size_t most = 512U << 20;
  std::string text;
  std::vector<char> piece(1 << 16);
  while (stream)
  {
    stream.read(piece.data(), static_cast<std::streamsize>(piece.size()));
    text.append(piece.data(), static_cast<std::size_t>(stream.gcount()));
    if (text.size() > most)
    {
      refuse("larger than 512 MB; give less of it");
    }
  }
  if (!stream.eof())
  {
    refuse("cannot be read; check name and permission");
  }
  return text;
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

} // namespace palp
