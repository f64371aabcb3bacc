#pragma once

#include "app/folder/view_options.h"
#include "haptics/error.h"

namespace palp
{

struct DevicesOptions;
struct Renderer;

/// What one of the sibling programs carries beyond the common commands.
///
/// palp itself carries neither. A command that needs one becomes, by exec, the sibling that has
/// it: same arguments, same process, same exit code. So the plain program never maps a graphics
/// or window library, and nothing has to be loaded or unloaded at run time.
struct ProgramFeatures
{
  const Renderer* pictures = nullptr;              ///< palp-draw
  int (*view)(const ViewOptions&) = nullptr;       ///< palp-view
  int (*devices)(const DevicesOptions&) = nullptr; ///< palp-devices
};

/// What the program ends with after an error of this kind, 2 to 5.
[[nodiscard]] int exitCode(ErrorCode code);

/// The main function of palp and its siblings.
/// @return  exit code: 0, or by kind of error 2 (input), 3 (device), 4 (picture), 5 (no solution)
[[nodiscard]] int runProgram(int argc, char** argv, const ProgramFeatures& parts);

} // namespace palp
