#pragma once

#include <filesystem>
#include <string>

namespace CLI
{
class App;
}

namespace palp
{

struct DevicesOptions;
struct Renderer;
struct ViewOptions;

/// What the command does with a line that is parsed.
enum class Work
{
  Do,
  Check ///< only refuse what it would refuse, as far as that is told without files' content
};

// Each adds one subcommand with its options and help; the command runs when the line is parsed.
// A null part means that this program does not carry it and becomes the sibling that does.

void addViewCommand(CLI::App& app, int (*view)(const ViewOptions&));
void addRunCommand(CLI::App& app, const Renderer* pictures, Work work = Work::Do);
void addCheckCommand(CLI::App& app);
void addSceneCommand(CLI::App& app, const Renderer* pictures, int (*view)(const ViewOptions&));
void addForceCommand(CLI::App& app, Work work = Work::Do);
void addCalibrateCommand(CLI::App& app, const Renderer* pictures, Work work = Work::Do);
void addSweepCommand(CLI::App& app, const Renderer* pictures);
void addPhantomCommand(CLI::App& app);
void addExperimentCommand(CLI::App& app, const Renderer* pictures);
void addReportCommand(CLI::App& app, const Renderer* pictures);
void addStabilityCommand(CLI::App& app);
void addBenchCommand(CLI::App& app, const Renderer* pictures);
void addMapCommand(CLI::App& app);
void addDetectCommand(CLI::App& app, const Renderer* pictures);
void addTissuesCommand(CLI::App& app);
void addDevicesCommand(CLI::App& app, int (*show)(const DevicesOptions&));

/// palp sweep plan and palp sweep run in one, of a sweep of calibrations.
/// @throws Error  BadFile: another kind of sweep; else as those
void runCalibrations(const std::string& file, const std::filesystem::path& folder, unsigned jobs);

} // namespace palp
