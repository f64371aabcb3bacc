#pragma once

#include <string>
#include <vtkFloatArray.h>
#include <vtkSmartPointer.h>

namespace palp
{

/// A value at each point of a surface, to be seen as colors.
struct SurfaceMap
{
  vtkSmartPointer<vtkFloatArray>
    values{};           ///< one per point, in the unit of the title; NaN: unknown
  std::string title{};  ///< of the color bar
  std::string origin{}; ///< what the values come from, in a caption
  double low = 0.0;     ///< the least value
  double high = 0.0;    ///< the largest
};

} // namespace palp
