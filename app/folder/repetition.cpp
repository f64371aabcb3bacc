#include "app/folder/repetition.h"

#include "app/folder/export_folder.h"
#include "app/train/score_sheet.h"
#include "haptics/files/listed.h"

#include <iostream>
#include <set>
#include <string>
#include <vector>

namespace palp
{
namespace
{

// takes out of names the score sheets in a folder
std::set<std::string> sheetsOf(std::set<std::string>& names, const std::filesystem::path& folder)
{
  std::set<std::string> sheets;
  for (const std::string& name : kScoreFiles)
  {
    if (std::filesystem::exists(folder / name) && names.erase(name) > 0)
    {
      sheets.insert(name);
    }
  }
  return sheets;
}

} // namespace

void tellRepetition(const ExportFolder& repeated, const std::filesystem::path& out)
{
  const auto namesIn = [&](const std::filesystem::path& folder)
  {
    const std::vector<std::string> names = differences(repeated, folder);
    return std::set<std::string>(names.begin(), names.end());
  };
  const std::string folder = repeated.folder.string();
  std::set<std::string> other = namesIn(out);
  std::set<std::string> edited = namesIn(repeated.folder);
  std::set<std::string> sheets = sheetsOf(edited, repeated.folder);
  if (repeated.version == PALP_VERSION) // which would have written the same
  {
    sheets.merge(sheetsOf(other, repeated.folder));
  }
  if (!sheets.empty())
  {
    std::cerr << "palp: warning: " << folder << ": the figures of its " << listed(sheets)
              << " do not follow from the recording; those made anew do\n";
  }
  if (sheets.empty() || !other.empty())
  {
    std::cerr << "palp: " << folder
              << (other.empty() ? ": repeated to the byte"
                                : ": made by palp " + repeated.version + ", comes out another in " +
                       listed(other))
              << '\n';
  }
  for (const MeshFile& file : repeated.beside)
  {
    std::cerr << "palp: " << (repeated.folder / file.name).string() << ": not repeated\n";
  }
  if (const auto takes = takesIn(repeated.folder).size(); takes > 1)
  {
    std::cerr << "palp: " << takes - 1 << " earlier recordings are exports of their own, as "
              << earlierTake(repeated.folder, 1).string() << "; repeat each by itself\n";
  }
  if (!edited.empty())
  {
    std::cerr << "palp: warning: " << folder
              << " is not as it was written; changed or removed since: " << listed(edited) << '\n';
  }
  if (const auto servo = repeated.folder / "servo.csv"; std::filesystem::exists(servo))
  {
    std::filesystem::copy_file(servo, out / "servo.csv");
  }
}

} // namespace palp
