#include "haptics/files/stage.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <fcntl.h>
#include <fstream>
#include <string_view>
#include <sys/file.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace palp
{
namespace
{

namespace fs = std::filesystem;

constexpr std::string_view kOpen = "XXXXXX"; // for mkdtemp

constexpr std::string_view kBeside = ".palp-";

constexpr std::string_view kOfFile = ".palp-file-"; // of a single file

constexpr std::string_view kFresh = ".palp-new-"; // until it is locked

bool isNamed(std::string_view name, std::string_view start)
{
  return name.starts_with(start) && name.size() == start.size() + kOpen.size();
}

bool isOfThisUser(const fs::path& folder)
{
  struct stat is = {};
  return lstat(folder.c_str(), &is) == 0 && S_ISDIR(is.st_mode) && is.st_uid == geteuid();
}

// isHeld: nobody can write there, but another process may be clearing it
Descriptor lockOfDead(const fs::path& stage, bool isHeld)
{
  Descriptor lock(open(stage.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
  const bool isLocked = lock && flock(lock.get(), isHeld ? LOCK_EX : LOCK_EX | LOCK_NB) == 0;
  return isLocked || isHeld ? std::move(lock) : Descriptor();
}

} // namespace

Stage makeStage(const fs::path& folder, const std::string& of)
{
  const std::string start = of.empty() ? std::string(kOfFile) : "." + of + std::string(kBeside);
  for (;;)
  {
    std::string name = (folder / kFresh).string().append(kOpen);
    if (mkdtemp(name.data()) == nullptr)
    {
      return {};
    }
    Descriptor lock(open(name.c_str(), O_RDONLY | O_CLOEXEC));
    const bool isTaken = lock && flock(lock.get(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    const fs::path path = folder / (start + name.substr(name.size() - kOpen.size()));
    if (!isTaken &&
      renameat2(AT_FDCWD, name.c_str(), AT_FDCWD, path.c_str(), RENAME_NOREPLACE) == 0)
    {
      return { .path = path, .lock = std::move(lock) };
    }
    const int reason = errno;
    rmdir(name.c_str());
    errno = reason;
    if (reason != EWOULDBLOCK && reason != ENOENT) // else it was cleared before it was locked
    {
      return {};
    }
  }
}

std::string folderOfStage(const std::string& name)
{
  const std::size_t end = kBeside.size() + kOpen.size();
  const bool isBeside = name.starts_with('.') && name.size() > end + 1 &&
    std::string_view(name).substr(name.size() - end, kBeside.size()) == kBeside;
  return isBeside ? name.substr(1, name.size() - end - 1) : std::string();
}

bool isStage(const std::string& name)
{
  return isNamed(name, kOfFile) || !folderOfStage(name).empty();
}

void finishStage(const fs::path& stage, const fs::path& folder)
{
  std::ifstream dropped(stage / kDropped);
  if (!dropped || !isOfThisUser(stage))
  {
    return;
  }
  for (std::string name; std::getline(dropped, name);)
  {
    unlink((folder / fs::path(name).filename()).c_str()); // nowhere else
  }
  (void)emptyStage(stage, folder);
}

int emptyStage(const fs::path& stage, const fs::path& folder)
{
  for (const std::string& name : namesIn(stage))
  {
    if (name != kDropped && rename((stage / name).c_str(), (folder / name).c_str()) != 0)
    {
      return errno;
    }
  }
  return 0;
}

void clearStages(const fs::path& folder, const std::string& held)
{
  std::error_code ignored;
  for (const std::string& name : namesIn(folder))
  {
    const fs::path stage = folder / name;
    if (!(isStage(name) || isNamed(name, kFresh)) || !isOfThisUser(stage))
    {
      continue;
    }
    const std::string of = folderOfStage(name);
    if (const Descriptor lock = lockOfDead(stage, !held.empty() && of == held))
    {
      of.empty() ? void() : finishStage(stage, folder / of);
      fs::remove_all(stage, ignored);
    }
  }
}

std::vector<std::string> namesIn(const fs::path& folder)
{
  std::vector<std::string> names;
  std::error_code failed;
  for (const auto& entry : fs::directory_iterator(folder, failed))
  {
    names.push_back(entry.path().filename().string());
  }
  std::ranges::sort(names);
  return names;
}

} // namespace palp
