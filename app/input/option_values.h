#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace CLI
{
class App;
class Option;
} // namespace CLI

namespace palp
{

/// The words for the values of an enumeration, in its order: the same in options, scenes and
/// window.
using Words = std::vector<std::string>;

extern const Words kLawModes;     ///< LawMode
extern const Words kBases;        ///< Base
extern const Words kMaterials;    ///< ConstitutiveModel
extern const Words kContactRules; ///< ContactRule
extern const Words kDentSurfaces; ///< DentSurface, without None

/// An option whose text is parsed as soon as it is read, so that nothing behind it knows text.
/// @param usual  what holds without the option, for the help; empty: not shown
/// @param take   parses and keeps; throws Error BadValue
CLI::Option* addParsed(CLI::App& command, const std::string& name, const std::string& what,
  const std::string& usual, const std::function<void(const std::string&)>& take);

/// An option that takes one of several words.
/// @param usual  index of the word that holds without the option
/// @param take   keeps the index of the word that was given
CLI::Option* addWord(CLI::App& command, const std::string& name, const std::string& what,
  const Words& words, std::size_t usual, const std::function<void(std::size_t)>& take);

/// The same for a value of the words' enumeration.
template <typename Enum>
CLI::Option* addChoice(CLI::App& command, const std::string& name, const std::string& what,
  const Words& words, Enum& value)
{
  return addWord(command, name, what, words, static_cast<std::size_t>(value),
    [&value](std::size_t index) { value = static_cast<Enum>(index); });
}

} // namespace palp
