#pragma once

#include "haptics/files/descriptor.h"

#include <filesystem>
#include <string>
#include <vector>

namespace palp
{

/// A hidden folder in which files wait until they are finished, locked as long as this lives and
/// its process: whether its run is alive is known by that. Whoever made it removes it.
struct Stage
{
  std::filesystem::path path{}; ///< empty: none
  Descriptor lock{};
};

/// Makes one, which bears the name that clearStages() knows only once it is locked.
///
/// @param folder  where it stands
/// @param of      name of the folder beside it whose files wait in it; empty: a single file's
/// @return        none, with errno, where it cannot be made
[[nodiscard]] Stage makeStage(const std::filesystem::path& folder, const std::string& of = {});

/// Whether a name is that of a stage.
[[nodiscard]] bool isStage(const std::string& name);

/// Name of the folder beside a stage whose files wait in it; empty: there is none.
[[nodiscard]] std::string folderOfStage(const std::string& name);

/// In a stage that is complete: the names of files that go without another in their place.
inline constexpr const char* kDropped = ".dropped";

/// Ends what a killed process began, a complete stage of this user whose files were being put into
/// a folder; nothing where it is another one.
void finishStage(const std::filesystem::path& stage, const std::filesystem::path& folder);

/// Renames all files of a stage into a folder, but for kDropped.
/// @return  0, or errno
int emptyStage(const std::filesystem::path& stage, const std::filesystem::path& folder);

/// Removes from a folder the stages of processes that are no more, and finishes the complete ones.
/// What another process is writing stays, and where there are no locks all that may be.
///
/// @param held  name of a folder in it that the caller has locked, so that its stages are dead
void clearStages(const std::filesystem::path& folder, const std::string& held = {});

/// Names in a folder, in order; none where it cannot be read.
[[nodiscard]] std::vector<std::string> namesIn(const std::filesystem::path& folder);

} // namespace palp
