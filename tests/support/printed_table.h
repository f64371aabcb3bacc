#pragma once

#include "tests/support/csv_table.h"
#include "tests/support/process.h"

#include <gtest/gtest.h>
#include <sstream>

namespace palp::test
{

/// The table that a program has printed, which it must have done without a complaint.
inline CsvTable printedTable(const Finished& finished)
{
  EXPECT_EQ(finished.code, 0) << finished.err;
  std::istringstream in(finished.out);
  return parseCsv(in);
}

} // namespace palp::test
