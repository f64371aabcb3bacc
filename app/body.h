#pragma once

#include "app/press_options.h"
#include "haptics/contact/surface.h"

#include <memory>
#include <string>
#include <vector>
#include <vtkSmartPointer.h>

class vtkPolyData;

namespace palp
{

/// What is pressed, in two levels of detail: one to look at, one to feel.
struct Body
{
  std::string name;                      ///< file name, for people
  std::string unit;                      ///< that the file's coordinates were read in
  vtkSmartPointer<vtkPolyData> display;  ///< [m]
  std::shared_ptr<const Surface> haptic; ///< [m]
  std::vector<std::string> notes;        ///< what was taken, and warnings; a line each
};

/// Loads the file that the options name, for both levels, or the bundled liver with its own two.
/// @throws Error  BadFile, BadMesh, BadValue
[[nodiscard]] Body loadBody(const PressOptions& options);

} // namespace palp
