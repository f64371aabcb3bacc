#include "app/commands/sweep_case.h"

#include "app/commands/commands.h"
#include "haptics/error.h"

#include <CLI/CLI.hpp>

#include <memory>
#include <set>

namespace palp
{
namespace
{

const std::set<std::string> kNotOfACase{ "help", "jobs", "no-picture", "out", "overwrite",
  "plot-files", "plots", "reference", "refined", "resume", "size", "sweep", "tables" };

bool takesValue(const CLI::Option& option)
{
  return option.get_expected_max() > 0 && option.get_type_size() > 0;
}

// a new one for each case: what one sets would stay for the next
std::unique_ptr<CLI::App> checking(const std::string& kind)
{
  auto app = std::make_unique<CLI::App>("", "palp");
  if (kind == "calibrate")
  {
    addCalibrateCommand(*app, nullptr, Work::Check);
  }
  else if (kind == "force")
  {
    addForceCommand(*app, Work::Check);
  }
  else
  {
    addRunCommand(*app, nullptr, Work::Check);
  }
  return app;
}

} // namespace

CommandOptions caseOptions(const std::string& kind)
{
  CommandOptions options;
  const auto app = checking(kind);
  for (const CLI::Option* option : app->get_subcommand(kind)->get_options())
  {
    const std::string name = option->get_positional() ? "mesh" : option->get_lnames().front();
    if (kNotOfACase.contains(name))
    {
      options.own.insert(name);
    }
    else
    {
      (takesValue(*option) ? options.values : options.flags).insert(name);
    }
  }
  return options;
}

void checkCase(const std::vector<std::string>& words)
{
  const std::string& kind = words.front();
  std::vector<std::string> backward(words.rbegin(), words.rend()); // as CLI11 consumes them
  if (kind != "force")
  {
    backward.insert(backward.begin(), { "--no-picture", "--out=case" });
  }
  try
  {
    checking(kind)->parse(std::move(backward));
  }
  catch (const CLI::ParseError& error)
  {
    throw Error(ErrorCode::BadValue, error.what());
  }
}

} // namespace palp
