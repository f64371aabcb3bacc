#pragma once

#include <vtkSmartPointer.h>

class vtkRenderPass;

namespace palp
{

/// Draws what is translucent straight over the rest, and the gradient of a background where nothing
/// opaque stands: without a graphics card in half of the time of the toolkit's own way, which looks
/// the same where one translucent thing at most lies behind another. The renderer's own gradient is
/// to be off: it would cover all pixels first, and switching it for each picture builds shaders
/// anew.
[[nodiscard]] vtkSmartPointer<vtkRenderPass> fastPass();

} // namespace palp
