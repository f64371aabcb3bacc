#pragma once

#include <algorithm>
#include <cstddef>
#include <exception>
#include <thread>
#include <vector>

namespace palp
{

/// How many threads may solve at once: as many as there are cores, each by a BLAS that keeps to it;
/// one where that is OpenBLAS built for one caller, which mixes up what several compute.
[[nodiscard]] std::size_t solverThreads();

/// Calls work(part) for each part, in as many threads as may solve at once.
/// @throws  what the first part of them threw, after all have ended
template <typename Work>
void inThreads(std::size_t parts, const Work& work)
{
  const std::size_t count = std::min(parts, solverThreads());
  std::vector<std::exception_ptr> failures(parts);
  const auto everyOther = [&](std::size_t first)
  {
    for (std::size_t part = first; part < parts; part += count)
    {
      try
      {
        work(part);
      }
      catch (...)
      {
        failures[part] = std::current_exception();
      }
    }
  };
  {
    std::vector<std::jthread> threads;
    for (std::size_t first = 1; first < count; ++first)
    {
      threads.emplace_back(everyOther, first);
    }
    count > 0 ? everyOther(0) : void();
  }
  for (const std::exception_ptr& failure : failures)
  {
    failure ? std::rethrow_exception(failure) : void();
  }
}

} // namespace palp
