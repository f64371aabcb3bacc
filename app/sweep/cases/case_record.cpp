#include "app/sweep/cases/case_record.h"

#include "app/program/machine.h"
#include "app/sweep/case_folders.h"
#include "haptics/files/replace_file.h"

#include <nlohmann/json.hpp>

#include <cerrno>
#include <cmath>
#include <cstdio>
#include <fstream>

namespace palp
{
namespace
{

constexpr double kMebibyte = 1024.0 * 1024.0;

} // namespace

void writeRecord(const std::filesystem::path& folder, const CaseRecord& record)
{
  const nlohmann::ordered_json about{ { "case", record.number }, { "name", record.name },
    { "command", record.command }, { "seconds", record.seconds },
    { "memory_MiB", std::ceil(record.memory / kMebibyte) }, { "processor", processorName() },
    { "failed", record.failed }, { "table_sha256", record.tableSha256 } };
  const std::filesystem::path file = folder / kCaseFile;
  if (!(std::ofstream(file) << about.dump(2) << '\n').flush())
  {
    refuseFile(file, errno);
  }
}

std::optional<CaseRecord> readRecord(const std::filesystem::path& folder)
{
  std::ifstream in(folder / kCaseFile);
  try
  {
    const auto about = nlohmann::json::parse(in);
    return CaseRecord{ .name = about.at("name"),
      .number = about.at("case"),
      .command = about.at("command"),
      .seconds = about.at("seconds"),
      .memory = about.at("memory_MiB").get<double>() * kMebibyte,
      .failed = about.at("failed"),
      .tableSha256 = about.at("table_sha256") };
  }
  catch (const nlohmann::json::exception&)
  {
    return std::nullopt;
  }
}

void publishCase(const std::filesystem::path& result, const std::filesystem::path& place)
{
  std::error_code failed;
  std::filesystem::create_directories(place.parent_path(), failed);
  for (const auto& entry : std::filesystem::directory_iterator(result))
  {
    if (const int reason = syncToDisk(entry.path()))
    {
      refuseFile(place, reason);
    }
  }
  if (rename(result.c_str(), place.c_str()) != 0 && errno != ENOTEMPTY && errno != EEXIST)
  {
    refuseFile(place, errno);
  }
  syncToDisk(place.parent_path());
}

} // namespace palp
