#include "app/commands/program.h"

#include "app/commands/commands.h"
#include "app/commands/fit/fit_command.h"
#include "app/commands/organ/organ_command.h"
#include "app/commands/train/train_command.h"
#include "app/import/import_command.h"
#include "app/program/exec_program.h"
#include "haptics/error.h"
#include "haptics/files/input_text.h"
#include "haptics/files/listed.h"

#include <CLI/CLI.hpp>

#include <csignal>
#include <filesystem>
#include <iostream>
#include <new>
#include <vector>

namespace palp
{
namespace
{

// help, version, or one of the subcommands
bool isCommand(const CLI::App& app, const std::string& word)
{
  const auto named = [&](const CLI::App* command) { return command->get_name() == word; };
  return word == "help" || word == "-h" || word == "--help" || word == "--version" ||
    !app.get_subcommands(named).empty();
}

// a word that nobody would give to a file, so that a slip is not sought on the disk
void refuseUnknownCommand(const CLI::App& app, const std::string& word)
{
  if (word.empty() || word.find_first_of("-./") != word.npos || std::filesystem::exists(word))
  {
    return;
  }
  throw Error(ErrorCode::BadValue,
    "'" + word + "' is neither a command nor a file here; the commands are " +
      listed(app.get_subcommands({}), &CLI::App::get_name));
}

// `palp liver.stl` is `palp view liver.stl`, `palp help run` is `palp run --help`
std::vector<std::string> withCommand(const CLI::App& app, int argc, char** argv)
{
  std::vector<std::string> words(argv + 1, argv + argc);
  if (!words.empty() && words[0] == "help")
  {
    words.erase(words.begin());
    words.emplace_back("--help");
  }
  if (words.empty() || !isCommand(app, words[0]))
  {
    refuseUnknownCommand(app, words.empty() ? "" : words[0]);
    words.insert(words.begin(), "view");
  }
  return { words.rbegin(), words.rend() }; // the order in which CLI11 consumes them
}

// an unset variable of the shell must not stand for a default
void refuseEmptyValues(CLI::App& app)
{
  const CLI::Validator notEmpty([](const std::string& text)
    { return std::string(text.empty() ? "is empty; give a value, or leave it out" : ""); },
    "");
  for (CLI::App* command : app.get_subcommands({}))
  {
    refuseEmptyValues(*command);
    for (CLI::Option* option : command->get_options())
    {
      if (option->get_expected_max() > 0 && option->get_type_size() > 0)
      {
        option->check(notEmpty);
      }
    }
  }
}

void addCommands(CLI::App& app, const ProgramFeatures& parts)
{
  addViewCommand(app, parts.view);
  addRunCommand(app, parts.pictures);
  addSceneCommand(app, parts.pictures, parts.view);
  addTrainCommand(app, parts.pictures, parts.view);
  addImportCommand(app);
  addCheckCommand(app);
  addForceCommand(app);
  addFitCommand(app, parts.pictures);
  addCalibrateCommand(app, parts.pictures);
  addSweepCommand(app, parts.pictures);
  addExperimentCommand(app, parts.pictures);
  addReportCommand(app, parts.pictures);
  addStabilityCommand(app);
  addBenchCommand(app, parts.pictures);
  addDetectCommand(app, parts.pictures);
  addMapCommand(app);
  addOrganCommand(app);
  addPhantomCommand(app);
  addTissuesCommand(app);
  addDevicesCommand(app, parts.devices);
  refuseEmptyValues(app);
}

// what the parser of the options says: help, or a refusal in our form
int tell(const CLI::ParseError& error, const CLI::App& app)
{
  if (error.get_exit_code() == 0)
  {
    return app.exit(error);
  }
  std::string what = error.what();
  if (const std::size_t more = what.find(": At Most 1 required"); more != what.npos)
  {
    what.replace(more, what.npos, ": given more than once; give it once");
  }
  std::cerr << "palp: " << printable(what) << "; --help tells what may be given\n";
  return 2;
}

int runCommand(CLI::App& app, int argc, char** argv)
{
  int code = 0;
  try
  {
    app.parse(withCommand(app, argc, argv));
  }
  catch (const CLI::RuntimeError& error) // a command that has its own exit codes
  {
    code = error.get_exit_code();
  }
  if (!std::cout.flush())
  {
    throw Error(ErrorCode::BadFile, "standard output: cannot be written in full; check the space");
  }
  return code;
}

} // namespace

int exitCode(ErrorCode code)
{
  switch (code)
  {
    case ErrorCode::BadFile:
    case ErrorCode::BadMesh:
    case ErrorCode::BadValue:
      return 2;
    case ErrorCode::NoDevice:
      return 3;
    case ErrorCode::NoPicture:
      return 4;
    case ErrorCode::NoSolution:
      return 5;
  }
  return 1;
}

int runProgram(int argc, char** argv, const ProgramFeatures& parts)
{
  setArguments(argv);
  std::signal(SIGXFSZ, SIG_IGN); // a limit on files is told as a full disk is
  CLI::App app("Press soft tissue: see the dent, feel the force, keep the data.", "palp");
  app.set_version_flag("--version", "palp " PALP_VERSION);
  app.require_subcommand(1);
  app.footer(
    "Examples:\n"
    "  palp                                         press the bundled liver with the mouse\n"
    "  palp liver.stl --tip cone:45deg:10mm         your own surface, a conical tool\n"
    "  palp run liver.stl --path press.csv --out out --young 20kPa\n"
    "  palp force --tip sphere:10mm --depth 0:10:0.5mm > law.csv");
  addCommands(app, parts);

  // for the start script: is this word a command of ours?
  if (argc == 3 && std::string_view(argv[1]) == "--is-command")
  {
    return isCommand(app, argv[2]) ? 0 : 1;
  }

  try
  {
    return runCommand(app, argc, argv);
  }
  catch (const CLI::ParseError& error)
  {
    return tell(error, app);
  }
  catch (const Error& error)
  {
    std::cerr << "palp: " << printable(error.what()) << '\n';
    return exitCode(error.code());
  }
  catch (const std::filesystem::filesystem_error& error)
  {
    std::cerr << "palp: " << printable(error.path1().string()) << ": cannot be used ("
              << error.code().message() << "); choose another file or folder\n";
    return 2;
  }
  catch (const std::bad_alloc&)
  {
    std::cerr << "palp: not enough memory for this; try a smaller input\n";
    return 1;
  }
  catch (const std::exception& error)
  {
    std::cerr << "palp: internal error, please report it: " << printable(error.what()) << '\n';
    return 1;
  }
}

} // namespace palp
