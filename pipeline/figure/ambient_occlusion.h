#pragma once

#include <vtkSmartPointer.h>

class vtkRenderPass;

namespace palp
{

/// Darkens what little of the sky reaches, as the wall of a dent, and smooths edges by a filter
/// (SSAO, FXAA).
///
/// What is translucent, and what lies over the picture, is drawn after it. The background is that
/// of the renderer.
/// @param radius  how far something shades [m]
[[nodiscard]] vtkSmartPointer<vtkRenderPass> ambientOcclusion(double radius);

} // namespace palp
