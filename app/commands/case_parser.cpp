#include "app/commands/case_parser.h"

#include "app/commands/calibrate_case.h"
#include "app/commands/commands.h"
#include "haptics/error.h"

#include <CLI/CLI.hpp>

#include <set>

namespace palp
{
namespace
{

const std::set<std::string> kNotOfACase{ "help", "jobs", "no-picture", "out", "overwrite",
  "plot-files", "plots", "reference", "refined", "resume", "size", "sweep", "tables" };

// thrown where the command would begin to work
struct Parsed
{
};

bool takesValue(const CLI::Option& option)
{
  return option.get_expected_max() > 0 && option.get_type_size() > 0;
}

// what only all of its values together tell
void checkCalibration(const std::vector<std::string>& words)
{
  CaseText text;
  for (const std::string& word : words)
  {
    const std::size_t equals = word.find('=');
    if (equals != word.npos)
    {
      text.values[word.substr(2, equals - 2)] = word.substr(equals + 1);
    }
  }
  (void)caseOf("case", text);
}

} // namespace

CaseParser::CaseParser(std::string kind)
  : kind_(std::move(kind))
  , app_(std::make_unique<CLI::App>("", "palp"))
{
  addCalibrateCommand(*app_, nullptr);
  addForceCommand(*app_);
  addRunCommand(*app_, nullptr);
  app_->get_subcommand(kind_)->parse_complete_callback([] { throw Parsed(); });
}

CaseParser::~CaseParser() = default;

CommandOptions CaseParser::options() const
{
  CommandOptions options;
  for (const CLI::Option* option : app_->get_subcommand(kind_)->get_options())
  {
    const std::string name = option->get_positional() ? "mesh" : option->get_lnames().front();
    if (!kNotOfACase.contains(name))
    {
      (takesValue(*option) ? options.values : options.flags).insert(name);
    }
  }
  return options;
}

void CaseParser::check(const std::vector<std::string>& words)
{
  std::vector<std::string> backward(words.rbegin(), words.rend()); // as CLI11 consumes them
  if (kind_ != "force")
  {
    backward.insert(backward.begin(), "--out=case");
  }
  try
  {
    app_->parse(std::move(backward));
  }
  catch (const Parsed&)
  {
  }
  catch (const CLI::ParseError& error)
  {
    throw Error(ErrorCode::BadValue, error.what());
  }
  if (kind_ == "calibrate")
  {
    checkCalibration(words);
  }
}

} // namespace palp
