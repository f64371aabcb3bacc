#include "app/report/pareto.h"

#include <algorithm>
#include <limits>
#include <map>

namespace palp::report
{

void addParetoFront(Table& front, const std::string& name, const Table& table,
  const std::string& error, const std::string& setting, const std::string& without)
{
  const auto word = [&](const std::vector<Cell>& row, const char* column) -> const std::string&
  { return std::get<std::string>(row[table.indexOf(column)]); };
  const auto number = [&](const std::vector<Cell>& row, const std::string& column)
  { return std::get<double>(row[table.indexOf(column)]); };

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
        byTime.emplace(number(row, "time_us"), &row);
      }
    }
    double best = std::numeric_limits<double>::infinity();
    for (const auto& [time, row] : byTime)
    {
      if (number(*row, error) < best)
      {
        best = number(*row, error);
        front.rows.push_back(
          { name, word(*row, "method"), word(*row, "setting"), regime, time, best });
      }
    }
  }
}

} // namespace palp::report
