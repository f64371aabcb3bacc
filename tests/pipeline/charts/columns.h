#pragma once

#include <vector>
#include <vtkTable.h>

namespace palp::test
{

/// The numbers of a column.
inline std::vector<double> column(vtkTable& table, vtkIdType index)
{
  std::vector<double> values;
  for (vtkIdType i = 0; i < table.GetNumberOfRows(); ++i)
  {
    values.push_back(table.GetValue(i, index).ToDouble());
  }
  return values;
}

} // namespace palp::test
