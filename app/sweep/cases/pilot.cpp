#include "app/sweep/cases/pilot.h"

#include "app/sweep/case_folders.h"
#include "app/sweep/cases/case_record.h"
#include "haptics/error.h"
#include "haptics/files/input_text.h"

#include <algorithm>

namespace palp
{

CaseCost runPilots(Manifest& manifest, const std::vector<std::size_t>& pilots)
{
  refuseFailed(runCases(manifest, pilots, 1), manifest.folder(),
    ", or give a case that does not fail by --pilot");
  CaseCost most{ .seconds = 0.0, .memory = 0.0 };
  for (const std::size_t pilot : pilots)
  {
    const auto folder = CaseFolders{ manifest.folder() }.result(manifest.at(pilot).name);
    const auto record = readRecord(folder);
    if (!record)
    {
      throw Error(ErrorCode::BadFile,
        (folder / kCaseFile).string() + ": is damaged; remove its folder and plan again");
    }
    most.seconds = std::max(most.seconds, record->seconds);
    most.memory = std::max(most.memory, record->memory);
  }
  return most;
}

void refuseFailed(
  const RunOutcome& outcome, const std::filesystem::path& folder, const std::string& otherwise)
{
  if (!outcome.failed.empty())
  {
    throw Error(ErrorCode::NoSolution,
      counted(outcome.failed.size(), "case") + " failed, " +
        (outcome.failed.size() > 1 ? "the first is case " : "case ") +
        std::to_string(outcome.failed.front()) + "; palp sweep status " + folder.string() +
        " tells why, the same command tries again" + otherwise);
  }
}

} // namespace palp
