#include "app/sweep/case_folders.h"
#include "app/sweep/cases/sweep_figures.h"
#include "app/sweep/plan.h"
#include "haptics/error.h"
#include "tests/app/sweep/simulated_result.h"
#include "tests/support/process.h"

#include <array>
#include <cstdio>
#include <fstream>
#include <gtest/gtest.h>
#include <limits>
#include <set>
#include <sstream>

namespace palp
{
namespace
{

// forces over E and nu that nobody computed
class SweepMap : public testing::Test
{
protected:
  static constexpr int kSide = 7;

  [[nodiscard]] SweepFigures drawn(const SweepPlot& plot, double (*force)(int, int))
  {
    Sweep sweep{ .title = "simulated", .kind = "force", .fixed = { { "depth", "1:1:1mm" } } };
    sweep.axes.push_back({ { "young" }, {} });
    sweep.axes.push_back({ { "poisson" }, {} });
    for (int i = 0; i < kSide; ++i)
    {
      sweep.axes[0].rows.push_back({ std::to_string(i + 1) + "kPa" });
      sweep.axes[1].rows.push_back({ "0." + std::to_string(i + 1) });
    }
    sweep.plots.push_back(plot);
    planSweep(
      sweep, "/", { { "young", "poisson", "depth" }, {} }, [](const auto&) {}, folder_.path());
    Manifest manifest(folder_.path());
    for (std::size_t i = 0; i < manifest.head().count; ++i)
    {
      const int at = static_cast<int>(i);
      std::ostringstream table;
      table << "depth_mm,force_N\n1," << force(at / kSide, at % kSide) << '\n';
      test::leaveResult(folder_.path(), manifest.at(i).name, table.str());
    }
    SweepFigures drawn = sweepFigures(manifest, {});
    if (!drawn.refused.empty())
    {
      throw Error(ErrorCode::BadFile, drawn.refused.front());
    }
    return drawn;
  }

