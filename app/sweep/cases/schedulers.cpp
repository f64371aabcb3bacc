#include "app/sweep/cases/schedulers.h"

#include "app/program/exec_program.h"
#include "app/sweep/case_folders.h"
#include "haptics/error.h"
#include "haptics/files/input_text.h"
#include "haptics/files/prefix.h"
#include "haptics/files/replace_file.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace palp
{
namespace
{

namespace fs = std::filesystem;

constexpr double kMoreMemory = 2.0; // than the pilot's, as cases differ
constexpr double kMoreTime = 4.0;
constexpr double kLeastMemory = 256.0; // [MiB]
constexpr double kLeastTime = 5.0;     // [min], a node may be slow to begin

std::string program()
{
  return quoted((prefix() / "bin/palp").string());
}

std::string timeText(double minutes)
{
  const auto whole = static_cast<long>(std::ceil(std::max(kLeastTime, minutes)));
  char text[64];
  std::snprintf(text, sizeof text, "%ld:%02ld:00", whole / 60, whole % 60);
  return text;
}

} // namespace

fs::path plainPlace(const fs::path& folder)
{
  fs::path place = fs::absolute(folder).lexically_normal();
  if (place.string().find_first_of("{}%\n\\\"'") != std::string::npos)
  {
    throw Error(ErrorCode::BadValue,
      inQuotes(place.string()) +
        ": Slurm and GNU parallel read braces, %, quotes and line ends in another way; choose a "
        "folder without them");
  }
  return place;
}

fs::path writeSlurm(const fs::path& folder, const SlurmArray& array)
{
  const fs::path place = plainPlace(folder);
  const std::size_t chunk = array.chunk();
  const std::size_t last = (array.count + chunk - 1) / chunk - 1;
  const double each = static_cast<double>(chunk) * array.seconds;
  const auto megabytes = static_cast<long>(
    std::ceil(std::max(kLeastMemory, kMoreMemory * array.memory / 1024.0 / 1024.0)));
  std::error_code ignored;
  fs::create_directories(place / "logs", ignored); // Slurm makes none and drops what is said
  char pilot[96];
  std::snprintf(pilot, sizeof pilot, "%.1f s and %.0f MiB", array.seconds,
    std::ceil(array.memory / 1024.0 / 1024.0));
  const std::string text = "#!/bin/sh\n# " + counted(array.count, "case") + ", " +
    std::to_string(chunk) + " a task; the pilot cases took at most " + pilot +
    ". Submit again for what is missing.\n"
    "#SBATCH --job-name=palp-sweep\n"
    "#SBATCH --array=0-" +
    std::to_string(last) +
    "\n#SBATCH --requeue\n#SBATCH --cpus-per-task=1\n#SBATCH --mem=" + std::to_string(megabytes) +
    "M\n#SBATCH --time=" + timeText(kMoreTime * each / 60.0) +
    "\n#SBATCH --open-mode=append\n#SBATCH --output=" +
    quoted((place / "logs" / "%a.txt").string()) + "\nexec " + program() + " sweep run " +
    quoted(place.string()) + " --chunk " + std::to_string(chunk) + '\n';
  replaceFile(place / kSlurmFile, text);
  return folder / kSlurmFile;
}

fs::path writeParallel(const fs::path& folder, std::size_t count)
{
  const fs::path place = plainPlace(folder);
  const std::string text = "#!/bin/sh\n# GNU parallel: a job for each case; run it again for what "
                           "failed.\n# \"$@\": -j 8, -S node1,node2\n"
                           "seq 0 " +
    std::to_string(count - 1) + " | exec parallel --joblog " + quoted((place / kJobLog).string()) +
    " --resume-failed \"$@\" " +
    quoted(program() + " sweep run " + quoted(place.string()) + " --case {}") + '\n';
  replaceFile(place / kParallelFile, text);
  return folder / kParallelFile;
}

} // namespace palp
