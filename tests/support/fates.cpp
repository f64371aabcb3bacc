#include "tests/support/fates.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <regex>

namespace palp::test
{
namespace
{

// one line, which begins with the file and ends with what to do
bool isSentence(const std::string& message, const std::string& file)
{
  constexpr std::size_t longest = 500;
  const bool printable = std::ranges::all_of(message, [](char c) { return c >= ' ' || c < 0; });
  return printable && message.size() <= longest && message.find(file) != message.npos;
}

// what the program says then
const std::string kOfACrash = "damaged or cut off: the reader crashed or exceeded its limits";

// made once, which takes longer than any search
const std::regex& expressionOf(const std::string& words)
{
  static std::map<std::string, std::regex> known;
  return known.try_emplace(words, words).first->second;
}

} // namespace

void judge(const Fuzzed& kind, int number, const Result& result, Fates& fates)
{
  const Fault* fault = result.fault;
  const std::string message = result.message;
  const auto wrong = [&](const std::string& what)
  {
    fates.wrong.push_back("number " + std::to_string(number) +
      (fault ? std::string(", ") + fault->name : "") + ": " + what + ": " + message);
  };
  ++fates.count;
  fates.longest = std::max(fates.longest, result.time);
  fates.peak = std::max(fates.peak, result.peak);
  const bool contained = !result.refused && result.reached == Stage::Reading && kind.read;
  fates.crashed += contained;
  fates.refused += result.refused;
  fates.read += result.reached == Stage::Done;
  if (!result.refused && !contained && result.reached != Stage::Done)
  {
    wrong("crash, limit or exception outside the reader");
  }
  if (result.refused && !isSentence(message, kind.file))
  {
    wrong("no sentence for people");
  }
  if (!fault)
  {
    return;
  }
  if (result.reached == Stage::Done && fault->refused)
  {
    wrong("taken");
  }
  if (result.refused || contained)
  {
    ++fates.known;
    const std::string told = contained ? kOfACrash : message;
    const bool isNamed = std::regex_search(told, expressionOf(fault->words));
    fates.named += isNamed;
    constexpr std::size_t most = 400;
    if (!isNamed && fates.unnamed.size() < most)
    {
      fates.unnamed.push_back(
        std::string(fault->name) + ": " + std::to_string(number) + ": " + message);
    }
  }
}

void expectGoodFates(const Fuzzed& kind, const Fates& fates)
{
  const double fraction = fates.known == 0 ? 1.0 : 1.0 * fates.named / fates.known;
  std::printf(
    "%-12s %6d files: %d read, %d refused, %d readers crashed; of %d known faults %.2f %% "
    "named; at most %.2f s, %.3f GB\n",
    kind.file.c_str(), fates.count, fates.read, fates.refused, fates.crashed, fates.known,
    100.0 * fraction, fates.longest, fates.peak);
  EXPECT_LE(fates.longest, kSlower * 5.0);
  if (!kSanitized)
  {
    EXPECT_LE(fates.peak, 1.0);
  }
  EXPECT_GE(fraction, 0.95);
  EXPECT_TRUE(fates.wrong.empty()) << fates.wrong.size() << " wrong, the first: " << fates.wrong[0];
  constexpr std::size_t shown = 5;
  for (std::size_t i = 0; fraction < 0.95 && i < std::min(shown, fates.unnamed.size()); ++i)
  {
    std::printf("  not named: %s\n", fates.unnamed[i].c_str());
  }
  if (const char* log = std::getenv("PALP_FUZZ_LOG"))
  {
    std::ofstream out(log, std::ios::app);
    for (const auto* list : { &fates.wrong, &fates.unnamed })
    {
      for (const std::string& line : *list)
      {
        out << kind.file << (list == &fates.wrong ? " WRONG " : " unnamed ") << line << '\n';
      }
    }
  }
}

} // namespace palp::test
