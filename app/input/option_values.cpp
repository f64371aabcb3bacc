#include "app/input/option_values.h"

#include <CLI/CLI.hpp>

#include <utility>

namespace palp
{

const Words kLawModes{ "paper", "exact", "corrected" };
const Words kBases{ "unset", "bonded", "slip" };
const Words kMaterials{ "linear", "neo-hookean" };
const Words kContactRules{ "exact", "paper" };
const Words kDentSurfaces{ "paper", "paper-literal", "fitted" };

CLI::Option* addParsed(CLI::App& command, const std::string& name, const std::string& what,
  const std::string& usual, const std::function<void(const std::string&)>& take)
{
  CLI::Option* option = command.add_option_function<std::string>(name, take, what);
  return option->default_str(usual);
}

CLI::Option* addWord(CLI::App& command, const std::string& name, const std::string& what,
  const Words& words, std::size_t usual, const std::function<void(std::size_t)>& take)
{
  const auto takeWord = [&words, take](const std::string& word)
  { take(static_cast<std::size_t>(std::ranges::find(words, word) - words.begin())); };
  return addParsed(command, name, what, words.at(usual), takeWord)->check(CLI::IsMember(words));
}

} // namespace palp
