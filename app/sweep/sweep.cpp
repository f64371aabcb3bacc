#include "app/sweep/sweep.h"

#include <algorithm>

namespace palp
{

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

} // namespace palp
