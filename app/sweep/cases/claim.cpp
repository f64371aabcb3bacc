#include "app/sweep/cases/claim.h"

#include "haptics/error.h"
#include "haptics/files/replace_file.h"

#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <fcntl.h>
#include <fstream>
#include <sstream>
#include <sys/stat.h>

namespace palp
{
namespace
{

namespace fs = std::filesystem;

constexpr const char* kOwner = "owner";

std::string contentOf(const fs::path& file)
{
  std::ifstream in(file);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

// the kernel that counts the processes, by its start and, in a container, its numbering
std::string machine()
{
  std::string boot = contentOf("/proc/sys/kernel/random/boot_id");
  std::error_code unknown;
  return boot.substr(0, boot.find('\n')) + ' ' +
    fs::read_symlink("/proc/self/ns/pid", unknown).string();
}

// what the kernel tells of a process
struct Process
{
  std::string state; // T and t: stopped
  std::string begin; // by the kernel's clock, since numbers of processes come again
};

Process processOf(const std::string& number)
{
  const std::string stat = contentOf("/proc/" + number + "/stat");
  const std::size_t name = stat.rfind(')');
  std::istringstream rest(name == stat.npos ? "" : stat.substr(name + 1));
  constexpr int kStartTime = 20; // of the words after the name, of which the state is the first
  Process process;
  rest >> process.state;
  for (int i = 1; i < kStartTime; ++i)
  {
    rest >> process.begin;
  }
  return process;
}

struct Owner
{
  std::string machine;
  std::string process;
  std::string begin;
};

std::string textOf(const Owner& owner)
{
  return owner.machine + '\n' + owner.process + '\n' + owner.begin + '\n';
}

Owner ownerOf(const std::string& text)
{
  std::istringstream lines(text);
  Owner owner;
  for (std::string* part : { &owner.machine, &owner.process, &owner.begin })
  {
    std::getline(lines, *part);
  }
  return owner;
}

// a moment of the disk's clock [s]; opening makes a network ask anew
std::optional<double> beatOf(const fs::path& file)
{
  const Descriptor in(open(file.c_str(), O_RDONLY | O_CLOEXEC));
  struct stat is = {};
  return in && fstat(in.get(), &is) == 0 ? std::optional(static_cast<double>(is.st_mtim.tv_sec) +
                                             1e-9 * static_cast<double>(is.st_mtim.tv_nsec))
                                         : std::nullopt;
}

std::optional<double> diskTime(const fs::path& folder)
{
  const fs::path probe = makeHidden(folder);
  const auto now = beatOf(probe);
  rmdir(probe.c_str());
  return now;
}

// whether a folder or file was left alone for long
bool isSilent(const fs::path& file, std::optional<double> now)
{
  const auto beat = beatOf(file);
  return beat && now && std::abs(*now - *beat) > kSilence; // ahead where that clock was set back
}

// text: of its owner; empty where one ended while it gave the claim up
bool isGone(const fs::path& claim, const std::string& text)
{
  const Owner owner = ownerOf(text);
  if (owner.machine == machine())
  {
    const Process process = processOf(owner.process);
    const bool isStopped = process.state == "T" || process.state == "t";
    if (process.begin != owner.begin || !isStopped)
    {
      return process.begin != owner.begin;
    }
  }
  return isSilent(text.empty() ? claim : claim / kOwner, diskTime(claim.parent_path()));
}

// out of the way of others first, as a whole; only if it is still that owner's
void removeClaim(const fs::path& claim, const std::string& text)
{
  const fs::path hidden = makeHidden(claim.parent_path());
  std::error_code ignored;
  if (hidden.empty()) // a full disk
  {
    fs::remove_all(claim, ignored);
    return;
  }
  if (rename(claim.c_str(), (hidden / kOwner).c_str()) == 0 &&
    contentOf(hidden / kOwner / kOwner) != text)
  {
    rename((hidden / kOwner).c_str(), claim.c_str()); // of one that took it over in between
  }
  fs::remove_all(hidden, ignored);
}

bool tryRename(const fs::path& from, const fs::path& to)
{
  if (rename(from.c_str(), to.c_str()) == 0)
  {
    return true;
  }
  if (errno != ENOTEMPTY && errno != EEXIST)
  {
    refuseFile(to, errno);
  }
  return false;
}

} // namespace

Claim::Claim(fs::path claim, fs::path folder, std::string owner)
  : claim_(std::move(claim))
  , folder_(std::move(folder))
  , owner_(std::move(owner))
  , file_(open((claim_ / kOwner).c_str(), O_RDWR | O_CLOEXEC))
{
}

std::optional<Claim> Claim::take(const fs::path& claims, const std::string& name)
{
  const fs::path claim = claims / name;
  const std::string process = std::to_string(getpid());
  const std::string begin = processOf(process).begin;
  const std::string mine = textOf({ machine(), process, begin });
  // of nobody else, for one that was taken for gone may go on in its own
  const std::string work = process + '-' + begin;
  const fs::path fresh = makeHidden(claims);
  if (fresh.empty())
  {
    refuseFile(claim, errno);
  }
  std::error_code ignored;
  if (!fs::create_directory(fresh / work, ignored) ||
    !(std::ofstream(fresh / kOwner) << mine).flush())
  {
    const int reason = errno;
    fs::remove_all(fresh, ignored);
    refuseFile(claim, reason);
  }
  bool taken = tryRename(fresh, claim);
  const std::string other = taken ? "" : contentOf(claim / kOwner);
  if (!taken && isGone(claim, other))
  {
    removeClaim(claim, other);
    taken = tryRename(fresh, claim);
  }
  if (!taken)
  {
    fs::remove_all(fresh, ignored);
    return std::nullopt;
  }
  return Claim(claim, claim / work, mine);
}

bool Claim::isHeld(const fs::path& claims, const std::string& name)
{
  return fs::exists(claims / name) && !isGone(claims / name, contentOf(claims / name / kOwner));
}

void Claim::tidy(const fs::path& claims)
{
  const auto now = diskTime(claims);
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(claims, ignored))
  {
    if (isHidden(entry.path().filename().string()) && isSilent(entry.path(), now))
    {
      fs::remove_all(entry.path(), ignored);
    }
  }
}

void Claim::beat() const
{
  futimens(file_.get(), nullptr); // by the clock of the disk
}

bool Claim::isOurs() const
{
  return contentOf(claim_ / kOwner) == owner_ && fs::exists(folder_);
}

void Claim::release() const
{
  removeClaim(claim_, owner_);
}

} // namespace palp
