#pragma once

#include "app/sweep/case_inputs.h"

#include <memory>
#include <string>
#include <vector>

namespace CLI
{
class App;
}

namespace palp
{

/// What a command of palp would make of the words of a case, without running it.
class CaseParser
{
public:
  /// @param kind  calibrate, force or run
  explicit CaseParser(std::string kind);
  ~CaseParser();
  CaseParser(const CaseParser&) = delete;
  CaseParser& operator=(const CaseParser&) = delete;

  /// What a sweep may set: all that changes the numbers; not where they go or how they are drawn.
  [[nodiscard]] CommandOptions options() const;

  /// @throws Error  BadValue: in one sentence what the command refuses
  void check(const std::vector<std::string>& words);

private:
  std::string kind_;
  std::unique_ptr<CLI::App> app_;
};

} // namespace palp
