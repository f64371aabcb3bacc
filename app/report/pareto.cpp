#include "app/report/pareto.h"

#include <algorithm>
#include <limits>
#include <map>

namespace palp::report
{

void addParetoFront(Table& front, const std::string& name, const Table& table,
  const std::string& setting, const std::string& without)
{
  const std::size_t timeColumn = table.indexOf(front.columns[4]);
  const std::size_t errorColumn = table.indexOf(front.columns[5]);
  const auto word = [&](const std::vector<Cell>& row, const char* column) -> const std::string&
  { return std::get<std::string>(row[table.indexOf(column)]); };

  std::vector<std::string> regimes; // in the order of the table
  for (const auto& row : table.rows)
  {
    if (std::ranges::find(regimes, word(row, "regime")) == regimes.end())
    {
      regimes.push_back(word(row, "regime"));
    }
  }
  for (const std::string& regime : regimes)
  {
    std::multimap<double, const std::vector<Cell>*> byTime;
    for (const auto& row : table.rows)
    {
      if (word(row, "regime") == regime && word(row, "setting").starts_with(setting) &&
        word(row, "method") != without)
      {
        byTime.emplace(std::get<double>(row[timeColumn]), &row);
      }
    }
    double best = std::numeric_limits<double>::infinity();
    for (const auto& [time, row] : byTime)
    {
      if (const double error = std::get<double>((*row)[errorColumn]); error < best)
      {
        best = error;
        front.rows.push_back(
          { name, word(*row, "method"), word(*row, "setting"), regime, time, best });
      }
    }
  }
}

} // namespace palp::report
