#pragma once

class vtkRenderer;

namespace palp
{

/// Light from all around beside that of the lamps, as in a studio with a bright ceiling and a dark
/// floor.
void addStudio(vtkRenderer& renderer);

/// Draws what is lit, and is by now in the picture, by a physically based, wet material (GGX); the
/// ceiling is where the camera has up.
void makePhysical(vtkRenderer& renderer);

/// Takes back what both of these did.
void removeStudio(vtkRenderer& renderer);

} // namespace palp
