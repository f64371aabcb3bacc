#include "app/sweep/case_inputs.h"
#include "app/sweep/sweep_file.h"
#include "haptics/error.h"
#include "tests/support/process.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace palp
{
namespace
{

class SweepFile : public testing::Test
{
protected:
  [[nodiscard]] Sweep read(const std::string& rest) const
  {
    const std::filesystem::path file = folder_.path() / "sweep.json";
    std::ofstream(file) << R"({"palp_sweep": 1, "kind": "force", )" << rest << "}";
    return readSweepFile(file.string());
  }

private:
  test::TemporaryFolder folder_;
};

TEST_F(SweepFile, MultipliesGridZipAndSamples)
{
  const Sweep sweep = read(R"("grid": {"tip": ["sphere:5mm", "sphere:10mm"],
    "poisson": {"from": 0.3, "to": 0.5, "step": 0.1}},
    "zip": {"a": [1, 2], "b": ["x", "y"]},
    "latin_hypercube": {"count": 5, "seed": 1, "ranges": {"young": {"from": "1kPa", "to": "9kPa"}}})");
  EXPECT_EQ(sweep.count(), 2U * 3U * 2U * 5U);
  const std::vector<std::string> names{ "poisson", "tip", "a", "b", "young" };
  EXPECT_EQ(sweep.names(), names);
  const auto first = sweep.values(0);
  const auto last = sweep.values(sweep.count() - 1);
  EXPECT_EQ(std::vector(first.begin(), first.begin() + 4),
    (std::vector<std::string>{ "0.3", "sphere:5mm", "1", "x" }));
  EXPECT_EQ(std::vector(last.begin(), last.begin() + 4),
    (std::vector<std::string>{ "0.5", "sphere:10mm", "2", "y" }));
  EXPECT_EQ(sweep.values(5)[2], "2"); // the last axis changes first
}

TEST_F(SweepFile, SaysWhatIsWrongInOneSentence)
{
  for (const auto& [bad, word] :
    std::initializer_list<std::pair<const char*, const char*>>{ { R"("grids": {})", "unknown key" },
      { R"("grid": {"tip": []})", "empty list" },
      { R"("grid": {"tip": [[1]]})", "must be a value" },
      { R"("grid": {"tip": "sphere:1mm"})", "list of values" },
      { R"("fixed": {"tip": "sphere:1mm"}, "grid": {"tip": ["sphere:2mm"]})", "another part" },
      { R"("zip": {"a": [1, 2], "b": [1]})", "as many of each" },
      { R"("grid": {"a": {"from": "1mm", "to": "2cm", "count": 2}})", "another unit" },
      { R"("grid": {"a": {"from": "1mm", "to": "2mm", "step": "0.3mm"}})", "whole steps" },
      { R"("grid": {"a": {"from": "2mm", "to": "1mm", "count": 2}})", "more than" },
      { R"("grid": {"a": {"from": 0, "to": 1, "count": 2, "scale": "log"}})", "log scale" },
      { R"("grid": {"a": {"from": 1, "to": 2}})", "count" },
      { R"("grid": {"a": {"from": 1, "to": 2, "count": 2.5}})", "whole number" },
      { R"("latin_hypercube": {"count": 3, "seed": 1, "range": {}})", "unknown key" },
      { R"("latin_hypercube": {"count": 3, "ranges": {}})", "seed: must be a whole number, 0 to" },
      { R"("latin_hypercube": {"count": 3, "sed": 1, "ranges": {}})", "/sed: unknown key" },
      { R"("grid": {"a": {"from": 1, "to": 2, "cuont": 3}})", "/cuont: unknown key" },
      { R"("grid": {"a": {"from": 1, "to": 2, "count": 1}})", "write a list" },
      { R"("fixed": {"tip": "sphere:{r"})", "has { without }" },
      { R"("grid": {"a": {"from": 2, "to": 1, "count": 2}})", "more than \"from\"" },
      { R"("grid": )", "is no JSON, line 1, column " },
      { R"("grid": {"a": {"from": 1, "to": 2, "count": 9999}, "b": {"from": 1, "to": 2, "count": 9999}})",
        "cases" },
      { R"("fixed": {"tip": "a\nb"})", "control characters" },
      { R"("plots": [{"name": "../x", "x": "a", "y": "b"}])", "names no file" },
      { R"("plots": [{"name": "-x", "x": "a", "y": "b"}])", "names no file" },
      { R"("plots": [{"name": "x.png", "x": "a", "y": "b"}])", "names no file" },
      { R"("plots": [{"x": "a", "y": "b"}])", "names no file" },
      { R"("plots": [{"name": "p", "x": "a"}])", "/y: is missing" },
      { R"("plots": [{"name": "p", "x": "a", "y": "b"}, {"name": "p", "x": "a", "y": "c"}])",
        "another plot's" } })
  {
    try
    {
      (void)read(bad);
      FAIL() << bad;
    }
    catch (const Error& error)
    {
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
  }
}

TEST(CaseInputs, FillInNamesAndRefuseCircles)
{
  const SweepValues full = filledIn({ { "block", "{w}x{w}x{height}" }, { "w", "{side}" },
    { "side", "100" }, { "height", "50mm" } });
  EXPECT_EQ(full.at("block"), "100x100x50mm");
  const SweepValues braces = filledIn({ { "path", "{{a}/{name}.csv" }, { "name", "{{a{{" } });
  EXPECT_EQ(braces.at("path"), "{a}/{a{.csv");
  EXPECT_EQ(namesIn("{{a}/{name}.csv"), std::vector<std::string>{ "name" });
  for (const SweepValues& bad : { SweepValues{ { "a", "{a}" } },
         SweepValues{ { "a", "{b}" }, { "b", "{c}" }, { "c", "{a}" } } })
  {
    try
    {
      (void)filledIn(bad);
      FAIL();
    }
    catch (const Error& error)
    {
      EXPECT_NE(std::string(error.what()).find("circle"), std::string::npos) << error.what();
    }
  }
  EXPECT_THROW((void)filledIn({ { "a", "{nobody}" } }), Error);
}

// each of so many in two of the next would fill any memory
TEST(CaseInputs, RefuseValuesThatGrowTooLong)
{
  const auto name = [](std::size_t i) { return std::string("v").append(std::to_string(i)); };
  for (const std::size_t levels : { std::size_t{ 20 }, std::size_t{ 60 }, std::size_t{ 5000 } })
  {
    SweepValues values{ { name(levels), "x" } };
    for (std::size_t i = 0; i < levels; ++i)
    {
      const std::string next = std::string("{").append(name(i + 1)).append("}");
      values[name(i)] = levels > 1000 ? next : next + next;
    }
    EXPECT_THROW((void)filledIn(values), Error) << levels;
  }
  EXPECT_THROW((void)filledIn({ { "a", std::string(200'000, '1') } }), Error);
}

TEST(CaseInputs, NameACaseByContentNotByPlace)
{
  const SweepValues here{ { "path", "/here/a.csv" }, { "young", "5kPa" } };
  const SweepValues there{ { "path", "/there/b.csv" }, { "young", "5kPa" } };
  const std::string name = caseName("run", here, { { "/here/a.csv", "12" } });
  EXPECT_EQ(name.size(), 32U);
  EXPECT_EQ(name, caseName("run", there, { { "/there/b.csv", "12" } }));
  EXPECT_NE(name, caseName("run", here, { { "/here/a.csv", "13" } }));
  EXPECT_NE(name, caseName("force", here, { { "/here/a.csv", "12" } }));
}

} // namespace
} // namespace palp
