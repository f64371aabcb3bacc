#pragma once

#include "tests/support/process.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <filesystem>
#include <gtest/gtest.h>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace palp::test
{

/// A table of text.
struct Table
{
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;

  [[nodiscard]] const std::string& at(std::size_t row, const std::string& column) const
  {
    const auto found = std::ranges::find(columns, column);
    EXPECT_NE(found, columns.end()) << column;
    return rows[row][static_cast<std::size_t>(found - columns.begin())];
  }
  [[nodiscard]] double number(std::size_t row, const std::string& column) const
  {
    return std::stod(at(row, column));
  }
};

/// RFC 4180 without line breaks in fields.
inline std::vector<std::string> fieldsOf(const std::string& line)
{
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (const char c : line)
  {
    if (c == '"')
    {
      quoted = !quoted;
    }
    else if (c == ',' && !quoted)
    {
      fields.emplace_back();
    }
    else
    {
      fields.back() += c;
    }
  }
  return fields;
}

/// From a CSV file; its rows have to be complete.
inline Table readTable(const std::filesystem::path& file)
{
  std::istringstream in(readAll(file));
  Table table;
  for (std::string line; std::getline(in, line);)
  {
    auto fields = fieldsOf(line);
    if (table.columns.empty())
    {
      table.columns = std::move(fields);
      continue;
    }
    EXPECT_EQ(fields.size(), table.columns.size()) << file << ": " << line;
    table.rows.push_back(std::move(fields));
  }
  EXPECT_FALSE(table.rows.empty()) << file;
  return table;
}

/// Starts the program, interrupts it once a file is there, and gives its exit code.
inline int interruptOnce(const std::string& folder, const std::filesystem::path& awaited)
{
  const pid_t child = fork();
  if (child == 0)
  {
    const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
    dup2(nowhere, STDERR_FILENO);
    execl(PALP_PROGRAM, "palp", "report", "--quick", "--out", folder.c_str(), nullptr);
    _exit(127);
  }
  int status = 0;
  while (!std::filesystem::exists(awaited) && waitpid(child, &status, WNOHANG) == 0)
  {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  kill(child, SIGINT);
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// One report for all tests: interrupted after its first part, then gone on with.
class QuickReport : public ::testing::Test
{
protected:
  static void SetUpTestSuite()
  {
    folder_ = std::make_unique<TemporaryFolder>();
    interrupted_ = interruptOnce(out().string(), out() / "force_error.json");
    interruptedPage_ = readAll(out() / "report.html");
    firstPart_ = readAll(out() / "force_error.json");
    finished_ = runCommand(PALP_PROGRAM " report --quick --resume --out " + out().string());
  }

  static void TearDownTestSuite()
  {
    folder_.reset();
  }

  static std::filesystem::path out()
  {
    return folder_->path() / "report";
  }

  static inline std::unique_ptr<TemporaryFolder> folder_;
  static inline int interrupted_ = 0;
  static inline std::string interruptedPage_;
  static inline std::string firstPart_;
  static inline Finished finished_{};
};

} // namespace palp::test
