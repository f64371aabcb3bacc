#include "tests/pipeline/formats/fuzzed_parts.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <iterator>
#include <stdexcept>

namespace palp::test
{
namespace
{

std::vector<FuzzedGroup> fuzzedGroups()
{
  std::vector<FuzzedGroup> all = fuzzedMeshes();
  std::ranges::move(fuzzedImages(), std::back_inserter(all));
  return all;
}

std::vector<std::string> fuzzedFiles()
{
  std::vector<std::string> all;
  for (const FuzzedGroup& group : fuzzedGroups())
  {
    all.insert(all.end(), group.files.begin(), group.files.end());
  }
  return all;
}

Fuzzed kindOf(const std::string& file)
{
  for (const FuzzedGroup& group : fuzzedGroups())
  {
    if (std::ranges::find(group.files, file) != group.files.end())
    {
      const std::vector<Fuzzed> kinds = group.make();
      EXPECT_EQ(kinds.size(), group.files.size());
      return *std::ranges::find(kinds, file, &Fuzzed::file);
    }
  }
  throw std::runtime_error("no kind of file " + file);
}

// all are taken as the program does: the answer of palp-read unpacked, repaired, made a Surface
// with its box tree, and pressed
class Fuzz : public testing::TestWithParam<std::string>
{
};
INSTANTIATE_TEST_SUITE_P(Kinds, Fuzz, testing::ValuesIn(fuzzedFiles()),
  [](const auto& which) { return nameOf(which.param); });

TEST_P(Fuzz, EndsAsASurfaceOrATrueSentence)
{
  const Fuzzed kind = kindOf(GetParam());
  constexpr std::size_t memory = 832U << 20; // of palp-read for a small file, and this program
  constexpr double time = kSlower * 4.0;     // of palp-read for a small file [s]
#ifdef PALP_SLOW
  const int count = fuzzCount();
#else // the sanitizer, which takes many times as long for each, sees the first of all
  const int count = fuzzCount(kSanitized ? 600 : 10'000);
#endif
  expectGoodFates(kind, fuzz(kind, count, memory, time));
}

} // namespace
} // namespace palp::test
