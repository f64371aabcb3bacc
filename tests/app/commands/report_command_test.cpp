#include "tests/app/commands/quick_report.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <regex>

namespace palp
{
namespace
{

using namespace test;
using nlohmann::json;

const std::vector<std::string> kParts{ "force_error", "surface_error", "tissue_error",
  "organ_error", "claims", "curvature", "inclination", "profiles", "extents", "forces", "dynamics",
  "scaling", "stability", "servo" };

TEST_F(QuickReport, IsInterruptedWithAPageAndGoesOnFromThere)
{
  EXPECT_EQ(interrupted_, 5);
  EXPECT_NE(interruptedPage_.find("Not finished"), std::string::npos);
  EXPECT_NE(interruptedPage_.find("id=\"force_error\""), std::string::npos);
  EXPECT_EQ(finished_.code, 0) << finished_.err;
  EXPECT_EQ(readAll(out() / "force_error.json"), firstPart_); // not measured anew
  EXPECT_EQ(readAll(out() / "report.html").find("Not finished"), std::string::npos);
}

TEST_F(QuickReport, PageIsCompleteAndHoldsItself)
{
  const std::string page = readAll(out() / "report.html");
  for (const std::string& part : kParts)
  {
    EXPECT_NE(page.find("<section id=\"" + part + "\">"), std::string::npos) << part;
  }
  const std::regex link("href=\"([^\"]*)\"");
  std::size_t files = 0;
  for (std::sregex_iterator i(page.begin(), page.end(), link), end; i != end; ++i)
  {
    const std::string target = (*i)[1];
    if (target.starts_with('#'))
    {
      EXPECT_NE(page.find("id=\"" + target.substr(1) + "\""), std::string::npos) << target;
      continue;
    }
    EXPECT_TRUE(std::filesystem::exists(out() / target)) << target;
    ++files;
  }
  EXPECT_GT(files, 20U);
  for (const char* outside : { "src=", "<script", "url(", "@import", "https://", "href=\"http" })
  {
    EXPECT_EQ(page.find(outside), std::string::npos) << outside;
  }
  for (const char* word : { "processor", "cores", "compiler", "version", "date" })
  {
    EXPECT_NE(page.find(word), std::string::npos) << word;
  }
  const auto count = [&](const std::string& text)
  {
    std::size_t found = 0;
    for (std::size_t at = page.find(text); at != std::string::npos; at = page.find(text, at + 1))
    {
      ++found;
    }
    return found;
  };
  EXPECT_GE(count("<figure"), kParts.size() - 3); // the errors have several, the claims have none
  EXPECT_EQ(count("<figure"), count("<figcaption"));
  EXPECT_EQ(page.find("nan"), std::string::npos);
  EXPECT_EQ(page.find("<div class=\"legend\"></div>"), std::string::npos); // a figure of nothing
}

TEST_F(QuickReport, JsonHoldsTheNumbersOfTheCsv)
{
  std::size_t tables = 0;
  for (const std::string& part : kParts)
  {
    const json section = json::parse(readAll(out() / (part + ".json")));
    for (const json& table : section.at("tables"))
    {
      const Table csv = readTable(out() / (table.at("name").get<std::string>() + ".csv"));
      EXPECT_EQ(table.at("columns").get<std::vector<std::string>>(), csv.columns);
      ASSERT_EQ(table.at("rows").size(), csv.rows.size());
      for (std::size_t i = 0; i < csv.rows.size(); ++i)
      {
        for (std::size_t k = 0; k < csv.columns.size(); ++k)
        {
          const json& cell = table.at("rows")[i][k];
          if (cell.is_number())
          {
            EXPECT_EQ(std::stod(csv.rows[i][k]), cell.get<double>());
          }
        }
      }
      ++tables;
    }
  }
  EXPECT_GT(tables, 15U);
  EXPECT_EQ(json::parse(readAll(out() / "machine.json")).at("effort"), "quick");
}

TEST_F(QuickReport, AnswersEveryClaimOfThePaper)
{
  const Table table = readTable(out() / "claims.csv");
  for (const char* claim : { "Fig. 3", "Eq. (7)", "Fig. 7", "Fig. 8", "Fig. 12(a)", "Fig. 12(b)",
         "Fig. 12(c)", "Fig. 13", "Fig. 14", "Fig. 15(a)", "Fig. 15(b)", "Fig. 16", "Table 1" })
  {
    EXPECT_TRUE(
      std::ranges::any_of(table.rows, [&](const auto& row) { return row[0].starts_with(claim); }))
      << claim;
  }
  for (const auto& row : table.rows)
  {
    EXPECT_TRUE(std::ranges::none_of(row, &std::string::empty)) << row[0];
  }
}

TEST_F(QuickReport, FolderOfAnotherReportIsRefusedInOneSentence)
{
  for (const auto& [arguments, reason] :
    { std::pair{ "--quick --out " + out().string(), "--resume" },
      std::pair{ "--resume --out " + out().string(), "other settings (quick" },
      std::pair{ std::string("--quick --out /dev/null/report"), "cannot be written" } })
  {
    const test::Finished refused = test::runCommand(PALP_PROGRAM " report " + arguments);
    EXPECT_EQ(refused.code, 2) << arguments;
    EXPECT_NE(refused.err.find(reason), std::string::npos) << refused.err;
    EXPECT_EQ(test::sentences(refused).size(), 1U) << refused.err;
  }
}

TEST(ReportCommand, LeavesAloneWhatIsOfNoReport)
{
  const test::TemporaryFolder folder;
  std::ofstream(folder.path() / "curvature.csv") << "of an experiment";
  for (const char* how : { "", "--overwrite", "--resume" })
  {
    const test::Finished refused = test::runCommand(
      PALP_PROGRAM " report --quick " + std::string(how) + " --out " + folder.path().string());
    EXPECT_EQ(refused.code, 2) << how;
    EXPECT_NE(refused.err.find("holds curvature.csv"), std::string::npos) << refused.err;
  }
  EXPECT_EQ(readAll(folder.path() / "curvature.csv"), "of an experiment");
}

TEST(ReportCommand, SaysInItsOwnWordsWhatIsNoReport)
{
  const test::TemporaryFolder folder;
  std::ofstream(folder.path() / "machine.json")
    << R"({"effort": 7, "version": [], "processor": {}})";
  const test::Finished refused =
    test::runCommand(PALP_PROGRAM " report --quick --resume --out " + folder.path().string());
  EXPECT_EQ(refused.code, 2);
  EXPECT_EQ(refused.err.find("json.exception"), std::string::npos) << refused.err;
  EXPECT_NE(refused.err.find("other settings"), std::string::npos) << refused.err;
}

// programs of others told both forces
TEST_F(QuickReport, TissueThatIsNotEvenIsFeltByItsEnergy)
{
  const json section = json::parse(readAll(out() / "tissue_error.json"));
  std::size_t seen = 0;
  for (const json& row : section.at("tables").at(0).at("rows"))
  {
    const auto method = row.at(1).get<std::string>();
    const double error = row.at(3).get<double>();
    EXPECT_GT(row.at(2).get<double>(), 0.0);
    seen += method.find("energy") != std::string::npos ? 1 : 0;
    if (method.ends_with("energy of the nodule") || method.starts_with("finite elements"))
    {
      EXPECT_LT(error, 2.0) << row;
    }
    else if (method.ends_with("energy of the map"))
    {
      EXPECT_LT(error, 5.0) << row;
    }
    else
    {
      EXPECT_GT(error, 5.0) << row;
    }
  }
  EXPECT_EQ(seen, 5U);
}

} // namespace
} // namespace palp
