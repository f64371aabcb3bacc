#include "tests/app/commands/quick_report.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <set>

namespace palp
{
namespace
{

using namespace test;

const std::vector<std::string> kRegimes{ "shallow", "JND limit", "depth = R" };

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

} // namespace
} // namespace palp
