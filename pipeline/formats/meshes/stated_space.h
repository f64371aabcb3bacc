#pragma once

#include <string_view>

class vtkPolyData;

namespace palp
{

/// Whether a word names the axes of a patient, as LPS or RAS: a letter for each.
[[nodiscard]] bool isSpace(std::string_view word);

/// Keeps what a header or comment says of the axes, SPACE=LPS or SPACE=RAS as 3D Slicer writes it,
/// in the field array of that name.
void stateSpace(vtkPolyData& mesh, std::string_view header);

} // namespace palp
