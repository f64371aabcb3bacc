#include "app/report/stability_study.h"

#include "app/report/parts.h"

#include <sstream>

namespace palp::report
{
namespace
{

// outcomes by what was varied
Table outcomes(const std::vector<JudgedCase>& cases)
{
  using enum StabilityOutcome;
  Table table{ .name = "stability_outcomes",
    .caption = "Outcomes by what was varied: how many cases, how many of them unstable where the "
               "law alone drives the motors, and what becomes of them through the safety chain.",
    .columns = { "varied", "cases", "bare_unstable", "chain_stable", "chain_limited",
      "chain_refused", "chain_unstable" } };
  for (const JudgedCase& one : cases)
  {
    auto row = std::ranges::find_if(
      table.rows, [&](const auto& cells) { return cells[0] == Cell(one.what.name); });
    if (row == table.rows.end())
    {
      table.rows.push_back({ one.what.name, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0 });
      row = table.rows.end() - 1;
    }
    const auto count = [&](std::size_t column) { std::get<double>((*row)[column]) += 1.0; };
    count(1);
    if (one.bare.outcome == Unstable)
    {
      count(2);
    }
    count(3 + static_cast<std::size_t>(one.chain.outcome));
  }
  return table;
}

// the exceptions, which begin with two blanks on lines of their own, as a list in brackets
std::string inOneParagraph(const std::string& summary)
{
  std::istringstream lines(summary);
  std::string words;
  bool listing = false;
  for (std::string line; std::getline(lines, line);)
  {
    const bool named = line.starts_with("  ");
    const char* joint = named ? (listing ? "; " : " (") : (listing ? ") " : " ");
    words.append(words.empty() ? "" : joint).append(line, named ? 2 : 0);
    listing = named;
  }
  return words;
}

} // namespace

Section stability(const Effort& effort)
{
  const std::vector<JudgedCase> cases = judgeAll(effort.quick, effort.stop, effort.tell);
  effort.reached(1.0);
  std::ostringstream map;
  drawStabilityMap(map, cases);
  Section section;
  section.text = { inOneParagraph(stabilitySummary(cases)) };
  section.text.emplace_back(
    "Hand, device, coupling and tissue are simulated in closed loop (palp stability). Unstable: "
    "the loop gave energy to the hand (an arm: more than 5 mJ, or 50 mJ where less delay is told "
    "than it has), or the hand did not come to rest, or it went on in a limit cycle at an encoder "
    "of "
    "48 \u00b5m. The chain bounds stiffness and force, so that what is stiffer than a "
    "device can render is felt softer, not as shaking.");
  section.pictures = { { "stability.svg",
    "Worst outcome of each cell, the law alone on the left and through the safety chain on the "
    "right. Data: stability.csv.",
    map.str() } };
  section.tables = { outcomes(cases), stabilityTable(cases) };
  return section;
}

} // namespace palp::report
