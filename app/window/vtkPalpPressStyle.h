#ifndef vtkPalpPressStyle_h
#define vtkPalpPressStyle_h

#include <array>
#include <functional>
#include <optional>
#include <vtkInteractorStyleTrackballCamera.h>

/**
 * @class   vtkPalpPressStyle
 * @brief   the pointer is the tool: left button presses, right button turns the view
 *
 * Moving hovers; the left button presses where it went down and dragging down goes deeper; the
 * wheel changes a depth that stays while the pointer slides over the surface. Right drag turns,
 * about the contact where there is one; middle drag shifts; right drag with Ctrl or wheel with Ctrl
 * brings nearer what is below the pointer. The arrow keys slide the tool, with Ctrl they turn the
 * view; Page Down and Up change the depth, + and - the distance.
 */
class vtkPalpPressStyle : public vtkInteractorStyleTrackballCamera
{
public:
  static vtkPalpPressStyle* New();
  vtkTypeMacro(vtkPalpPressStyle, vtkInteractorStyleTrackballCamera);

  /// What the owner does with the pointer; positions and drags in pixels, y upwards.
  std::function<void(int x, int y)> Hover;
  std::function<void(int x, int y)> Press;
  std::function<void(int pixelsDown)> Drag;
  std::function<void()> Release;
  std::function<void(int notches)> Wheel;
  std::function<void(int right, int up)> Slide; ///< by steps of the keys
  std::function<void(int steps)> Deepen;        ///< likewise
  std::function<void()> Turn;                   ///< the view changes below the pointer
  std::function<std::optional<std::array<double, 3>>()> Pivot; ///< [m]; none: of the camera
  std::function<void()> Leave; ///< the pointer left the view, with no button down

  void OnMouseMove() override;
  void OnLeftButtonDown() override;
  void OnLeftButtonUp() override;
  void OnRightButtonDown() override;
  void OnRightButtonUp() override;
  void OnMiddleButtonDown() override;
  void OnMouseWheelForward() override;
  void OnMouseWheelBackward() override;
  void OnLeave() override;
  void Rotate() override;
  void OnKeyPress() override;
  void OnChar() override
  {
  } // the letters of the toolkit's default would surprise

protected:
  void Dolly(double factor) override;
  vtkPalpPressStyle() = default;
  ~vtkPalpPressStyle() override = default;

private:
  vtkPalpPressStyle(const vtkPalpPressStyle&) = delete;
  void operator=(const vtkPalpPressStyle&) = delete;

  void RollWheel(int notches);
  void RotateBy(double azimuth, double elevation);

  bool Pressing = false;
  int PressedAt = 0; // y of the pointer when the button went down
};

#endif
