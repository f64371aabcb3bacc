#include "app/sweep/sweep.h"

#include "app/sweep/sweep_range.h"
#include "haptics/error.h"
#include "haptics/files/csv_text.h"
#include "haptics/files/input_text.h"

#include <algorithm>
#include <iterator>

namespace palp
{
namespace
{

// 5mm and 5.0 mm are one value
std::string sameText(const std::string& value)
{
  const auto number = numberText(value);
  return number ? shortest(number->number + 0.0) + number->unit : value;
}

void refuseEqual(const std::string& file, const SweepAxis& axis)
{
  std::map<std::vector<std::string>, std::size_t> rows;
  for (std::size_t i = 0; i < axis.rows.size(); ++i)
  {
    std::vector<std::string> row;
    std::ranges::transform(axis.rows[i], std::back_inserter(row), sameText);
    const auto [first, isNew] = rows.emplace(row, i);
    if (!isNew)
    {
      throw Error(ErrorCode::BadFile,
        file + ": " + inQuotes(axis.names.front()) + ": its values " +
          std::to_string(first->second + 1) + " and " + std::to_string(i + 1) + " are equal, " +
          inQuotes(axis.rows[i].front()) +
          (axis.names.size() > 1 ? ", and so is all that goes with it" : "") +
          "; each case would be computed twice: leave one out");
    }
  }
}

} // namespace

std::size_t Sweep::count() const
{
  std::size_t product = 1;
  for (const SweepAxis& axis : axes)
  {
    product = std::min(product * axis.rows.size(), kMostCases + 1); // neither can overflow
  }
  return product;
}

std::vector<std::string> Sweep::names() const
{
  std::vector<std::string> all;
  for (const SweepAxis& axis : axes)
  {
    all.insert(all.end(), axis.names.begin(), axis.names.end());
  }
  return all;
}

std::vector<std::string> Sweep::values(std::size_t number) const
{
  std::vector<const std::vector<std::string>*> rows(axes.size());
  for (std::size_t i = axes.size(); i-- > 0;)
  {
    rows[i] = &axes[i].rows[number % axes[i].rows.size()];
    number /= axes[i].rows.size();
  }
  std::vector<std::string> all;
  for (const auto* row : rows)
  {
    all.insert(all.end(), row->begin(), row->end());
  }
  return all;
}

void Sweep::refuseEqualRows() const
{
  for (const SweepAxis& axis : axes)
  {
    refuseEqual(file, axis);
  }
}

} // namespace palp
