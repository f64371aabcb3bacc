#pragma once

#include "haptics/tip/tip.h"

#include <vtkSmartPointer.h>

class vtkPolyData;

namespace palp
{

/// The tool for drawing: its apex at the origin, its handle along +z [m].
///
/// @param tip     checked
/// @param length  of the shaft above the base [m]
[[nodiscard]] vtkSmartPointer<vtkPolyData> toolSurface(const Tip& tip, double length);

} // namespace palp
