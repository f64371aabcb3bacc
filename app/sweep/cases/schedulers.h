#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace palp
{

/// How a Slurm job array runs a sweep.
struct SlurmArray
{
  std::size_t count = 1; ///< of the cases
  std::size_t tasks = 1; ///< of the array
  double seconds = 0.0;  ///< of the longest pilot case
  double memory = 0.0;   ///< of the largest one [bytes]

  /// Cases of one task.
  [[nodiscard]] std::size_t chunk() const
  {
    return (count + tasks - 1) / tasks;
  }
};

constexpr std::size_t kMostTasks = 1000; ///< that Slurm takes in an array by default, MaxArraySize

/// The folder of a sweep as schedulers find it from everywhere.
/// @return        its absolute path
/// @throws Error  BadValue: it has characters that Slurm or GNU parallel read in another way
[[nodiscard]] std::filesystem::path plainPlace(const std::filesystem::path& folder);

/// Writes sweep.sbatch into the folder of a sweep: a task for each chunk of cases, with twice the
/// memory and four times the time of the pilot cases.
/// @return        the file
/// @throws Error  BadFile: cannot be written; else as plainPlace
[[nodiscard]] std::filesystem::path writeSlurm(
  const std::filesystem::path& folder, const SlurmArray& array);

/// Writes parallel.sh there: a line of GNU parallel, a job for each case, that begins again where
/// it ended.
/// @throws Error  as writeSlurm
[[nodiscard]] std::filesystem::path writeParallel(
  const std::filesystem::path& folder, std::size_t count);

} // namespace palp
