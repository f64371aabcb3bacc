#pragma once

#include "haptics/files/descriptor.h"
#include "haptics/files/stage.h"

#include <filesystem>
#include <mutex>
#include <string>
#include <vector>

namespace palp
{

/// The folder that a run writes: no other run writes there meanwhile, and its files appear
/// together, so that whatever ends the run the folder holds one run's files.
///
/// A run writes into stage(), a hidden folder beside it, and publishes at its end. The whole folder
/// is then exchanged for the new one in one step. Where that cannot be (it holds other files, is
/// the working directory, a mount point or of other rights) the earlier files are removed and the
/// new ones renamed, one after the other: a crash in between leaves some missing until the next run
/// there or beside it, which ends that first, but never two runs' files beside each other.
class OutputFolder
{
public:
  /// What becomes of files that an earlier run left.
  enum class Earlier
  {
    Refuse,  ///< the run does not begin
    Replace, ///< all of them go when the first new ones appear
    Keep,    ///< the run goes on with them
  };

  /// Locks the folder, which is made when it is missing, and clears what killed runs left there and
  /// beside it, or ends their publishing.
  ///
  /// @param own     names of all files that such a run may leave
  /// @throws Error  BadFile: cannot be made or written, another run writes there, or Refuse and
  ///                one of the files is there
  OutputFolder(std::filesystem::path folder, std::vector<std::string> own, Earlier earlier);

  /// What is not published goes, and the folder itself if it was made here and stayed empty.
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const noexcept
  {
    return shown_;
  }

  /// Those of the own files that were there at the start, as words; empty: none.
  [[nodiscard]] const std::string& found() const noexcept
  {
    return found_;
  }

  /// Files that the run may leave besides, whose names are known only by now; they are replaced
  /// where they are staged.
  /// @return        those of them that are there and no own ones, as words
  /// @throws Error  BadFile: Refuse and one of the files is there
  [[nodiscard]] std::string expect(const std::vector<std::string>& names) const;

  /// Where files are written until they are published; empty again after that.
  /// @throws Error  BadFile
  [[nodiscard]] std::filesystem::path stage();

  /// Brings what is staged to the disk and into the folder. What comes after the first time is of
  /// the same run and replaces file by file.
  /// @throws Error  BadFile: the folder is as before
  void publish();

  /// Removes what is staged; any thread may.
  void discard() noexcept;

private:
  [[nodiscard]] std::string there(const std::vector<std::string>& names) const;
  [[nodiscard]] bool exchange(const std::vector<std::string>& gone);
  void renameInto(const std::vector<std::string>& gone) const;
  void removeStage() noexcept;

  std::filesystem::path shown_;  // as the user named it
  std::filesystem::path folder_; // absolute, no links
  std::vector<std::string> own_;
  Earlier earlier_;
  std::string found_;
  std::vector<std::filesystem::path> made_; // the folder and those above it, deepest first
  Stage stage_;
  bool isBeside_ = false; // the stage, else in the folder
  std::mutex mutex_;
  Descriptor lock_;
};

} // namespace palp
