#pragma once

#include "tests/app/commands/victim.h"

#include <cstring>
#include <filesystem>
#include <map>
#include <poll.h>
#include <sys/inotify.h>
#include <unistd.h>

namespace palp::test
{

/// What happens to files in a folder and in those that are made there
class FileEvents
{
public:
  explicit FileEvents(const std::filesystem::path& folder)
    : queue_(inotify_init1(IN_CLOEXEC))
  {
    watch(folder);
  }

  ~FileEvents()
  {
    close(queue_);
  }
  FileEvents(const FileEvents&) = delete;
  FileEvents& operator=(const FileEvents&) = delete;

  /// Waits for so many; fewer when the victim ends before
  int wait(int most, const Victim& victim)
  {
    int seen = 0;
    while (seen < most)
    {
      pollfd ready{ .fd = queue_, .events = POLLIN, .revents = 0 };
      constexpr int pause = 20; // [ms]
      if (poll(&ready, 1, pause) > 0)
      {
        seen += read();
      }
      else if (victim.ended())
      {
        break;
      }
    }
    return seen;
  }

private:
  void watch(const std::filesystem::path& folder)
  {
    const int number = inotify_add_watch(queue_, folder.c_str(),
      IN_CREATE | IN_MOVE | IN_DELETE | IN_MODIFY | IN_CLOSE_WRITE | IN_ATTRIB);
    if (number >= 0)
    {
      folders_[number] = folder;
    }
    std::error_code gone;
    for (const auto& entry : std::filesystem::directory_iterator(folder, gone))
    {
      if (entry.is_directory(gone) && !entry.is_symlink(gone))
      {
        watch(entry.path());
      }
    }
  }

  int read()
  {
    alignas(inotify_event) char bytes[4096];
    const ssize_t size = ::read(queue_, bytes, sizeof bytes);
    int count = 0;
    for (ssize_t at = 0; at < size; ++count)
    {
      inotify_event event{};
      std::memcpy(&event, bytes + at, sizeof event);
      const bool isFolder = (event.mask & IN_ISDIR) != 0;
      if (isFolder && (event.mask & (IN_CREATE | IN_MOVED_TO)) != 0)
      {
        watch(folders_[event.wd] / (bytes + at + sizeof event));
      }
      at += static_cast<ssize_t>(sizeof event + event.len);
    }
    return count;
  }

  int queue_;
  std::map<int, std::filesystem::path> folders_;
};

} // namespace palp::test
