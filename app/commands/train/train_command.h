#pragma once

namespace CLI
{
class App;
}

namespace palp
{

struct Renderer;
struct ViewOptions;

/// Adds `palp train`, as those in app/commands.
void addTrainCommand(CLI::App& app, const Renderer* pictures, int (*view)(const ViewOptions&));

} // namespace palp
