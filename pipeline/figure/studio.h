#pragma once

class vtkRenderer;

namespace palp
{

/// Draws what is lit by a physically based, wet material (GGX), with light from all around beside
/// that of the lamps, as in a studio with a bright ceiling and a dark floor.
///
/// For pictures that may take a second, once the camera stands.
void addStudio(vtkRenderer& renderer);

} // namespace palp
