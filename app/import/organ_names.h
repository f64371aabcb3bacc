#pragma once

#include "pipeline/process/file_organs.h"

#include <string>
#include <vector>

namespace palp
{

/// Names that stand once in a scene, and files of their own for them: letters, digits, dots,
/// hyphens and underscores, and a number behind one that another has.
/// @param other  name of one that has none, nor a label
void nameFiles(
  std::vector<FileOrgan>& organs, std::vector<std::string>& files, const std::string& other);

} // namespace palp
