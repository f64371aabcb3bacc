#include "pipeline/formats/dicom/character_set.h"

#include "haptics/files/input_text.h"

#include <algorithm>
#include <array>
#include <unicode/unistr.h>

namespace palp
{
namespace
{

constexpr char kEscape = '\x1b';
constexpr const char* kUsual = "ISO-8859-1";

// terms without "ISO_IR " or "ISO 2022 IR ", and converters of ICU, which know ASCII, too
struct Set
{
  std::string_view term;
  const char* converter;
};
constexpr std::array kSets{ Set{ "100", "ISO-8859-1" }, Set{ "101", "ISO-8859-2" },
  Set{ "109", "ISO-8859-3" }, Set{ "110", "ISO-8859-4" }, Set{ "144", "ISO-8859-5" },
  Set{ "127", "ISO-8859-6" }, Set{ "126", "ISO-8859-7" }, Set{ "138", "ISO-8859-8" },
  Set{ "148", "ISO-8859-9" }, Set{ "203", "ISO-8859-15" }, Set{ "166", "TIS-620" },
  Set{ "13", "Shift_JIS" }, Set{ "192", "UTF-8" }, Set{ "GB18030", "GB18030" },
  Set{ "GBK", "GBK" } };

// what stands behind an escape switches to; of seven bits, ISO-2022-JP has the sequence itself
struct Switch
{
  std::string_view sequence;
  const char* converter; // null: that of before, of which the lower half is ASCII
  bool isOfSevenBits = false;
};
constexpr std::array kSwitches{ Switch{ "$B", "ISO-2022-JP", true },
  Switch{ "$(D", "ISO-2022-JP-1", true }, Switch{ "$)C", "EUC-KR" }, Switch{ "$)A", "GB2312" },
  Switch{ "(B", nullptr }, Switch{ "(J", nullptr }, Switch{ ")I", "Shift_JIS" },
  Switch{ "-A", "ISO-8859-1" }, Switch{ "-B", "ISO-8859-2" }, Switch{ "-C", "ISO-8859-3" },
  Switch{ "-D", "ISO-8859-4" }, Switch{ "-L", "ISO-8859-5" }, Switch{ "-G", "ISO-8859-6" },
  Switch{ "-F", "ISO-8859-7" }, Switch{ "-H", "ISO-8859-8" }, Switch{ "-M", "ISO-8859-9" },
  Switch{ "-b", "ISO-8859-15" }, Switch{ "-T", "TIS-620" } };

bool isUtf8(std::string_view text)
{
  std::size_t more = 0; // bytes of the character that has begun
  for (const char c : text)
  {
    const auto byte = static_cast<unsigned char>(c);
    const bool goesOn = (byte & 0xC0U) == 0x80;
    if (goesOn != (more > 0) || byte >= 0xF8)
    {
      return false;
    }
    more = goesOn ? more - 1 : byte < 0xC0 ? 0 : byte < 0xE0 ? 1 : byte < 0xF0 ? 2 : 3;
  }
  return more == 0;
}

std::string converted(std::string_view text, const char* converter)
{
  constexpr char16_t kUnknown = 0xFFFD;
  const auto by = [text](const char* name)
  { return icu::UnicodeString(text.data(), static_cast<int32_t>(text.size()), name); };
  icu::UnicodeString wide = by(converter);
  if (wide.isBogus() || (wide.isEmpty() && !text.empty()) || wide.indexOf(kUnknown) >= 0)
  {
    wide = by(kUsual);
  }
  std::string result;
  wide.toUTF8String(result);
  return result;
}

// the first term's, to which an empty one adds nothing
const char* converterOf(std::string_view characterSet)
{
  std::string_view term = trimmed(characterSet.substr(0, characterSet.find('\\')));
  for (const std::string_view prefix : { "ISO_IR ", "ISO 2022 IR " })
  {
    term.remove_prefix(term.starts_with(prefix) ? prefix.size() : 0);
  }
  const auto* found = std::ranges::find(kSets, term, &Set::term);
  return found != kSets.end() ? found->converter : kUsual;
}

std::string switched(std::string_view text, const char* converter)
{
  std::string result;
  std::size_t begin = text.find(kEscape);
  result += converted(text.substr(0, begin), converter);
  while (begin < text.size())
  {
    const std::size_t end = std::min(text.find(kEscape, begin + 1), text.size());
    std::string_view part = text.substr(begin, end - begin);
    begin = end;
    const auto* to = std::ranges::find_if(
      kSwitches, [&](const Switch& one) { return part.substr(1).starts_with(one.sequence); });
    if (to == kSwitches.end())
    {
      result += converted(part.substr(1), converter);
      continue;
    }
    if (!to->isOfSevenBits)
    {
      part.remove_prefix(1 + to->sequence.size());
      converter = to->converter != nullptr ? to->converter : converter;
    }
    result += converted(part, to->isOfSevenBits ? to->converter : converter);
  }
  return result;
}

} // namespace

std::string inUtf8(std::string_view text, std::string_view characterSet)
{
  const char* converter = converterOf(characterSet);
  const bool isChinese = std::string_view(converter).starts_with("GB");
  if (text.find(kEscape) != text.npos)
  {
    return switched(text, converter);
  }
  return isUtf8(text) && !isChinese ? std::string(text) : converted(text, converter);
}

} // namespace palp
