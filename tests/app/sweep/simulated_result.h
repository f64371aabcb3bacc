#pragma once

#include "app/program/sha256.h"
#include "app/sweep/case_folders.h"
#include "app/sweep/cases/case_record.h"
#include "app/sweep/cases/result_rows.h"

#include <fstream>

namespace palp::test
{

/// What a runner would leave of a case of palp force.
inline void leaveResult(
  const std::filesystem::path& sweep, const std::string& name, const std::string& table)
{
  const std::filesystem::path place = CaseFolders{ sweep }.result(name);
  std::filesystem::create_directories(place);
  std::ofstream(resultTable(place, "force")) << table;
  writeRecord(
    place, { .name = name, .seconds = 2.0, .memory = 8e6, .tableSha256 = sha256Of(table) });
}

} // namespace palp::test
