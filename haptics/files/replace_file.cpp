#include "haptics/files/replace_file.h"

#include "haptics/error.h"
#include "haptics/files/stage.h"

#include <cerrno>
#include <cstdio>
#include <fcntl.h>
#include <memory>
#include <sys/file.h>
#include <system_error>
#include <utility>

namespace palp
{
namespace
{

namespace fs = std::filesystem;

constexpr std::string_view kRandom = "XXXXXX"; // for mkdtemp

constexpr std::string_view kHidden = ".palp-";

// follows no link, as nobody can have one where only this process writes
void writeNew(const fs::path& file, std::string_view content)
{
  const Descriptor out(
    open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666));
  if (!out)
  {
    refuseFile(file, errno);
  }
  while (!content.empty())
  {
    const ssize_t written = write(out.get(), content.data(), content.size());
    if (written < 0 && errno != EINTR)
    {
      refuseFile(file, errno);
    }
    content.remove_prefix(written < 0 ? 0 : static_cast<std::size_t>(written));
  }
}

} // namespace

bool isHidden(const std::string& name)
{
  return name.starts_with(kHidden) && name.size() == kHidden.size() + kRandom.size();
}

fs::path makeHidden(const fs::path& folder)
{
  std::string name = (folder / kHidden).string().append(kRandom);
  return mkdtemp(name.data()) == nullptr ? fs::path() : fs::path(name);
}

Descriptor tryLockFolder(const fs::path& folder)
{
  Descriptor lock(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  return lock && flock(lock.get(), LOCK_EX | LOCK_NB) == 0 ? std::move(lock) : Descriptor();
}

int syncToDisk(const fs::path& path)
{
  const Descriptor file(open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC));
  // some systems cannot do it for a folder
  return file && (fsync(file.get()) == 0 || errno == EINVAL) ? 0 : errno;
}

std::string shownName(const fs::path& file)
{
  fs::path shown;
  for (const fs::path& part : file)
  {
    const std::string name = part.string();
    shown /= isHidden(name) || isStage(name) ? fs::path(folderOfStage(name)) : part;
  }
  return shown.string();
}

void refuseFile(const fs::path& file, int reason)
{
  throw Error(ErrorCode::BadFile,
    shownName(file) + ": cannot be written (" + std::generic_category().message(reason) +
      "); choose a folder with room where you may write");
}

void replaceFile(const fs::path& file, const std::function<void(const fs::path& fresh)>& write)
{
  const fs::path folder = file.has_parent_path() ? file.parent_path() : ".";
  clearStages(folder);
  const Stage stage = makeStage(folder);
  if (stage.path.empty())
  {
    refuseFile(file, errno);
  }
  const auto clean = [](const fs::path* hidden)
  {
    std::error_code ignored;
    fs::remove_all(*hidden, ignored);
  };
  const std::unique_ptr<const fs::path, decltype(clean)> cleaned(&stage.path, clean);
  const fs::path fresh = stage.path / file.filename();
  write(fresh);
  int failed = syncToDisk(fresh);
  if (failed == 0 && rename(fresh.c_str(), file.c_str()) != 0)
  {
    failed = errno;
  }
  if (failed != 0)
  {
    refuseFile(file, failed);
  }
  syncToDisk(folder);
}

void replaceFile(const fs::path& file, std::string_view content)
{
  replaceFile(file, [&](const fs::path& fresh) { writeNew(fresh, content); });
}

} // namespace palp
