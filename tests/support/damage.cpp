#include "tests/support/damage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <regex>

namespace palp::test
{
namespace
{

std::size_t below(Random& random, std::size_t n)
{
  return n < 2 ? 0 : std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
}

void overwrite(std::string& text, std::size_t at, const std::string& by)
{
  text.replace(at, std::min(by.size(), text.size() - at), by.substr(0, text.size() - at));
}

// a number in a text becomes one that few expect
void changeNumber(std::string& text, std::size_t at, Random& random)
{
  static const std::array<std::string, 14> kNumbers{ "-1", "0", "1", "2", "99999999", "4294967296",
    "-9223372036854775808", "1e308", "1e30", "-1e9", "nan", "inf", "", "x" };
  const std::size_t begin = text.find_first_of("0123456789", at);
  if (begin != text.npos)
  {
    const std::size_t end = text.find_first_not_of("0123456789.eE+-", begin);
    text.replace(
      begin, std::min(end, text.size()) - begin, kNumbers[below(random, kNumbers.size())]);
  }
}

void damage(std::string& text, const Fuzzed& kind, Random& random)
{
  static const std::array<std::string, 12> kBytes{ bytesOf(0), bytesOf(-1), bytesOf(0x7fffffff),
    bytesOf(1e30F), bytesOf(std::nanf("")), bytesOf(1e308), std::string(1, '\0'), "\xff", "\x7f",
    " ", "\n", "-" };
  if (text.empty())
  {
    return;
  }
  // the head of a file is where damage tells most
  const std::size_t reach =
    below(random, 2) == 0 ? text.size() : std::min<std::size_t>(text.size(), 400);
  const std::size_t at = below(random, reach);
  const std::size_t length = 1 + below(random, std::min<std::size_t>(text.size() - at, 64));
  const std::string& other = kind.whole[below(random, kind.whole.size())];
  switch (below(random, 9))
  {
    case 0:
      text[at] = static_cast<char>(text[at] ^ (1 << below(random, 8)));
      break;
    case 1:
      text[at] = static_cast<char>(below(random, 256));
      break;
    case 2:
      overwrite(text, at, kBytes[below(random, kBytes.size())]);
      break;
    case 3:
      text.erase(at, length);
      break;
    case 4:
      text.insert(at, text.substr(below(random, text.size()), length));
      break;
    case 5:
      changeNumber(text, at, random);
      break;
    case 6:
      text.resize(at);
      break;
    case 7:
      text.resize(at);
      text += other.substr(std::min(other.size(), at + below(random, 8)));
      break;
    default:
      text.insert(at, std::string(length * 100, text[at]));
      break;
  }
}

// where a pattern matches, and what stands there then
struct Place
{
  std::size_t begin;
  std::size_t length;
  std::string text;
};

std::vector<Place> placesIn(
  const std::string& whole, const std::regex& expression, const std::string& by)
{
  std::vector<Place> places;
  for (std::sregex_iterator match(whole.begin(), whole.end(), expression), end; match != end;
       ++match)
  {
    places.push_back({ static_cast<std::size_t>(match->position()),
      static_cast<std::size_t>(match->length()), match->format(by) });
  }
  return places;
}

} // namespace

Damaged damagedFile(const Fuzzed& kind, int number)
{
  Random random(static_cast<unsigned>(number));
  const std::string& whole = kind.whole[below(random, kind.whole.size())];
  const auto stored = [&](const std::string& text) { return kind.pack ? kind.pack(text) : text; };
  if (below(random, 5) < 2)
  {
    const Fault& fault = kind.faults[below(random, kind.faults.size())];
    if (auto text = fault.make(fault.packed ? stored(whole) : whole, random))
    {
      return { fault.packed ? *text : stored(*text), &fault };
    }
  }
  const bool within = below(random, 2) == 0;
  std::string text = within ? whole : stored(whole);
  for (std::size_t i = 1 + below(random, 3); i > 0; --i)
  {
    damage(text, kind, random);
  }
  return { within ? stored(text) : text };
}

Fault cutOff(std::string words, std::size_t shortest, bool refused)
{
  return { "cut off",
    [shortest](const std::string& whole, Random& random) -> std::optional<std::string>
    {
      // a number that lost its last digits is one still
      const std::size_t last = whole.find_last_of(" \t\r\n", whole.find_last_not_of(" \t\r\n"));
      if (last <= shortest)
      {
        return std::nullopt;
      }
      return whole.substr(0, shortest + below(random, last - shortest));
    },
    std::move(words), refused };
}

Fault replaced(const char* name, const std::string& pattern, const std::string& by,
  std::string words, bool refused)
{
  // looked for once in each whole file, which takes longer than most readers
  const auto known = std::make_shared<std::map<std::string, std::vector<Place>>>();
  return { name,
    [expression = std::regex(pattern), by, known](
      const std::string& whole, Random& random) -> std::optional<std::string>
    {
      const auto [at, isNew] = known->try_emplace(whole);
      if (isNew)
      {
        at->second = placesIn(whole, expression, by);
      }
      if (at->second.empty())
      {
        return std::nullopt;
      }
      const Place& place = at->second[below(random, at->second.size())];
      return std::string(whole).replace(place.begin, place.length, place.text);
    },
    std::move(words), refused };
}

Fault overwritten(const char* name, std::size_t at, std::size_t step, std::size_t count,
  const std::string& by, std::string words, bool refused)
{
  return { name,
    [=](const std::string& whole, Random& random) -> std::optional<std::string>
    {
      const std::size_t position = at + step * below(random, count);
      if (position + by.size() > whole.size())
      {
        return std::nullopt;
      }
      std::string text = whole;
      overwrite(text, position, by);
      return text;
    },
    std::move(words), refused };
}

Fault foreign(const std::string& content, std::string words)
{
  return { "another kind of file", [content](const std::string&, Random&) { return content; },
    std::move(words) };
}

} // namespace palp::test
