#include "haptics/files/output_folder.h"

#include "haptics/error.h"
#include "haptics/files/listed.h"
#include "haptics/files/replace_file.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/xattr.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace palp
{
namespace
{

namespace fs = std::filesystem;

Descriptor openFolder(const fs::path& folder)
{
  return Descriptor(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
}

bool isSame(const struct stat& a, const struct stat& b)
{
  return a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

bool isThere(const fs::path& file)
{
  std::error_code unknown;
  return fs::exists(fs::symlink_status(file, unknown));
}

bool isFolder(const fs::path& file)
{
  std::error_code unknown;
  return fs::is_directory(fs::symlink_status(file, unknown));
}

// stages that stand in a folder itself; only who holds its lock may ask
void clearHidden(const fs::path& folder)
{
  std::error_code ignored;
  for (const std::string& name : namesIn(folder))
  {
    if (isHidden(name))
    {
      finishStage(folder / name, folder);
      fs::remove_all(folder / name, ignored);
    }
  }
}

std::vector<fs::path> missingFolders(const fs::path& folder)
{
  std::vector<fs::path> missing;
  for (fs::path at = fs::absolute(folder).lexically_normal(); !isThere(at); at = at.parent_path())
  {
    missing.push_back(at);
  }
  return missing;
}

// anew where another run exchanged or removed the folder in between
Descriptor lockFolder(const fs::path& folder)
{
  for (;;)
  {
    std::error_code failed;
    fs::create_directories(folder, failed);
    Descriptor lock = openFolder(folder);
    if (!lock)
    {
      refuseFile(folder, failed ? failed.value() : errno);
    }
    // a file system without locks goes without
    if (flock(lock.get(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    {
      throw Error(ErrorCode::BadFile,
        folder.string() +
          ": another palp is writing there; wait until it is done, or choose another folder");
    }
    struct stat mine = {};
    struct stat now = {};
    if (fstat(lock.get(), &mine) == 0 && stat(folder.c_str(), &now) == 0 && isSame(mine, now))
    {
      return lock;
    }
  }
}

// whether files have in a new folder the rights that they would have in this one
bool isAlike(const fs::path& folder, const fs::path& stage)
{
  struct stat is = {};
  struct stat fresh = {};
  return stat(folder.c_str(), &is) == 0 && stat(stage.c_str(), &fresh) == 0 &&
    is.st_dev == fresh.st_dev && is.st_uid == fresh.st_uid && is.st_gid == fresh.st_gid &&
    getxattr(folder.c_str(), "system.posix_acl_access", nullptr, 0) <= 0 &&
    getxattr(folder.c_str(), "system.posix_acl_default", nullptr, 0) <= 0;
}

// whether a new folder can stand for this one: nothing else in it, and nobody works there
bool isPlain(const fs::path& folder, const fs::path& stage, const std::vector<std::string>& gone)
{
  struct stat is = {};
  struct stat here = {};
  return stat(folder.c_str(), &is) == 0 && !(stat(".", &here) == 0 && isSame(is, here)) &&
    namesIn(folder).size() == gone.size() && chmod(stage.c_str(), is.st_mode & 07777U) == 0;
}

// empties the folder that was exchanged, but for what somebody has just put there
void clear(const fs::path& old, const fs::path& folder, const std::vector<std::string>& gone)
{
  for (const std::string& name : gone)
  {
    unlink((old / name).c_str());
  }
  for (const std::string& name : namesIn(old))
  {
    renameat2(AT_FDCWD, (old / name).c_str(), AT_FDCWD, (folder / name).c_str(), RENAME_NOREPLACE);
  }
  rmdir(old.c_str());
}

} // namespace

OutputFolder::OutputFolder(fs::path folder, std::vector<std::string> own, Earlier earlier)
  : shown_(std::move(folder))
  , own_(std::move(own))
  , earlier_(earlier)
  , made_(missingFolders(shown_))
{
  std::ranges::sort(own_);
  lock_ = lockFolder(shown_);
  folder_ = fs::canonical(shown_);
  clearHidden(folder_);
  clearStages(folder_);
  clearStages(folder_.parent_path(), folder_.filename());
  try
  {
    found_ = there(own_);
    (void)stage(); // tells before any work whether anything may be written
  }
  catch (...)
  {
    discard();
    throw;
  }
}

std::string OutputFolder::there(const std::vector<std::string>& names) const
{
  std::string found;
  for (const std::string& name : names)
  {
    if (isFolder(folder_ / name))
    {
      refuseFile(shown_ / name, EISDIR);
    }
    if (isThere(folder_ / name))
    {
      addListed(found, name);
    }
  }
  if (earlier_ == Earlier::Refuse && !found.empty())
  {
    throw Error(ErrorCode::BadFile,
      shown_.string() + ": holds " + found +
        " already; pass --overwrite to replace that, or choose another folder");
  }
  return found;
}

std::string OutputFolder::expect(const std::vector<std::string>& names) const
{
  std::vector<std::string> others = names;
  std::erase_if(
    others, [this](const std::string& name) { return std::ranges::binary_search(own_, name); });
  return there(others);
}

OutputFolder::~OutputFolder()
{
  discard();
}

// beside the folder, for whoever writes there to clear, or in it where that would be another's
fs::path OutputFolder::stage()
{
  const std::lock_guard guard(mutex_);
  if (stage_.path.empty())
  {
    stage_ = makeStage(folder_.parent_path(), folder_.filename());
    isBeside_ = !stage_.path.empty() && isAlike(folder_, stage_.path);
    if (!isBeside_)
    {
      stage_.path.empty() ? 0 : rmdir(stage_.path.c_str());
      stage_ = Stage{ .path = makeHidden(folder_) };
    }
    if (stage_.path.empty())
    {
      refuseFile(shown_, errno);
    }
  }
  return stage_.path;
}

void OutputFolder::publish()
{
  const std::lock_guard guard(mutex_);
  const std::vector<std::string> staged =
    stage_.path.empty() ? std::vector<std::string>{} : namesIn(stage_.path);
  std::vector<std::string> gone;
  std::ranges::set_union(own_, staged, std::back_inserter(gone));
  std::erase_if(gone, [&](const std::string& name) { return !isThere(folder_ / name); });
  for (const std::string& name : gone)
  {
    if (earlier_ == Earlier::Refuse || isFolder(folder_ / name))
    {
      refuseFile(shown_ / name, EEXIST);
    }
  }
  for (const std::string& name : staged)
  {
    if (const int failed = syncToDisk(stage_.path / name))
    {
      refuseFile(shown_ / name, failed);
    }
  }
  if (earlier_ == Earlier::Keep || !exchange(gone))
  {
    renameInto(earlier_ == Earlier::Keep ? std::vector<std::string>{} : gone);
  }
  removeStage();
  made_.clear();
  earlier_ = Earlier::Keep;
}

bool OutputFolder::exchange(const std::vector<std::string>& gone)
{
  if (!isBeside_ || !isPlain(folder_, stage_.path, gone))
  {
    return false;
  }
  syncToDisk(stage_.path);
  if (renameat2(AT_FDCWD, stage_.path.c_str(), AT_FDCWD, folder_.c_str(), RENAME_EXCHANGE) != 0)
  {
    return false;
  }
  syncToDisk(folder_.parent_path());
  std::swap(lock_, stage_.lock);
  clear(stage_.path, folder_, gone);
  return true;
}

// old files go before the first new one comes, so that no two runs are seen together
void OutputFolder::renameInto(const std::vector<std::string>& gone) const
{
  std::string dropped;
  for (const std::string& name : gone)
  {
    dropped += isThere(stage_.path / name) ? "" : name + '\n';
  }
  replaceFile(stage_.path / kDropped, dropped); // from here on the next run would finish this
  for (const std::string& name : gone)
  {
    unlink((folder_ / name).c_str());
  }
  if (const int failed = emptyStage(stage_.path, folder_))
  {
    refuseFile(shown_, failed);
  }
  syncToDisk(folder_);
}

void OutputFolder::removeStage() noexcept
{
  constexpr int kTries = 100; // other threads may still write there, before they fail
  std::error_code ignored;
  for (int i = 0; i < kTries && !stage_.path.empty() && isThere(stage_.path); ++i)
  {
    fs::remove_all(stage_.path, ignored);
  }
  stage_ = Stage();
}

void OutputFolder::discard() noexcept
{
  const std::lock_guard guard(mutex_);
  removeStage();
  for (const fs::path& folder : made_)
  {
    rmdir(folder.c_str());
  }
}

} // namespace palp
