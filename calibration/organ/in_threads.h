#pragma once

#include <cstddef>
#include <exception>
#include <thread>
#include <vector>

namespace palp
{

/// Calls work(part) for each part, in a thread of its own but for the first.
/// @throws  what the first of them threw, after all have ended
template <typename Work>
void inThreads(std::size_t parts, const Work& work)
{
  std::vector<std::exception_ptr> failures(parts);
  const auto safely = [&](std::size_t part)
  {
    try
    {
      work(part);
    }
    catch (...)
    {
      failures[part] = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> threads;
    for (std::size_t part = 1; part < parts; ++part)
    {
      threads.emplace_back(safely, part);
    }
    parts > 0 ? safely(0) : void();
  }
  for (const std::exception_ptr& failure : failures)
  {
    failure ? std::rethrow_exception(failure) : void();
  }
}

} // namespace palp
