#pragma once

namespace CLI
{
class App;
}

namespace palp
{

struct Renderer;

/// Adds `palp fit`, as those in app/commands.
///
/// @param pictures  draws the plots; null: palp-draw does
void addFitCommand(CLI::App& app, const Renderer* pictures);

} // namespace palp
