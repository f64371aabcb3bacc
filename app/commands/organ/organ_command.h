#pragma once

namespace CLI
{
class App;
}

namespace palp
{

/// Adds `palp organ`, as those in app/commands.
void addOrganCommand(CLI::App& app);

} // namespace palp
