#include "app/program/output.h"

#include "haptics/error.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <iostream>
#include <system_error>

namespace palp
{

namespace
{

void tellReplaced(const std::filesystem::path& folder, const std::string& found)
{
  if (!found.empty())
  {
    std::cerr << "palp: " << folder.string() << ": will replace " << found << '\n';
  }
}

} // namespace

void addOverwrite(CLI::App& command, bool& overwrite)
{
  command.add_flag("--overwrite", overwrite, "Replace files that are in --out already");
}

void keepInputs(const std::filesystem::path& folder, const std::vector<std::string>& own,
  const std::vector<std::filesystem::path>& inputs)
{
  for (const std::filesystem::path& input : inputs)
  {
    const auto isInput = [&](const std::string& name)
    {
      std::error_code none;
      return std::filesystem::equivalent(folder / name, input, none);
    };
    if (std::ranges::any_of(own, isInput))
    {
      throw Error(ErrorCode::BadValue,
        input.string() +
          ": is read by this run, which would replace it; write to another file or folder");
    }
  }
}

std::unique_ptr<OutputFolder> openOutput(const std::filesystem::path& folder,
  std::vector<std::string> own, bool overwrite, const std::vector<std::filesystem::path>& inputs)
{
  using Earlier = OutputFolder::Earlier;
  keepInputs(folder, own, inputs);
  auto output = std::make_unique<OutputFolder>(
    folder, std::move(own), overwrite ? Earlier::Replace : Earlier::Refuse);
  tellReplaced(folder, output->found());
  return output;
}

void expectOutput(const OutputFolder& output, const std::vector<std::string>& names)
{
  tellReplaced(output.path(), output.expect(names));
}

Outputs::Outputs()
  : interrupt_(
      [this]
      {
        const std::lock_guard lock(mutex_);
        for (const auto& folder : folders_)
        {
          folder->discard();
        }
      })
{
}

Outputs::~Outputs()
{
  const std::lock_guard lock(mutex_);
  folders_.clear();
}

OutputFolder& Outputs::open(const std::filesystem::path& folder, std::vector<std::string> own,
  bool overwrite, const std::vector<std::filesystem::path>& inputs)
{
  const std::lock_guard lock(mutex_);
  folders_.push_back(openOutput(folder, std::move(own), overwrite, inputs));
  return *folders_.back();
}

} // namespace palp
