#include "app/program/exec_program.h"

#include "haptics/error.h"
#include "haptics/files/prefix.h"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <filesystem>
#include <unistd.h>

namespace palp
{
namespace
{

char** gArguments = nullptr; // of main

} // namespace

std::string quoted(const std::string& word)
{
  constexpr auto isPlain = [](unsigned char c)
  { return std::isalnum(c) != 0 || std::strchr("_./:=,%@+-", c) != nullptr; };
  if (!word.empty() && std::ranges::all_of(word, isPlain))
  {
    return word;
  }
  std::string text = "'";
  for (const char c : word)
  {
    const bool isControl = c >= 0 && c < ' ';
    text += c == '\'' ? "'\\''" : std::string(1, isControl ? '?' : c);
  }
  return text + "'";
}

void setArguments(char** arguments)
{
  gArguments = arguments;
}

std::string commandLine()
{
  std::string line = gArguments == nullptr ? "" : "palp";
  for (char** argument = gArguments; argument != nullptr && *++argument != nullptr;)
  {
    const std::string word = *argument;
    if (word == "--out" && argument[1] != nullptr)
    {
      ++argument;
    }
    else if (word != "--overwrite" && !word.starts_with("--out="))
    {
      line += ' ' + quoted(word);
    }
  }
  return line;
}

void execProgram(const char* name)
{
  const std::filesystem::path program = prefix() / "bin" / name;
  execv(program.c_str(), gArguments);
  throw Error(ErrorCode::NoPicture,
    program.string() +
      ": cannot be started; build it, or pass --no-picture where a command has it");
}

} // namespace palp
