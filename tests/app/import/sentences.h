#pragma once

#include "tests/support/process.h"

#include <vector>

namespace palp::test
{

/// What a program said in lines, without those that tell how far it is.
inline std::vector<std::string> sentences(const Finished& finished)
{
  std::vector<std::string> all;
  std::istringstream lines(finished.err);
  for (std::string line; std::getline(lines, line);)
  {
    line.starts_with("palp: reading ") && line.ends_with(" s") ? void() : all.push_back(line);
  }
  return all;
}

} // namespace palp::test
