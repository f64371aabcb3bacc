#pragma once

#include <vtkSmartPointer.h>

class vtkRenderPass;

namespace palp
{

/// Draws what is translucent straight over the rest: without a graphics card in two thirds of the
/// time of the toolkit's own way, which looks the same where one such thing at most lies behind
/// another.
[[nodiscard]] vtkSmartPointer<vtkRenderPass> fastPass();

} // namespace palp
