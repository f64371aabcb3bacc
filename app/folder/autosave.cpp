#include "app/folder/autosave.h"

#include "app/folder/export_folder.h"
#include "app/press/export.h"
#include "haptics/files/replace_file.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <exception>
#include <system_error>
#include <utility>

namespace palp
{
namespace
{

namespace fs = std::filesystem;

constexpr const char* kDiscarded = ".discarded"; // no press, so that nobody offers it

// whole, or hidden
bool isPress(const fs::path& folder)
{
  return folder.filename().string().front() != '.' && isExport(folder);
}

std::vector<fs::path> foldersIn(const fs::path& folder)
{
  std::error_code none;
  std::vector<fs::path> folders;
  for (const auto& entry : fs::directory_iterator(folder, none))
  {
    if (entry.is_directory(none) && !entry.is_symlink(none))
    {
      folders.push_back(entry.path());
    }
  }
  std::ranges::sort(folders);
  return folders;
}

void write(const fs::path& folder, const ScenePlan& plan, const Recording& press)
{
  const fs::path stage = makeHidden(folder.parent_path());
  if (stage.empty())
  {
    refuseFile(folder, errno);
  }
  writeSamples(stage / "samples.csv", press, nullptr);
  writeProvenance(stage, plan, press);
  writeScene(stage, plan, "");
  fs::rename(stage, folder);
}

void setNames(const fs::path& folder, const std::vector<std::string>& names)
{
  std::error_code none; // it may be gone, as the oldest are
  const fs::path aside = folder.parent_path() / ('.' + folder.filename().string());
  names.empty() ? fs::rename(folder, aside, none) : fs::rename(aside, folder, none);
  if (!names.empty() && isExport(folder))
  {
    const fs::file_time_type made = fs::last_write_time(folder);
    ScenePlan plan = readExport(folder).plan;
    plan.recording ? void(plan.recording->names = names) : void();
    writeScene(folder, plan, "");
    fs::last_write_time(folder, made); // by which presses stay in their order
  }
}

} // namespace

fs::path Autosave::usualRoot()
{
  const char* state = std::getenv("XDG_STATE_HOME"); // NOLINT(concurrency-mt-unsafe): none is set
  const char* home = std::getenv("HOME");            // NOLINT(concurrency-mt-unsafe)
  const fs::path base = state != nullptr && *state == '/' ? fs::path(state)
    : home != nullptr                                     ? fs::path(home) / ".local/state"
                                                          : fs::path();
  return base.empty() ? base : base / "palp" / "presses";
}

Autosave::Autosave(fs::path root, int most)
  : root_(std::move(root))
  , most_(most)
{
  std::error_code none;
  fs::create_directories(root_, none);
  own_ = makeHidden(root_);
  if (!own_.empty())
  {
    lock_ = tryLockFolder(own_);
  }
  for (const fs::path& program : ended())
  {
    fs::remove_all(program / kDiscarded, none); // where it was killed before its end
  }
}

Autosave::~Autosave()
{
  if (written_.valid())
  {
    written_.wait();
  }
  std::error_code none;
  own_.empty() ? 0 : fs::remove_all(own_ / kDiscarded, none);
  fs::remove(own_, none); // where nothing is in it
}

// by their names in their order
fs::path Autosave::folderOf(int press) const
{
  return own_ / std::to_string(1'000'000 + press);
}

// one after the other
void Autosave::later(std::function<void()> write)
{
  written_ = std::async(std::launch::async,
    [before = std::move(written_), write = std::move(write)]() mutable
    {
      std::exception_ptr failed;
      try
      {
        before.valid() ? before.get() : void();
      }
      catch (...)
      {
        failed = std::current_exception(); // which is no reason not to try this one
      }
      write();
      failed ? std::rethrow_exception(failed) : void();
    });
}

void Autosave::save(ScenePlan plan, Recording press)
{
  if (own_.empty())
  {
    return;
  }
  ++count_;
  later(
    [this, next = Unwritten{ count_, std::move(plan), std::move(press), {} }]() mutable
    {
      fs::remove_all(folderOf(next.number - most_));
      unwritten_.push_back(std::move(next));
      std::erase_if(unwritten_,
        [&](const Unwritten& one) { return one.number <= unwritten_.back().number - most_; });
      writeAll();
    });
}

// until one cannot be
void Autosave::writeAll()
{
  while (!unwritten_.empty())
  {
    const auto& [number, plan, press, names] = unwritten_.front();
    write(folderOf(number), plan, press);
    names ? setNames(folderOf(number), *names) : void();
    unwritten_.erase(unwritten_.begin());
  }
}

void Autosave::update(int press, std::vector<std::string> names)
{
  later(
    [this, press, folder = folderOf(press), names = std::move(names)]
    {
      const auto waiting = std::ranges::find(unwritten_, press, &Unwritten::number);
      waiting != unwritten_.end() ? void(waiting->names = names) : setNames(folder, names);
    });
}

bool Autosave::has(int press)
{
  if (written_.valid())
  {
    written_.wait();
  }
  return !own_.empty() && isExport(folderOf(press));
}

void Autosave::check()
{
  if (written_.valid() && written_.wait_for(std::chrono::seconds(0)) == std::future_status::ready)
  {
    written_.get();
  }
}

void Autosave::clear(int last)
{
  if (written_.valid())
  {
    written_.wait();
  }
  std::erase_if(unwritten_, [last](const Unwritten& one) { return one.number <= last; });
  std::error_code none;
  const std::string end = folderOf(std::min(last, count_)).filename();
  for (const fs::path& press : foldersIn(own_))
  {
    const std::string name = press.filename();
    name.substr(name.front() == '.' ? 1 : 0) <= end ? fs::remove_all(press, none) : 0;
  }
}

// the folders of programs that have
std::vector<fs::path> Autosave::ended() const
{
  std::vector<fs::path> programs = foldersIn(root_);
  std::erase_if(programs,
    [this](const fs::path& program) { return program == own_ || !tryLockFolder(program); });
  return programs;
}

std::vector<fs::path> Autosave::left() const
{
  std::vector<fs::path> presses;
  for (const fs::path& program : ended())
  {
    std::ranges::copy_if(foldersIn(program), std::back_inserter(presses), isPress);
  }
  const auto age = [](const fs::path& folder)
  {
    std::error_code none;
    return fs::last_write_time(folder, none);
  };
  std::ranges::stable_sort(presses, {}, age);
  return presses;
}

int Autosave::adopt(const fs::path& press)
{
  std::error_code failed;
  fs::rename(press, folderOf(count_ + 1), failed);
  if (failed)
  {
    return 0;
  }
  if (const fs::path program = press.parent_path();
      std::ranges::none_of(foldersIn(program), isPress))
  {
    fs::remove_all(program, failed);
  }
  return ++count_;
}

void Autosave::discard()
{
  if (own_.empty())
  {
    return;
  }
  std::error_code none;
  fs::create_directory(own_ / kDiscarded, none);
  for (const fs::path& program : ended())
  {
    fs::rename(program, own_ / kDiscarded / program.filename(), none);
  }
}

void Autosave::undiscard()
{
  for (const fs::path& program : foldersIn(own_ / kDiscarded))
  {
    std::error_code none;
    fs::rename(program, root_ / program.filename(), none);
  }
}

} // namespace palp
