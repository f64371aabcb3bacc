#pragma once

#include "app/input/mesh_file.h"

#include <map>
#include <string>
#include <vector>

namespace palp
{

/// Whether files that cases read are what they were when these were planned, while a sweep runs.
class InputWatch
{
public:
  /// @param hashes  SHA-256 by path, as planned; outlives this object
  explicit InputWatch(const std::map<std::string, std::string>& hashes);

  /// Those that hold something else than when they were planned; those that are gone are not meant.
  /// @param hashes  as of the constructor
  [[nodiscard]] static std::vector<std::string> edited(
    const std::map<std::string, std::string>& hashes);

  /// Before a case reads it: by its content where it may have changed since the last look.
  /// @throws Error  BadFile: it was edited after planning
  void check(const std::string& file);

  /// After a case has read them: nobody can tell what it read if they were touched since check().
  /// @param number  of the case
  /// @throws Error  BadFile: somebody touched one
  void refuseTouched(const std::vector<std::string>& files, std::size_t number) const;

private:
  [[nodiscard]] static std::string shown(const std::string& file);

  const std::map<std::string, std::string>& hashes_;
  std::map<std::string, FileStamps> seen_;
};

} // namespace palp
