#pragma once

#include <filesystem>
#include <string>
#include <system_error>

namespace palp
{

/// Where a sweep's folder keeps what. Cases lie in 4096 folders by the first digits of their names,
/// so that a million of them makes folders of some 240.
struct CaseFolders
{
  std::filesystem::path sweep;

  [[nodiscard]] std::filesystem::path plan() const
  {
    return sweep / "cases.csv";
  }
  [[nodiscard]] std::filesystem::path results() const
  {
    return sweep / "results";
  }
  [[nodiscard]] std::filesystem::path failures() const
  {
    return sweep / "failed";
  }
  [[nodiscard]] std::filesystem::path claims() const
  {
    return sweep / "running";
  }
  [[nodiscard]] std::filesystem::path result(const std::string& name) const
  {
    return results() / shard(name) / name;
  }
  [[nodiscard]] std::filesystem::path failure(const std::string& name) const
  {
    return failures() / shard(name) / name;
  }

  /// Whether a file is one of the sweep's own, which no other may replace.
  [[nodiscard]] bool owns(const std::filesystem::path& file) const
  {
    std::error_code unknown;
    const std::filesystem::path below =
      std::filesystem::weakly_canonical(file, unknown)
        .lexically_relative(std::filesystem::weakly_canonical(sweep, unknown));
    const std::filesystem::path first = below.empty() ? below : *below.begin();
    return first == results().filename() || first == failures().filename() ||
      first == claims().filename() || first == plan().filename();
  }

  /// @throws Error  BadFile: nobody may look
  [[nodiscard]] bool isDone(const std::string& name) const;

private:
  [[nodiscard]] static std::string shard(const std::string& name)
  {
    return name.substr(0, 3);
  }
};

constexpr const char* kCaseFile = "case.json"; ///< of a finished or failed case: what, how long
constexpr const char* kLogFile = "log.txt";    ///< what its command said

/// Ends the reading of a folder or file with what the system said.
/// @throws Error  BadFile
[[noreturn]] void refuseUnread(const std::filesystem::path& place, const std::error_code& why);

constexpr const char* kSlurmFile = "sweep.sbatch";
constexpr const char* kParallelFile = "parallel.sh";
constexpr const char* kJobLog = "parallel.log"; ///< of GNU parallel, which counts cases as jobs

} // namespace palp
