#include "haptics/files/replace_file.h"

#include "haptics/error.h"
#include "haptics/files/descriptor.h"

#include <cerrno>
#include <chrono>
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

constexpr std::string_view kWaiting = ".palp-file-"; // of a single file

constexpr std::chrono::minutes kMoment{ 1 }; // far more than from making a folder to locking it

fs::path makeNamed(const fs::path& folder, std::string_view start)
{
  std::string name = (folder / start).string().append(kRandom);
  return mkdtemp(name.data()) == nullptr ? fs::path() : fs::path(name);
}

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

std::string hiddenStart(const std::string& of)
{
  return (of.empty() ? "" : "." + of) + std::string(kHidden);
}

bool isHidden(const std::string& name, const std::string& start)
{
  return name.starts_with(start) && name.size() == start.size() + kRandom.size();
}

fs::path makeHidden(const fs::path& folder)
{
  return makeNamed(folder, kHidden);
}

Descriptor tryLockFolder(const fs::path& folder)
{
  Descriptor lock(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  return lock && flock(lock.get(), LOCK_EX | LOCK_NB) == 0 ? std::move(lock) : Descriptor();
}

void clearAbandoned(const fs::path& folder)
{
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored))
  {
    const bool isWaiting = isHidden(entry.path().filename().string(), std::string(kWaiting));
    if (isWaiting && fs::file_time_type::clock::now() - entry.last_write_time(ignored) > kMoment &&
      tryLockFolder(entry.path()))
    {
      fs::remove_all(entry.path(), ignored);
    }
  }
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
    shown /= isHidden(name) || isHidden(name, std::string(kWaiting)) ? fs::path() : part;
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
  const fs::path stage = makeNamed(folder, kWaiting);
  if (stage.empty())
  {
    refuseFile(file, errno);
  }
  const Descriptor lock = tryLockFolder(stage);
  const auto clean = [](const fs::path* hidden)
  {
    std::error_code ignored;
    fs::remove_all(*hidden, ignored);
  };
  const std::unique_ptr<const fs::path, decltype(clean)> cleaned(&stage, clean);
  const fs::path fresh = stage / file.filename();
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
