#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace palp
{

/// Adds a word to a list for people: a, b, c.
inline void addListed(std::string& list, std::string_view word)
{
  list.append(list.empty() ? "" : ", ").append(word);
}

/// A list of all there are.
/// @param wordOf  of one of them: its name, where it is not a word itself
template <typename All, typename WordOf = std::identity>
[[nodiscard]] std::string listed(const All& all, WordOf wordOf = {})
{
  std::string list;
  for (const auto& one : all)
  {
    addListed(list, std::invoke(wordOf, one));
  }
  return list;
}

} // namespace palp
