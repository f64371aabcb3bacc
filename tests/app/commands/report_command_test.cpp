#include "tests/support/process.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <thread>
#include <unistd.h>

namespace palp
{
namespace
{

using nlohmann::json;
using test::readAll;

struct Table
{
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;

  [[nodiscard]] const std::string& at(std::size_t row, const std::string& column) const
  {
    const auto found = std::ranges::find(columns, column);
    EXPECT_NE(found, columns.end()) << column;
    return rows[row][static_cast<std::size_t>(found - columns.begin())];
  }
  [[nodiscard]] double number(std::size_t row, const std::string& column) const
  {
    return std::stod(at(row, column));
  }
};

// RFC 4180 without line breaks in fields
std::vector<std::string> fieldsOf(const std::string& line)
{
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (const char c : line)
  {
    if (c == '"')
    {
      quoted = !quoted;
    }
    else if (c == ',' && !quoted)
    {
      fields.emplace_back();
    }
    else
    {
      fields.back() += c;
    }
  }
  return fields;
}

Table readTable(const std::filesystem::path& file)
{
  std::istringstream in(readAll(file));
  Table table;
  for (std::string line; std::getline(in, line);)
  {
    auto fields = fieldsOf(line);
    if (table.columns.empty())
    {
      table.columns = std::move(fields);
      continue;
    }
    EXPECT_EQ(fields.size(), table.columns.size()) << file << ": " << line;
    table.rows.push_back(std::move(fields));
  }
  EXPECT_FALSE(table.rows.empty()) << file;
  return table;
}

// starts the program, interrupts it once a file is there, and gives its exit code
int interruptOnce(const std::string& folder, const std::filesystem::path& awaited)
{
  const pid_t child = fork();
  if (child == 0)
  {
    const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
    dup2(nowhere, STDERR_FILENO);
    execl(PALP_PROGRAM, "palp", "report", "--quick", "--out", folder.c_str(), nullptr);
    _exit(127);
  }
  int status = 0;
  while (!std::filesystem::exists(awaited) && waitpid(child, &status, WNOHANG) == 0)
  {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  kill(child, SIGINT);
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

// one report for all tests: interrupted after its first part, then gone on with
class QuickReport : public ::testing::Test
{
protected:
  static void SetUpTestSuite()
  {
    folder_ = std::make_unique<test::TemporaryFolder>();
    interrupted_ = interruptOnce(out().string(), out() / "force_error.json");
    interruptedPage_ = readAll(out() / "report.html");
    firstPart_ = readAll(out() / "force_error.json");
    finished_ = test::runCommand(PALP_PROGRAM " report --quick --resume --out " + out().string());
  }

  static void TearDownTestSuite()
  {
    folder_.reset();
  }

  static std::filesystem::path out()
  {
    return folder_->path() / "report";
  }

  static inline std::unique_ptr<test::TemporaryFolder> folder_;
  static inline int interrupted_ = 0;
  static inline std::string interruptedPage_;
  static inline std::string firstPart_;
  static inline test::Finished finished_{};
};

const std::vector<std::string> kParts{ "force_error", "surface_error", "claims", "curvature",
  "inclination", "profiles", "extents", "forces", "dynamics", "scaling", "stability", "servo" };
const std::vector<std::string> kRegimes{ "shallow", "JND limit", "depth = R" };

TEST_F(QuickReport, IsInterruptedWithAPageAndGoesOnFromThere)
{
  EXPECT_EQ(interrupted_, 5);
  EXPECT_NE(interruptedPage_.find("Not finished"), std::string::npos);
  EXPECT_NE(interruptedPage_.find("id=\"force_error\""), std::string::npos);
  EXPECT_EQ(finished_.code, 0) << finished_.err;
  EXPECT_EQ(readAll(out() / "force_error.json"), firstPart_); // not measured anew
  EXPECT_EQ(readAll(out() / "report.html").find("Not finished"), std::string::npos);
}

TEST_F(QuickReport, HasTheStatedColumns)
{
  const auto head = [](const char* name)
  {
    const std::string text = readAll(out() / name);
    return text.substr(0, text.find('\n'));
  };
  EXPECT_EQ(head("error_vs_time.csv"),
    "method,setting,regime,time_us,error_max_pct,error_rms_pct,error_local_pct");
  EXPECT_EQ(
    head("surface_error_vs_time.csv"), "method,setting,regime,time_us,error_max_mm,error_rms_mm");
}

TEST_F(QuickReport, HasEveryMethodInEveryRegimeWithFiniteFigures)
{
  const Table table = readTable(out() / "error_vs_time.csv");
  std::map<std::string, std::set<std::string>> found; // method and resolution to regimes
  for (std::size_t i = 0; i < table.rows.size(); ++i)
  {
    const std::string& setting = table.at(i, "setting");
    if (setting.starts_with("sphere R6 H30; against neo-hookean"))
    {
      found[table.at(i, "method") + setting.substr(setting.rfind(';'))].insert(
        table.at(i, "regime"));
    }
    EXPECT_GT(table.number(i, "time_us"), 0.0);
    for (const char* error : { "error_max_pct", "error_rms_pct", "error_local_pct" })
    {
      EXPECT_GE(table.number(i, error), 0.0);
      EXPECT_LT(table.number(i, error), 1000.0);
    }
    EXPECT_LE(table.number(i, "error_rms_pct"), table.number(i, "error_max_pct") * (1.0 + 1e-9));
    EXPECT_LE(table.number(i, "error_max_pct"), table.number(i, "error_local_pct") * (1.0 + 1e-9));
  }
  std::vector<std::string> wanted;
  for (const char* law : { "paper law", "exact half-space", "corrected law", "table" })
  {
    wanted.push_back(law + std::string("; against neo-hookean"));
  }
  for (const char* stepper : { "mass-spring", "mass-spring-volume", "corotational" })
  {
    wanted.push_back(stepper + std::string("; 1600 vertices"));
  }
  for (const char* energy : { "linear", "corotated", "neo-hookean" })
  {
    for (const char* size : { "1", "2", "4", "8", "16" })
    {
      wanted.push_back("finite elements " + std::string(energy) + "; h R/" + size);
    }
  }
  for (const std::string& method : wanted)
  {
    EXPECT_EQ(found[method], std::set(kRegimes.begin(), kRegimes.end())) << method;
  }

  const Table surface = readTable(out() / "surface_error_vs_time.csv");
  std::set<std::string> methods;
  for (std::size_t i = 0; i < surface.rows.size(); ++i)
  {
    methods.insert(surface.at(i, "method"));
    EXPECT_TRUE(surface.at(i, "setting").starts_with("sphere R10 H50; "));
    EXPECT_GT(surface.number(i, "time_us"), 0.0);
    EXPECT_LE(surface.number(i, "error_rms_mm"), surface.number(i, "error_max_mm"));
    EXPECT_LT(surface.number(i, "error_max_mm"), 10.0);
  }
  EXPECT_EQ(methods, (std::set<std::string>{ "finite elements", "fitted Bezier", "paper Bezier" }));
}

// against the same material, where only the mesh differs
TEST_F(QuickReport, FiniteElementsConvergeWithTheirResolution)
{
  constexpr double kCorotatedReference = 1.5; // [%] uncertainty of that reference
  const Table table = readTable(out() / "error_vs_time.csv");
  for (const std::string energy : { "linear", "corotated", "neo-hookean" })
  {
    for (const std::string& regime : kRegimes)
    {
      std::vector<double> errors; // coarse to fine
      for (const char* size : { "1", "2", "4", "8", "16" })
      {
        for (std::size_t i = 0; i < table.rows.size(); ++i)
        {
          if (table.at(i, "setting") == "sphere R6 H30; against " + energy + "; h R/" + size &&
            table.at(i, "method") == "finite elements " + energy && table.at(i, "regime") == regime)
          {
            errors.push_back(table.number(i, "error_rms_pct"));
          }
        }
      }
      ASSERT_EQ(errors.size(), 5U) << energy << ", " << regime;
      for (std::size_t i = 1; i < errors.size(); ++i)
      {
        const bool known = energy != "corotated" || errors[i] > kCorotatedReference;
        EXPECT_TRUE(!known || errors[i] < errors[i - 1]) << energy << ", " << regime << ", " << i;
      }
      EXPECT_LT(errors.back(), energy == "corotated" ? kCorotatedReference : 0.2);
    }
  }
}

// Eq. (4) and the table of the independent program, by hand
TEST_F(QuickReport, ErrorsAreThoseOfEquationFourAgainstTheReference)
{
  const double modulus = 50e3 / (1.0 - 0.33 * 0.33);
  double most = 0.0;
  double worst = 0.0;
  double local = 0.0;
  std::istringstream in(readAll(PALP_SOURCE_DIR "/data/reference/fig15_sphere_R6__NH_h0.25.csv"));
  for (std::string line; std::getline(in, line);)
  {
    if (line.starts_with('#') || line.starts_with("delta"))
    {
      continue;
    }
    const double depth = std::stod(line);
    const double force = std::stod(line.substr(line.find(',') + 1));
    if (depth > 0.55 * 6e-3 && depth < 6.1e-3)
    {
      const double off =
        std::abs(4.0 / 3.0 * modulus * std::sqrt(6e-3) * std::pow(depth, 1.5) - force);
      most = std::max(most, force);
      worst = std::max(worst, off);
      local = std::max(local, 100.0 * off / force);
    }
  }
  const Table table = readTable(out() / "error_vs_time.csv");
  std::size_t row = 0;
  while (row < table.rows.size() &&
    !(table.at(row, "method") == "paper law" &&
      table.at(row, "setting") == "sphere R6 H30; against neo-hookean" &&
      table.at(row, "regime") == "depth = R"))
  {
    ++row;
  }
  ASSERT_LT(row, table.rows.size());
  EXPECT_NEAR(table.number(row, "error_max_pct"), 100.0 * worst / most, 1e-6);
  EXPECT_NEAR(table.number(row, "error_local_pct"), local, 1e-6);
}

TEST_F(QuickReport, ParetoFrontIsWhatNothingDominates)
{
  const Table all = readTable(out() / "error_vs_time.csv");
  const Table front = readTable(out() / "pareto_front.csv");
  const auto isOnFront = [&](std::size_t row)
  {
    for (std::size_t i = 0; i < front.rows.size(); ++i)
    {
      if (front.at(i, "front") == "all methods" && front.at(i, "regime") == all.at(row, "regime") &&
        front.at(i, "method") == all.at(row, "method") &&
        front.at(i, "setting") == all.at(row, "setting"))
      {
        return true;
      }
    }
    return false;
  };
  std::size_t compared = 0;
  for (std::size_t i = 0; i < all.rows.size(); ++i)
  {
    if (!all.at(i, "setting").starts_with("sphere R6 H30; against neo-hookean"))
    {
      continue;
    }
    bool dominated = false;
    for (std::size_t k = 0; k < all.rows.size(); ++k)
    {
      dominated = dominated ||
        (all.at(k, "setting").starts_with("sphere R6 H30; against neo-hookean") &&
          all.at(k, "regime") == all.at(i, "regime") &&
          all.number(k, "time_us") < all.number(i, "time_us") &&
          all.number(k, "error_rms_pct") <= all.number(i, "error_rms_pct"));
    }
    EXPECT_EQ(isOnFront(i), !dominated) << all.at(i, "method") << all.at(i, "regime");
    ++compared;
  }
  EXPECT_EQ(compared, 22U * 3U);
}

TEST_F(QuickReport, StatesTheSpreadOfItsTimes)
{
  const Table table = readTable(out() / "time_spread.csv");
  for (std::size_t i = 0; i < table.rows.size(); ++i)
  {
    EXPECT_GT(table.number(i, "low_us"), 0.0);
    EXPECT_LE(table.number(i, "low_us"), table.number(i, "time_us"));
    EXPECT_LE(table.number(i, "time_us"), table.number(i, "high_us"));
  }
  const Table scaling = readTable(out() / "scaling.csv");
  for (std::size_t i = 0; i < scaling.rows.size(); ++i)
  {
    EXPECT_LE(scaling.number(i, "low_us"), scaling.number(i, "median_us"));
    EXPECT_LE(scaling.number(i, "median_us"), scaling.number(i, "high_us"));
  }
}

// the paper's own numbers, and those of a grid of n x n vertices
TEST_F(QuickReport, HasTableOneWithItsTypingError)
{
  const Table table = readTable(out() / "table1.csv");
  ASSERT_EQ(table.rows.size(), 7U);
  for (std::size_t i = 0; i < 7; ++i)
  {
    const double n = 40.0 + 10.0 * static_cast<double>(i);
    EXPECT_EQ(table.number(i, "vertices"), n * n);
    EXPECT_EQ(table.number(i, "edges"), (3 * n - 1) * (n - 1));
    EXPECT_EQ(table.number(i, "triangles"), 2 * (n - 1) * (n - 1));
    EXPECT_EQ(table.number(i, "paper_triangles") == table.number(i, "triangles"), i != 5);
    EXPECT_GE(table.number(i, "step_sd_ms"), 0.0);
  }
  EXPECT_EQ(table.number(6, "paper_mean_ms"), 0.856);
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
    EXPECT_EQ(std::ranges::count(refused.err, '\n'), 1) << refused.err;
  }
}

TEST(ReportCommand, SaysInItsOwnWordsWhatIsNoReport)
{
  const test::TemporaryFolder folder;
  std::ofstream(folder.path() / "machine.json") << R"({"effort": 7, "version": [], "processor": {}})";
  const test::Finished refused =
    test::runCommand(PALP_PROGRAM " report --quick --resume --out " + folder.path().string());
  EXPECT_EQ(refused.code, 2);
  EXPECT_EQ(refused.err.find("json.exception"), std::string::npos) << refused.err;
  EXPECT_NE(refused.err.find("other settings"), std::string::npos) << refused.err;
}

} // namespace
} // namespace palp
