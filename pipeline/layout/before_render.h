#pragma once

#include <functional>
#include <vtkCallbackCommand.h>
#include <vtkNew.h>
#include <vtkSmartPointer.h>

class vtkRenderer;

namespace palp
{

inline constexpr double kDpi = 72.0; ///< dots per inch at which a point is a pixel

/// What there is room for in a picture [pixels].
struct PictureRoom
{
  double width;
  double height;
  double foot = 0.0;  ///< that something else covers, from below
  double scale = 1.0; ///< of layout, more than 1 on a screen of many dots per inch
  double marks = 0.0; ///< width that they take at the right of the foot

  /// Full of the body from side to side; what is told of it has its place above.
  [[nodiscard]] bool isNarrow() const noexcept
  {
    constexpr double kNarrow = 0.8; // [-] of the height
    return width < kNarrow * height;
  }
};

inline constexpr double kNarrowTop = 0.86; ///< part of a narrow picture below its color bar

/// Keeps what has its place in pixels off the foot of a renderer's pictures; at first there is
/// none.
/// @param height  that something else covers [pixels]
void setFoot(vtkRenderer& renderer, double height);

/// Keeps lines of text off what stands at the right of the foot; at first there is nothing.
/// @param width  that it takes [pixels of layout]
void setMarks(vtkRenderer& renderer, double width);

/// Calls a function before each picture of a renderer, as long as this lives: for what has its
/// place in pixels, or follows the camera.
class BeforeRender
{
public:
  BeforeRender(vtkRenderer& renderer, std::function<void(const PictureRoom& room)> layOut);
  ~BeforeRender();
  BeforeRender(const BeforeRender&) = delete;
  BeforeRender& operator=(const BeforeRender&) = delete;

private:
  vtkSmartPointer<vtkRenderer> renderer_;
  std::function<void(const PictureRoom&)> layOut_;
  vtkNew<vtkCallbackCommand> command_;
};

} // namespace palp
