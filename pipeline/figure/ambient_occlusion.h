#pragma once

class vtkRenderer;

namespace palp
{

/// Darkens what little of the sky reaches, as the wall of a dent, and smooths edges by a filter
/// (SSAO, FXAA): for pictures that may take a second.
///
/// What is translucent, and what lies over the picture, is drawn after it. The background is that
/// of the renderer.
/// @param radius  how far something shades [m]
void addAmbientOcclusion(vtkRenderer& renderer, double radius);

} // namespace palp
