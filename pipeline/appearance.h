#pragma once

#include <array>
#include <string>
#include <vtkSmartPointer.h>

class vtkLookupTable;
class vtkTextProperty;

namespace palp::appearance
{

using Color = std::array<double, 3>; // red, green, blue, 0 to 1

inline constexpr Color kLiver{ 0.55, 0.20, 0.16 };
inline constexpr Color kTool{ 0.80, 0.83, 0.86 };
inline constexpr Color kForce{ 0.98, 0.75, 0.10 };
inline constexpr Color kContact{ 1.0, 1.0, 1.0 };
inline constexpr Color kExtent{ 0.35, 0.85, 1.0 };
inline constexpr Color kInk{ 0.10, 0.11, 0.13 };
inline constexpr Color kPaper{ 1.0, 1.0, 1.0 };
inline constexpr Color kSky{ 0.95, 0.96, 0.97 };
inline constexpr Color kGround{ 0.72, 0.75, 0.79 };
inline constexpr Color kMeasured{ 0.00, 0.35, 0.65 };
inline constexpr Color kLaw{ 0.85, 0.37, 0.01 };

/// A font with Greek letters and brackets, which the toolkit's own one has not.
///
/// Falls back to the toolkit's font where DejaVu Sans is not installed.
/// @param size  [points]
void setFont(vtkTextProperty& text, int size, const Color& color = kInk, bool bold = false);

/// The map "viridis": perceptually uniform, and readable without colour vision.
///
/// Begins with the colour of what it is drawn on, so that a colouring ends there without an edge.
/// @source Smith, van der Walt and Firing 2015, matplotlib's default map
[[nodiscard]] vtkSmartPointer<vtkLookupTable> viridisOn(const Color& base);

/// A number for people, with a point whatever the user's locale.
[[nodiscard]] std::string fixedText(double value, int decimals);

/// The smallest of 1, 2, 5 times a power of ten that is not below a value; 1 for values below
/// 1e-12.
[[nodiscard]] double roundUp(double value) noexcept;

} // namespace palp::appearance
