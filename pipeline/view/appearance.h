#pragma once

#include "pipeline/layout/before_render.h"

#include <Eigen/Core>
#include <array>
#include <string>
#include <vtkSmartPointer.h>

class vtkActor2D;
class vtkChartXY;
class vtkLookupTable;
class vtkMapper;
class vtkMatrix4x4;
class vtkPolyData;
class vtkProperty;
class vtkRenderer;
class vtkTextProperty;

namespace palp::appearance
{

using palp::kDpi;

using Color = std::array<double, 3>; // red, green, blue, 0 to 1

inline constexpr Color kLiver{ 0.55, 0.20, 0.16 };
inline constexpr Color kTool{ 0.80, 0.83, 0.86 };
inline constexpr Color kForce{ 0.05, 0.42, 0.78 };
inline constexpr Color kContact{ 1.0, 1.0, 1.0 };
inline constexpr Color kExtent{ 0.35, 0.85, 1.0 };
inline constexpr Color kNet{ 1.0, 0.85, 0.2 };
inline constexpr Color kLeast{ 0.03, 0.33, 0.36 };   // of a map over a surface, unlike all tissue
inline constexpr Color kUnknown{ 0.62, 0.63, 0.65 }; // of a map of colors
inline constexpr Color kGhost{ 0.75, 0.85, 0.95 };

// apart for every kind of color vision (Okabe and Ito 2008)
inline constexpr Color kGood{ 0.00, 0.62, 0.45 };
inline constexpr Color kDoubtful{ 0.90, 0.62, 0.00 };
inline constexpr Color kBad{ 0.84, 0.37, 0.00 };

/// For curves beside each other, from the same palette.
inline constexpr std::array<Color, 6> kCurves{ { { 0.00, 0.45, 0.70 }, { 0.84, 0.37, 0.00 },
  { 0.00, 0.62, 0.45 }, { 0.80, 0.47, 0.65 }, { 0.90, 0.62, 0.00 }, { 0.34, 0.71, 0.91 } } };

/// The next one of them, again from the first after the last.
[[nodiscard]] constexpr const Color& curveColor(std::size_t i) noexcept
{
  return kCurves[i % kCurves.size()];
}

/// How a line is drawn, with the numbers that vtkPen and Qt give them; curves beyond the colors
/// take the next one.
enum class LineStyle
{
  Solid = 1,
  Dashed,
  Dotted,
  DashDotted,
};
inline constexpr std::size_t kLineStyles = 4;

inline constexpr Color kInk{ 0.10, 0.11, 0.13 };
inline constexpr Color kPaper{ 1.0, 1.0, 1.0 };
inline constexpr Color kSky{ 0.95, 0.96, 0.97 };
inline constexpr Color kGround{ 0.72, 0.75, 0.79 };
inline constexpr Color kMeasured = kCurves[0];
inline constexpr Color kLaw = kCurves[1];

/// A font with Greek letters and brackets, which the toolkit's own one has not.
///
/// Falls back to the toolkit's font where DejaVu Sans is not installed.
/// @param size  [points]
void setFont(vtkTextProperty& text, int size, const Color& color = kInk, bool bold = false);

/// The table of color::evenMap: the color of what it is drawn on at its lower end, so that a
/// coloring ends there without an edge.
[[nodiscard]] vtkSmartPointer<vtkLookupTable> evenMapOn(const Color& base);

/// A number for people, with a point whatever the user's locale.
[[nodiscard]] std::string fixedText(double value, int decimals);

/// The same with three digits at most, as of a round number.
[[nodiscard]] std::string roundText(double value);

/// The smallest of 1, 1.5, 2, 2.5, 3, 4, 5, 6, 8 times a power of ten not below a value; 1 below
/// 1e-12.
[[nodiscard]] double roundUp(double value) noexcept;

/// Digits behind the point that such a number needs, up to 12.
[[nodiscard]] int decimalsOf(double round) noexcept;

void setColor(vtkProperty& property, const Color& color);

/// A line of ink over the picture.
/// @param line   gets as many points, which it connects in their order [pixels]
/// @param actor  draws it
void makeInkLine(vtkPolyData& line, vtkActor2D& actor, int points);

/// Background and lights of a body. The key stands at the side, so that the walls of a dent have a
/// light half and a dark one; the rim lights the body's edge from behind.
void setUpScene(vtkRenderer& renderer);

/// What lies on a surface is drawn in front of it.
void drawInFront(vtkMapper& mapper);

/// Fonts, titles and a quiet grid.
void setUpChart(
  vtkChartXY& chart, const std::string& title, const std::string& bottom, const std::string& left);

/// A matrix for vtkProp3D::SetUserMatrix.
/// @param origin  [m]
/// @param axes    columns
[[nodiscard]] vtkSmartPointer<vtkMatrix4x4> placement(
  const Eigen::Vector3d& origin, const Eigen::Matrix3d& axes);

/// Right-handed axes, unit columns, of which one is given.
[[nodiscard]] Eigen::Matrix3d axesAlong(const Eigen::Vector3d& direction, int axis);

} // namespace palp::appearance
