#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace palp
{

/// What is kept of a case beside its table, as case.json.
struct CaseRecord
{
  std::string name{}; ///< of the case that it is of
  std::size_t number = 0;
  std::vector<std::string> command{};
  double seconds = 0.0;
  double memory = 0.0;       ///< largest [bytes]
  std::string failed{};      ///< why, in one sentence; empty: it is finished
  std::string tableSha256{}; ///< of a finished one
};

/// @param folder  of the case
/// @throws Error  BadFile: cannot be written
void writeRecord(const std::filesystem::path& folder, const CaseRecord& record);

/// @param folder  of a finished or failed case
/// @return        nothing where it is gone or damaged
[[nodiscard]] std::optional<CaseRecord> readRecord(const std::filesystem::path& folder);

/// Moves the folder of a case into its place, as a whole, on the disk. Of two runners one is first,
/// and both have the same.
/// @throws Error  BadFile: cannot be written
void publishCase(const std::filesystem::path& result, const std::filesystem::path& place);

} // namespace palp
