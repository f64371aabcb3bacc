#include "tests/haptics/files/output_rig.h"
#include "tests/support/file_calls.h"

#include "haptics/error.h"

#include <chrono>
#include <csignal>
#include <functional>
#include <gtest/gtest.h>
#include <set>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

namespace palp
{
namespace
{

using Names = std::set<std::string>;

Names setOf(const std::filesystem::path& folder)
{
  const std::vector<std::string> names = namesIn(folder);
  return { names.begin(), names.end() };
}

std::string refusal(const std::function<void()>& work)
{
  try
  {
    work();
  }
  catch (const Error& error)
  {
    EXPECT_EQ(error.code(), ErrorCode::BadFile);
    return error.what();
  }
  ADD_FAILURE() << "not refused";
  return {};
}

// no file may grow beyond that many bytes, as on a full disk
class SmallDisk
{
public:
  explicit SmallDisk(rlim_t bytes)
  {
    std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit small{ .rlim_cur = bytes, .rlim_max = before_.rlim_max };
    setrlimit(RLIMIT_FSIZE, &small);
  }
  ~SmallDisk()
  {
    setrlimit(RLIMIT_FSIZE, &before_);
  }

private:
  rlimit before_{};
};

class Output : public OutputRig
{
};

TEST_F(Output, ReplacesAFileWhole)
{
  const auto file = folder_.path() / "a.csv";
  std::ofstream(file) << "a longer text than the next";
  replaceFile(file, "short");
  EXPECT_EQ(test::readAll(file), "short");
  EXPECT_EQ(setOf(folder_.path()), Names{ "a.csv" });
}

TEST_F(Output, KeepsTheFileThatCannotBeReplaced)
{
  const auto file = folder_.path() / "a.csv";
  replaceFile(file, "before");
  std::filesystem::create_directories(folder_.path() / "b.csv" / "full");
  {
    const SmallDisk disk(50'000);
    const auto words = refusal([&] { replaceFile(file, std::string(100'000, 'x')); });
    EXPECT_NE(words.find("File too large"), std::string::npos) << words;
    EXPECT_TRUE(words.starts_with(file.string())) << words;
  }
  (void)refusal([&] { replaceFile(folder_.path() / "b.csv", "text"); });
  (void)refusal([&] { replaceFile(folder_.path() / "none" / "a.csv", "text"); });
  EXPECT_EQ(test::readAll(file), "before");
  EXPECT_EQ(setOf(folder_.path()), (Names{ "a.csv", "b.csv" }));
}

TEST_F(Output, FollowsNoLink)
{
  std::ofstream(folder_.path() / "precious") << "mine";
  std::filesystem::create_symlink("precious", folder_.path() / "a.csv");
  replaceFile(folder_.path() / "a.csv", "new");
  EXPECT_EQ(test::readAll(folder_.path() / "precious"), "mine");
  EXPECT_EQ(test::readAll(folder_.path() / "a.csv"), "new");
}

TEST_F(Output, AppearsAtTheEndOnly)
{
  {
    OutputFolder output(out_, kOwn, Earlier::Refuse);
    replaceFile(output.stage() / "a.csv", "1");
    EXPECT_FALSE(std::filesystem::exists(out_ / "a.csv"));
  }
  EXPECT_EQ(setOf(folder_.path()), Names{}); // nor the folders made for it
  write("1");
  expectBoth("1");
  EXPECT_EQ(setOf(out_), (Names{ "a.csv", "b.csv" }));
  EXPECT_EQ(setOf(out_.parent_path()), Names{ "out" });
}

TEST_F(Output, RefusesOrReplacesWhatAnEarlierRunLeft)
{
  write("1");
  std::ofstream(out_ / "plot.png") << "1"; // which this run does not make
  EXPECT_NE(refusal([&] { write("2"); }).find("--overwrite"), std::string::npos);
  expectBoth("1");
  write("2", Earlier::Replace);
  expectBoth("2");
  EXPECT_EQ(setOf(out_), (Names{ "a.csv", "b.csv" }));
  write("3", Earlier::Keep);
  expectBoth("3");
}

TEST_F(Output, LeavesTheFilesOfOthers)
{
  write("1");
  std::ofstream(out_ / "notes.txt") << "mine";
  std::filesystem::create_directories(out_ / "more" / "of" / "mine");
  write("2", Earlier::Replace);
  expectBoth("2");
  EXPECT_EQ(test::readAll(out_ / "notes.txt"), "mine");
  EXPECT_EQ(setOf(out_), (Names{ "a.csv", "b.csv", "notes.txt", "more" }));
}

TEST_F(Output, LetsOneRunIn)
{
  OutputFolder first(out_, kOwn, Earlier::Replace);
  const auto second = [&] { write("2", Earlier::Replace); };
  EXPECT_NE(refusal(second).find("another palp"), std::string::npos);
  replaceFile(first.stage() / "a.csv", "1");
  first.publish();
  EXPECT_NE(refusal(second).find("another palp"), std::string::npos); // though it was exchanged
  replaceFile(first.stage() / "b.csv", "1");
  first.publish();
  expectBoth("1");
}

TEST_F(Output, KeepsModeAndWorksWhereItStands)
{
  write("1");
  chmod(out_.c_str(), 0750);
  write("2", Earlier::Replace);
  struct stat is = {};
  stat(out_.c_str(), &is);
  EXPECT_EQ(is.st_mode & 07777U, 0750U);
  stat((out_ / "a.csv").c_str(), &is);
  EXPECT_EQ(is.st_mode & 0444U, 0444U); // others may read it, as of any program

  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(out_);
  out_ = ".";
  write("3", Earlier::Replace);
  expectBoth("3"); // the folder did not go away under the feet of the shell
  EXPECT_EQ(std::filesystem::current_path().filename(), "out");
  std::filesystem::current_path(before);
}

TEST_F(Output, ALinkToAFolderStaysALink)
{
  const auto link = folder_.path() / "link";
  std::filesystem::create_directories(out_);
  std::filesystem::create_directory_symlink(out_, link);
  std::swap(out_, const_cast<std::filesystem::path&>(link));
  write("1");
  EXPECT_TRUE(std::filesystem::is_symlink(out_));
  expectBoth("1");
}

TEST_F(Output, ClearsWhatAKilledRunLeft)
{
  write("1");
  std::filesystem::create_directories(out_ / ".palp-abcdef");
  std::ofstream(out_ / ".palp-abcdef" / "a.csv") << "half";
  std::filesystem::create_directories(out_.parent_path() / ".out.palp-abcdef");
  std::filesystem::create_directories(out_.parent_path() / ".other.palp-abcdef"); // beside it
  std::ofstream(out_ / ".palp-notes") << "of the user";
  write("2", Earlier::Replace);
  EXPECT_EQ(setOf(out_), (Names{ "a.csv", "b.csv", ".palp-notes" }));
  EXPECT_EQ(setOf(out_.parent_path()), Names{ "out" });
}

// lets a child go on to before a change of a folder, then kills it
// @param changes  that it makes before that
// @return         whether it had ended before
bool endsBefore(pid_t child, int changes, const std::filesystem::path& folder)
{
  int status = 0;
  waitpid(child, &status, 0);
  ptrace(PTRACE_SETOPTIONS, child, nullptr, PTRACE_O_TRACESYSGOOD);
  while (WIFSTOPPED(status) && !(test::changesFiles(child, folder) && changes-- == 0))
  {
    ptrace(PTRACE_SYSCALL, child, nullptr, nullptr);
    waitpid(child, &status, 0);
  }
  const bool ended = WIFEXITED(status);
  EXPECT_TRUE(ended ? WEXITSTATUS(status) == 0 : WIFSTOPPED(status));
  if (!ended)
  {
    kill(child, SIGKILL);
    waitpid(child, &status, 0);
  }
  return ended;
}

TEST_F(Output, KilledAtAnySystemCallTheFolderIsOldOrNew)
{
  for (const bool shared : { false, true })
  {
    const Names files = shared ? Names{ "notes.txt" } : Names{};
    int seenOld = 0;
    int seenNew = 0;
    bool ended = false;
    for (int changes = 0; !ended; ++changes)
    {
      std::filesystem::remove_all(out_);
      write("old");
      std::ofstream(out_ / "plot.png") << "old";
      if (shared)
      {
        std::ofstream(out_ / "notes.txt") << "mine";
      }
      const pid_t child = fork();
      if (child == 0)
      {
        ptrace(PTRACE_TRACEME, 0, nullptr, nullptr);
        raise(SIGSTOP);
        write("new", Earlier::Replace);
        _exit(0);
      }
      ended = endsBefore(child, changes, folder_.path());
      std::set<std::string> texts;
      int count = 0;
      for (const char* name : { "a.csv", "b.csv", "plot.png" })
      {
        const bool there = std::filesystem::exists(out_ / name);
        count += there ? 1 : 0;
        texts.insert(there ? test::readAll(out_ / name) : "");
      }
      texts.erase("");
      ASSERT_LE(texts.size(), 1U) << "two runs are mixed after " << changes;
      const std::string text = texts.empty() ? "" : *texts.begin();
      if (!shared)
      {
        ASSERT_EQ(count, text == "old" ? 3 : 2) << "some are missing after " << changes;
      }
      else
      {
        ASSERT_EQ(test::readAll(out_ / "notes.txt"), "mine");
      }
      (void)OutputFolder(out_, kOwn, Earlier::Keep); // the next run
      const bool isNew = test::readAll(out_ / "a.csv") == "new";
      ASSERT_EQ(test::readAll(out_ / "b.csv"), isNew ? "new" : "old") << changes;
      ASSERT_EQ(std::filesystem::exists(out_ / "plot.png"), !isNew) << changes;
      seenOld += text == "old" ? 1 : 0;
      seenNew += text == "new" ? 1 : 0;
    }
    EXPECT_GT(seenOld, 10);
    EXPECT_GT(seenNew, 3);
    write("last", Earlier::Replace);
    expectBoth("last");
    Names all = files;
    all.insert({ "a.csv", "b.csv" });
    EXPECT_EQ(setOf(out_), all);
    EXPECT_EQ(setOf(out_.parent_path()), Names{ "out" });
  }
}

TEST_F(Output, SaysWhatStandsInTheWay)
{
  std::ofstream(folder_.path() / "file") << "x";
  out_ = folder_.path() / "file" / "out";
  EXPECT_NE(refusal([&] { write("1"); }).find("Not a directory"), std::string::npos);
  out_ = folder_.path() / "file";
  EXPECT_NE(refusal([&] { write("1"); }).find("Not a directory"), std::string::npos);
  out_ = folder_.path() / "out";
  std::filesystem::create_directories(out_ / "a.csv");
  EXPECT_NE(
    refusal([&] { write("1", Earlier::Replace); }).find("Is a directory"), std::string::npos);
}

} // namespace
} // namespace palp
