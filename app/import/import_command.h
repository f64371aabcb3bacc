#pragma once

namespace CLI
{
class App;
}

namespace palp
{

/// Adds `palp import`, as those in app/commands.
void addImportCommand(CLI::App& app);

} // namespace palp
