#pragma once

#include <filesystem>
#include <fstream>
#include <list>
#include <sstream>
#include <string>
#include <sys/wait.h>
#include <vector>

namespace palp::test
{

/// What a program left behind.
struct Finished
{
  int code;        ///< exit code; -1 when it did not end by itself
  std::string out; ///< standard output
  std::string err; ///< standard error
};

/// What a program said in lines, without those that tell how far it is, as it does of what takes
/// long.
inline std::vector<std::string> sentences(const Finished& finished)
{
  std::vector<std::string> all;
  std::istringstream lines(finished.err);
  for (std::string line; std::getline(lines, line);)
  {
    line.starts_with("palp: ") && line.ends_with(" s") ? void() : all.push_back(line);
  }
  return all;
}

inline std::string readAll(const std::filesystem::path& file)
{
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

/// A folder that is empty at the start and gone at the end.
class TemporaryFolder
{
public:
  TemporaryFolder()
  {
    std::string name = (std::filesystem::temp_directory_path() / "palp-test-XXXXXX").string();
    path_ = mkdtemp(name.data());
  }
  ~TemporaryFolder()
  {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const
  {
    return path_;
  }

private:
  std::filesystem::path path_;
};

/// An empty folder of the test's own, gone when the program ends.
inline std::filesystem::path freshFolder()
{
  static std::list<TemporaryFolder> folders;
  return folders.emplace_back().path();
}

/// Runs a shell command to its end.
inline Finished runCommand(const std::string& command)
{
  const TemporaryFolder folder;
  const std::string out = (folder.path() / "out").string();
  const std::string err = (folder.path() / "err").string();
  const int status = std::system(("{ " + command + " ; } >" + out + " 2>" + err).c_str());
  return { WIFEXITED(status) ? WEXITSTATUS(status) : -1, readAll(out), readAll(err) };
}

} // namespace palp::test
