#include "app/report/parts.h"
#include "data/shapes.h"
#include "haptics/error.h"
#include "haptics/files/prefix.h"
#include "haptics/numerics/polynomial_fit.h"
#include "haptics/numerics/statistics.h"
#include "pipeline/process/child_process.h"

#include <array>
#include <cmath>
#include <malloc.h>
#include <map>
#include <nlohmann/json.hpp>
#include <tuple>

namespace palp::report
{
namespace
{

// Table 1 of the paper. Its row 6 says 15,482 triangles; 90 x 90 vertices make 15,842.
struct PaperRow
{
  int side;
  double edges;
  double triangles;
  double mean; // [ms]
  double deviation;
};
constexpr std::array kPaper{ PaperRow{ 40, 4641, 3042, 0.154, 0.014 },
  PaperRow{ 50, 7301, 4802, 0.231, 0.012 }, PaperRow{ 60, 10561, 6962, 0.325, 0.014 },
  PaperRow{ 70, 14421, 9522, 0.426, 0.013 }, PaperRow{ 80, 18881, 12482, 0.551, 0.012 },
  PaperRow{ 90, 23941, 15482, 0.696, 0.025 }, PaperRow{ 100, 29601, 19602, 0.856, 0.016 } };

double inMilliseconds(double microseconds)
{
  return microseconds / 1e3;
}

// repeated measurements of one row of the bench
struct Repeated
{
  std::vector<double> medians;
  std::vector<double> means;
  std::vector<double> deviations;
  std::vector<double> tails;
};
using Key = std::tuple<std::string, std::string, std::size_t>; // work, case, vertices

Table timesTable(const std::map<Key, Repeated>& all, double sweep)
{
  Table table{ .name = "scaling",
    .caption = "Times of all steps; median, lowest and highest of the medians of repeated runs.",
    .columns = { "work", "case", "vertices", "median_us", "low_us", "high_us", "mean_us", "sd_us",
      "p99_us", "median_per_S" },
    .shown = false };
  for (const auto& [key, repeated] : all)
  {
    const auto& [work, mode, vertices] = key;
    const Statistics median = statisticsOf(repeated.medians);
    table.rows.push_back({ work, mode, static_cast<double>(vertices), median.median, median.low,
      median.high, statisticsOf(repeated.means).median, statisticsOf(repeated.deviations).median,
      statisticsOf(repeated.tails).median, median.median / sweep });
  }
  return table;
}

Table tableOne(const std::map<Key, Repeated>& all)
{
  Table table{ .name = "table1",
    .caption = "Table 1 of the paper beside this machine, mean and standard deviation of a step "
               "[ms]. The paper's step holds force and deformation, as 'step' does here (contact, "
               "force, dent, normals); 'servo' is what this program does in its 1 kHz loop. Row 6 "
               "of the paper says 15,482 triangles where 90 x 90 vertices make 15,842: a typing "
               "error, as all other rows follow 2 (n \u2212 1)\u00b2.",
    .columns = { "model", "vertices", "edges", "paper_triangles", "triangles", "paper_mean_ms",
      "paper_sd_ms", "step_mean_ms", "step_sd_ms", "servo_mean_ms", "servo_sd_ms" } };
  double model = 0.0;
  for (const PaperRow& row : kPaper)
  {
    const auto side = static_cast<std::size_t>(row.side);
    const std::size_t vertices = side * side;
    const Repeated& step = all.at({ "update", "moving", vertices });
    const Repeated& servo = all.at({ "servo_step", "moving", vertices });
    const auto ms = [](const std::vector<double>& values)
    { return inMilliseconds(statisticsOf(values).median); };
    table.rows.push_back({ ++model, static_cast<double>(vertices), row.edges, row.triangles,
      2.0 * (row.side - 1) * (row.side - 1), row.mean, row.deviation, ms(step.means),
      ms(step.deviations), ms(servo.means), ms(servo.deviations) });
  }
  return table;
}

// least squares through the paper's means, and on to a million vertices
Table paperLine()
{
  std::vector<double> sizes;
  std::vector<double> means;
  for (const PaperRow& row : kPaper)
  {
    sizes.push_back(row.side * row.side);
    means.push_back(row.mean);
  }
  const PolynomialFit line = fitPolynomial(sizes, means, 1);
  Table table{ .name = "paper_line",
    .caption = "The straight line of Fig. 14, and its continuation.",
    .columns = { "vertices", "line_us", "paper_us" },
    .shown = false };
  const auto add = [&](double vertices, double mean) {
    table.rows.push_back({ vertices, 1e3 * line(vertices), 1e3 * mean });
  };
  for (std::size_t i = 0; i < sizes.size(); ++i)
  {
    add(sizes[i], means[i]);
  }
  for (const double vertices : { 30'000.0, 100'000.0, 300'000.0, 1'000'000.0 })
  {
    add(vertices, std::nan(""));
  }
  return table;
}

double heapInUse()
{
  const auto info = mallinfo2();
  return static_cast<double>(info.uordblks + info.hblkhd);
}

Table memory(const std::vector<int>& sides, const Effort& effort)
{
  Table table{ .name = "memory",
    .caption = "Memory of a surface with its tree, normals and neighbors.",
    .columns = { "vertices", "triangles", "MiB", "bytes_per_triangle" } };
  for (const int side : sides)
  {
    effort.check();
    Mesh mesh = makeGrid(side, 0.1);
    const auto triangles = static_cast<double>(mesh.triangles.size());
    const double before = heapInUse();
    const auto surface =
      std::make_unique<const Surface>(std::move(mesh.points), std::move(mesh.triangles));
    const double points = static_cast<double>(surface->points().size()) * sizeof(Eigen::Vector3d) +
      triangles * sizeof(Triangle); // were there before, and moved in
    const double bytes = heapInUse() - before + points;
    table.rows.push_back({ static_cast<double>(surface->points().size()), triangles,
      bytes / (1 << 20), bytes / triangles });
  }
  return table;
}

// how the mean grows from the paper's smallest surface to its largest: 0 not at all, 1 linearly
double exponent(const Table& table, const char* column)
{
  const auto mean = [&](const std::vector<Cell>& row)
  { return std::get<double>(row[table.indexOf(column)]); };
  return std::log(mean(table.rows.back()) / mean(table.rows.front())) / std::log(10'000.0 / 1600.0);
}

std::vector<Claim> claimsOf(const Table& table)
{
  const auto ms = [&](std::size_t row, const char* column)
  { return shown(table.rows[row][table.indexOf(column)]) + " ms"; };
  const std::string grows = "step as vertices^" + shown(exponent(table, "step_mean_ms")) +
    ", servo as vertices^" + shown(exponent(table, "servo_mean_ms"));
  return { { .of = "Fig. 13",
             .paper = "0.856 ms a step at 10,000 vertices, still 1 kHz",
             .here = ms(6, "step_mean_ms") + " a step, " + ms(6, "servo_mean_ms") + " in the servo",
             .verdict = "agrees" },
    { .of = "Fig. 14",
      .paper = "the time of a step grows linearly with the number of vertices",
      .here = grows,
      .verdict = "differs: here only vertices near the tool are asked and only the dent is "
                 "rewritten, so that the step follows the dent and the servo nothing at all" },
    { .of = "Table 1, row 6",
      .paper = "15,482 triangles at 8,100 vertices",
      .here = "15,842 triangles",
      .verdict = "a typing error of the paper: 2 (90 - 1)^2 = 15,842" } };
}

Curve curve(const char* label, const char* work, const char* mode, Curve::Style style, int color)
{
  return { .label = label,
    .table = "scaling",
    .x = "vertices",
    .y = "median_us",
    .where = { { "work", work }, { "case", mode } },
    .style = style,
    .color = color };
}

Figure scalingFigure()
{
  return { .name = "scaling",
    .caption = "Time of a step against the number of vertices. The servo step reads the triangles "
               "under the tool only, so that it hardly knows how many there are; asking every "
               "triangle grows like the paper's step.",
    .bottom = "vertices",
    .left = "time of a step [\u00b5s]",
    .logBottom = true,
    .logLeft = true,
    .curves = { curve("servo step", "servo_step", "moving", Curve::Style::Circles, 1),
      curve("servo step, tool jumps", "servo_step", "jump", Curve::Style::Squares, 1),
      curve("servo step, cold cache", "servo_step", "cold", Curve::Style::Squares, 4),
      curve("force, dent and normals", "update", "moving", Curve::Style::Diamonds, 3),
      curve("dent of 2,300 vertices", "dent", "2300", Curve::Style::Diamonds, 5),
      curve("every triangle asked", "query_brute", "moving", Curve::Style::Diamonds, 7),
      { .label = "paper, Table 1",
        .table = "paper_line",
        .x = "vertices",
        .y = "paper_us",
        .style = Curve::Style::Circles,
        .color = 2 },
      { .label = "the paper's line, continued",
        .table = "paper_line",
        .x = "vertices",
        .y = "line_us",
        .style = Curve::Style::Dashed,
        .color = 2 } } };
}

// palp bench in a process of its own, for where the loader puts a program changes its speed
nlohmann::json runBench(const Effort& effort)
{
  const std::string program = (prefix() / "bin/palp").string();
  std::vector<std::string> command{ program, "bench", "--json", "--most" };
  command.emplace_back(effort.quick ? "100000" : "1000000");
  if (effort.quick)
  {
    command.emplace_back("--quick");
  }
  auto json = nlohmann::json::parse(outputOf(command).value_or(""), nullptr, false);
  if (!json.is_object())
  {
    throw Error(
      ErrorCode::BadFile, program + " bench: gave no figures; build palp beside this program");
  }
  return json;
}

} // namespace

Section scaling(const Effort& effort)
{
  const int runs = effort.quick ? 1 : effort.repeats();
  std::map<Key, Repeated> all;
  std::vector<double> sweeps;
  for (int run = 0; run < runs; ++run)
  {
    const nlohmann::json bench = runBench(effort);
    sweeps.push_back(bench.at("S_us"));
    for (const auto& row : bench.at("rows"))
    {
      std::string work = row.at("work");
      if (row.contains("variant"))
      {
        work.append(" ").append(row.at("variant").get<std::string>());
      }
      Repeated& repeated = all[{ work, row.at("case"), row.at("vertices") }];
      repeated.medians.push_back(row.at("median_us"));
      repeated.means.push_back(row.at("mean_us"));
      repeated.deviations.push_back(row.at("sd_us"));
      repeated.tails.push_back(row.at("p99_us"));
    }
    effort.reached((run + 1.0) / runs);
  }
  const double sweep = statisticsOf(sweeps).median;

  Section section;
  section.tables = { tableOne(all),
    memory(effort.quick ? std::vector{ 40, 100, 316 } : std::vector{ 40, 100, 316, 1000 }, effort),
    timesTable(all, sweep), paperLine() };
  section.claims = claimsOf(section.tables.front());
  section.text = { "The normalizer S of this run, a scalar sweep over 10,000 points, took " +
    shown(sweep) +
    " \u00b5s; column median_per_S states times as multiples of it, by which "
    "machines compare. Every figure is " +
    (runs == 1 ? "of one process" : "the median of " + std::to_string(runs) + " processes") +
    ": where the loader puts a program changes a step of microseconds by some 10 per cent." };
  section.figures.push_back(scalingFigure());
  return section;
}

} // namespace palp::report
