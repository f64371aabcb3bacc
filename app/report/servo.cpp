#include "app/bench/bench.h"
#include "app/report/parts.h"

#include <array>
#include <cmath>

namespace palp::report
{
namespace
{

double inMicroseconds(Histogram::Duration time)
{
  return std::chrono::duration<double, std::micro>(time).count();
}

// counts of each bucket, and the fraction of all ticks that took longer
Table histogramTable(std::string name, std::string caption, const Histogram& histogram)
{
  Table table{ .name = std::move(name),
    .caption = std::move(caption),
    .columns = { "up_to_us", "ticks", "share_beyond" },
    .shown = false };
  const auto all = static_cast<double>(histogram.count());
  double seen = 0.0;
  histogram.forEach(
    [&](Histogram::Duration upTo, std::uint64_t count)
    {
      seen += static_cast<double>(count);
      table.rows.push_back(
        { inMicroseconds(upTo), static_cast<double>(count), (all - seen) / all });
    });
  return table;
}

std::vector<Cell> quantiles(const char* name, const Histogram& histogram)
{
  std::vector<Cell> row{ name };
  for (const double fraction : { 0.5, 0.99, 0.999 })
  {
    row.emplace_back(inMicroseconds(histogram.quantile(fraction)));
  }
  row.emplace_back(inMicroseconds(histogram.longest()));
  return row;
}

Figure figureOf(const char* name, const char* caption, const char* left, const char* column)
{
  Figure figure{ .name = name,
    .caption = caption,
    .bottom = "time [\u00b5s]",
    .left = left,
    .logBottom = true,
    .logLeft = true,
    .group = "How late the servo thread woke up, and how long its step took: ticks in each bucket "
             "of a sixteenth of a doubling, and the share of ticks beyond a time. The servo must "
             "be done within 1,000 \u00b5s." };
  for (const auto& [label, table, color] : { std::tuple{ "lateness", "servo_lateness", 2 },
         std::tuple{ "step: contact, law and safety chain", "servo_step_time", 1 } })
  {
    figure.curves.push_back(
      { .label = label, .table = table, .x = "up_to_us", .y = column, .color = color });
  }
  return figure;
}

} // namespace

Section servo(const Effort& effort)
{
  const double duration = effort.quick ? 3.0 : 60.0; // [s]
  Section section;
  runServo(
    {},
    [&](double elapsed)
    {
      effort.reached(elapsed / duration);
      return elapsed < duration;
    },
    [&](const ServoFigures& figures)
    {
      const Timing& timing = figures.timing;
      const auto ticks = static_cast<double>(timing.ticks.load());
      const auto skipped = static_cast<double>(timing.skipped.load());
      Table summary{ .name = "servo_quantiles",
        .caption = "Quantiles of " + shown(ticks) + " ticks in " + shown(figures.elapsed) + " s; " +
          shown(skipped) + " periods were missed as a whole.",
        .columns = { "quantity", "p50_us", "p99_us", "p999_us", "max_us" },
        .rows = { quantiles("lateness", timing.lateness), quantiles("step", timing.step) } };
      section.tables = { std::move(summary),
        histogramTable("servo_lateness", "Lateness of the wake-up.", timing.lateness),
        histogramTable("servo_step_time", "Time of the step.", timing.step) };
      section.text = { "A servo thread touched a surface of 10,000 vertices at 1 kHz with a tool "
                       "that circles 5 mm deep. Its schedule: " +
        figures.schedule + "." };
    });
  // the last bucket has nothing beyond it, which a logarithm does not show
  section.figures = { figureOf("servo_histogram", "ticks in each bucket", "ticks", "ticks"),
    figureOf("servo_share_beyond", "share of ticks beyond a time", "share of ticks beyond",
      "share_beyond") };
  for (std::size_t i : { 1U, 2U })
  {
    section.tables[i].rows.back()[2] = std::nan("");
  }
  return section;
}

} // namespace palp::report
