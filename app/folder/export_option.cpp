#include "app/folder/export_option.h"

#include "haptics/error.h"

#include <CLI/CLI.hpp>

#include <algorithm>

namespace palp
{

void refuseBeside(const CLI::App& command, const std::filesystem::path& folder,
  const std::vector<std::string>& allowed)
{
  for (const CLI::Option* option : command.get_options())
  {
    const std::string name = option->get_name();
    if (option->count() > 0 && std::ranges::find(allowed, name) == allowed.end())
    {
      throw Error(ErrorCode::BadValue,
        name + ": " + folder.string() +
          " is an export, whose scene.json says that; change it there, or leave the option out");
    }
  }
}

} // namespace palp