  test::TemporaryFolder folder_;
};

TEST_F(SweepMap, EachCellHasTheShadeWhoseValuesItsLabelTells)
{
  const auto force = [](int i, int j) { return 0.25 * i - 0.1 * j; };
  const SweepFigures map = drawn(
    { .name = "map", .title = "t", .x = "young_kPa", .y = "poisson", .colors = "force_N" }, force);
  ASSERT_EQ(map.figures.size(), 1U);
  int cells = 0;
  for (const figures::Curve& curve : map.figures[0].curves)
  {
    EXPECT_EQ(curve.style, figures::Curve::Style::Cells);
    double from = 0.0;
    double to = 0.0;
    ASSERT_EQ(std::sscanf(curve.label.c_str(), "%lf to %lf", &from, &to), 2) << curve.label;
    const figures::Points points = figures::pointsOf(map.tables, curve);
    for (std::size_t k = 0; k < points.x.size(); ++k, ++cells)
    {
      const double value =
        force(static_cast<int>(points.x[k]) - 1, static_cast<int>(10.0 * points.y[k] + 0.5) - 1);
      EXPECT_GE(value, from - 0.006) << "rounded to three digits";
      EXPECT_LE(value, to + 0.006);
    }
  }
  EXPECT_EQ(cells, kSide * kSide);
  EXPECT_EQ(figures::pointsOf(map.tables, map.figures[0].curves.front()).x.size(), 4U);
  EXPECT_EQ(figures::pointsOf(map.tables, map.figures[0].curves.back()).x.size(), 4U);
}

TEST_F(SweepMap, OfOneValueHasOneShade)
{
  const SweepFigures map =
    drawn({ .name = "map", .title = "t", .x = "young_kPa", .y = "poisson", .colors = "force_N" },
      [](int, int) { return 2.0; });
  EXPECT_EQ(figures::pointsOf(map.tables, map.figures[0].curves.front()).x.size(),
    std::size_t{ kSide } * kSide);
}

TEST_F(SweepMap, LabelsTellClassesApartWhateverTheirSize)
{
  const SweepPlot plot{
    .name = "map", .title = "t", .x = "young_kPa", .y = "poisson", .colors = "force_N"
  };
  const auto large = [](int i, int j) { return 123456.0 + 0.02 * (7 * i + j); };
  const auto small = [](int i, int j) { return 1e-12 * (7 * i + j); };
  for (const auto force : { +large, +small })
  {
    std::set<std::string> labels;
    const SweepFigures map = drawn(plot, force);
    for (const figures::Curve& curve : map.figures[0].curves)
    {
      double from = 0.0;
      double to = 0.0;
      ASSERT_EQ(std::sscanf(curve.label.c_str(), "%lf to %lf", &from, &to), 2) << curve.label;
      EXPECT_LT(from, to) << curve.label;
      EXPECT_TRUE(labels.insert(curve.label).second) << curve.label;
    }
  }
}

// without a column for curves no line leads from one case to another
TEST_F(SweepMap, PlotsWithoutCurvesAreOfPoints)
{
  const SweepFigures points = drawn({ .name = "p", .title = "t", .x = "young_kPa", .y = "force_N" },
    [](int i, int j) { return 1.0 * i * j; });
  ASSERT_EQ(points.figures[0].curves.size(), 1U);
  EXPECT_EQ(points.figures[0].curves[0].style, figures::Curve::Style::Circles);
}

TEST_F(SweepMap, RefusesAPlotOfNothingByItsName)
{
  const auto force = [](int i, int j) { return 1.0 * i * j; };
  const auto refusal = [&](const SweepPlot& plot) -> std::string
  {
    try
    {
      (void)drawn(plot, force);
      return "drawn";
    }
    catch (const Error& error)
    {
      return error.what();
    }
  };
  for (const std::string colors : { "", "force_N" })
  {
    const std::string none = refusal({ .name = "none",
      .title = "t",
      .x = "young_kPa",
      .y = "force_N",
      .colors = colors,
      .where = { { "depth_mm", "9" } } });
    EXPECT_NE(none.find("plot 'none': no row"), none.npos) << none;
    EXPECT_NE(none.find("where"), none.npos) << none;
  }
  const std::string words = refusal({ .name = "w", .title = "t", .x = "depth_m", .y = "force_N" });
  EXPECT_NE(words.find("depth_m"), words.npos) << words;
}

// a line may go from case to case only where x goes on
TEST_F(SweepMap, RefusesCurvesAndPlacesOfSeveralCases)
{
  const auto force = [](int i, int j) { return 1.0 * i * j; };
  const SweepPlot line{
    .name = "p", .title = "t", .x = "young_kPa", .y = "force_N", .curves = "poisson"
  };
  const auto curves = drawn(line, force).figures[0].curves;
  EXPECT_EQ(curves.size(), std::size_t{ kSide });
  std::set<std::pair<int, figures::Curve::Style>> looks;
  for (const figures::Curve& curve : curves)
  {
    EXPECT_TRUE(looks.emplace(curve.color, curve.style).second) << curve.label;
  }
  for (const auto& [x, y, by, colors] :
    { std::array<std::string, 4>{ "depth_mm", "force_N", "poisson", "" },
      std::array<std::string, 4>{ "depth_mm", "poisson", "", "force_N" } })
  {
    try
    {
      (void)drawn(
        { .name = "p", .title = "t", .x = x, .y = y, .curves = by, .colors = colors }, force);
      FAIL() << by << colors;
    }
    catch (const Error& error)
    {
      EXPECT_NE(std::string(error.what()).find("--largest"), std::string::npos) << error.what();
    }
  }
}

TEST_F(SweepMap, TellsTheUnitOfACurve)
{
  const SweepPlot plot{
    .name = "p", .title = "t", .x = "poisson", .y = "force_N", .curves = "young_kPa"
  };
  const SweepFigures map = drawn(plot, [](int i, int j) { return 1.0 * i * j; });
  EXPECT_EQ(map.figures[0].curves[2].label, "3 kPa");
}

TEST_F(SweepMap, LeavesOutWhatIsNoNumberAndRefusesPlacesThatAreNone)
{
  const auto some = [](int i, int j)
  { return i == j ? std::numeric_limits<double>::quiet_NaN() : 1.0 * i; };
  const SweepFigures map = drawn(
    { .name = "map", .title = "t", .x = "young_kPa", .y = "poisson", .colors = "force_N" }, some);
  std::size_t cells = 0;
  for (const figures::Curve& curve : map.figures[0].curves)
  {
    cells += figures::pointsOf(map.tables, curve).x.size();
  }
  EXPECT_EQ(cells, std::size_t{ kSide } * (kSide - 1));
}

} // namespace
} // namespace palp
