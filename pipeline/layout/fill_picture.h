#pragma once

class vtkPolyData;
class vtkRenderer;

namespace palp
{

/// Brings a camera that sees all of a body nearer, until it takes nine tenths of the width.
///
/// A sphere about the body, which vtkRenderer::ResetCamera fits, wastes what is free at its sides.
/// What is above and below the square in the middle stays free for what is written there.
/// @param renderer  of a picture that is not wider than high, whose camera has a perspective and
///                  looks at its middle
/// @param body      with points, all in front of the camera
void fillPicture(vtkRenderer& renderer, vtkPolyData& body);

} // namespace palp
