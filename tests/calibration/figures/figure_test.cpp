#include "calibration/figures/figure_json.h"
#include "haptics/error.h"

#include <cmath>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace palp::figures
{
namespace
{

const Table kTrials{ .name = "trials",
  .caption = "Trials.",
  .columns = { "method", "time_us", "error_pct" },
  .rows = { { "law", 1.0, 0.1 }, { "law; fine", 2.0, NAN }, { "lawless", 3.0, 7.0 },
    { "law; fine", 4.0, 1.0 / 3.0 }, { "say \"a, b\"", 5.0, 1e-5 } } };

Curve errors(std::vector<std::pair<std::string, std::string>> where)
{
  return { .label = "errors",
    .table = "trials",
    .x = "time_us",
    .y = "error_pct",
    .where = std::move(where) };
}

TEST(Table, CsvQuotesAsRfc4180AndLeavesWhatIsMissingEmpty)
{
  EXPECT_EQ(csv(kTrials),
    "method,time_us,error_pct\nlaw,1,0.1\nlaw; fine,2,\nlawless,3,7\n"
    "law; fine,4,0.3333333333333333\n\"say \"\"a, b\"\"\",5,1e-05\n");
  EXPECT_NE(csv(kTrials, 7).find("law; fine,4,0.3333333\n"), std::string::npos);
}

TEST(Table, ShowsPeopleFourDigits)
{
  for (const auto& [value, text] :
    { std::pair{ 3.0, "3" }, std::pair{ 21.5652, "21.57" }, std::pair{ 0.0123456, "0.01235" },
      std::pair{ 1.5e-5, "1.50e-05" }, std::pair{ std::nan(""), "\u2013" } })
  {
    EXPECT_EQ(shown(value), text);
  }
}

TEST(Table, NamesWhatIsNotThere)
{
  EXPECT_EQ(kTrials.column("time_us"), (std::vector{ 1.0, 2.0, 3.0, 4.0, 5.0 }));
  EXPECT_THROW((void)kTrials.column("time_ms"), Error);
  EXPECT_THROW((void)kTrials.column("method"), Error);
  Curve elsewhere = errors({});
  elsewhere.table = "claims";
  EXPECT_THROW((void)pointsOf(std::span(&kTrials, 1), elsewhere), Error);
}

TEST(Figure, CurveIsTheRowsThatItNames)
{
  const Points law = pointsOf(std::span(&kTrials, 1), errors({ { "method", "law" } }));
  EXPECT_EQ(law.x, (std::vector{ 1.0, 4.0 })); // not lawless, not what is missing
  EXPECT_EQ(law.y, (std::vector{ 0.1, 1.0 / 3.0 }));
  const Points fine =
    pointsOf(std::span(&kTrials, 1), errors({ { "method", "law; fine" }, { "time_us", "4" } }));
  EXPECT_EQ(fine.x, std::vector{ 4.0 });
}

// ten curves and more: 1 is not the beginning of 10
TEST(Figure, FindsItsOwnPointsAgain)
{
  Figure figure{ .name = "many", .caption = "Many", .bottom = "x [mm]", .left = "y [N]" };
  Table own = pointTable(figure);
  for (int i = 1; i <= 12; ++i)
  {
    addCurve(figure, own, { .label = i == 1 ? "first" : "", .color = i },
      { { 0.0, 1.0 * i }, { 0.5, 2.0 * i } });
  }
  ASSERT_EQ(figure.curves.size(), 12U);
  EXPECT_EQ(own.name, "many_figure");
  for (int i = 1; i <= 12; ++i)
  {
    const Points points =
      pointsOf(std::span(&own, 1), figure.curves[static_cast<std::size_t>(i) - 1]);
    EXPECT_EQ(points.x, (std::vector{ 0.0, 1.0 * i }));
    EXPECT_EQ(points.y, (std::vector{ 0.5, 2.0 * i }));
  }
}

TEST(Figure, ReadsBackFromItsJson)
{
  const Figure figure{ .name = "f",
    .caption = "F.",
    .bottom = "t [\u00b5s]",
    .left = "e [%]",
    .logBottom = true,
    .curves = { errors({ { "method", "law" } }) },
    .group = "G",
    .band = 7.0 };
  EXPECT_EQ(figureOf(toJson(figure)).band, 7.0);
  EXPECT_EQ(toJson(figureOf(toJson(figure))), toJson(figure));
  const nlohmann::ordered_json table = toJson(kTrials);
  EXPECT_EQ(csv(tableOf(nlohmann::ordered_json::parse(table.dump()))), csv(kTrials));
  EXPECT_THROW((void)figureOf(table), nlohmann::ordered_json::exception);
}

} // namespace
} // namespace palp::figures
