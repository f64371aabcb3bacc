#include "app/window/vtkPalpPressStyle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <vtkCamera.h>
#include <vtkCommand.h>
#include <vtkMath.h>
#include <vtkObjectFactory.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>

vtkStandardNewMacro(vtkPalpPressStyle);

namespace
{

using Vector = std::array<double, 3>;

// of a place from the focal point, to the right, upwards and away [m]
Vector InView(vtkCamera& camera, const Vector& place)
{
  const double* away = camera.GetDirectionOfProjection();
  const double* up = camera.GetViewUp();
  Vector from;
  Vector right;
  vtkMath::Subtract(place.data(), camera.GetFocalPoint(), from.data());
  vtkMath::Cross(away, up, right.data());
  return { vtkMath::Dot(from.data(), right.data()), vtkMath::Dot(from.data(), up),
    vtkMath::Dot(from.data(), away) };
}

void Shift(vtkCamera& camera, const Vector& by)
{
  Vector focus;
  Vector eye;
  vtkMath::Add(camera.GetFocalPoint(), by.data(), focus.data());
  vtkMath::Add(camera.GetPosition(), by.data(), eye.data());
  camera.SetFocalPoint(focus.data());
  camera.SetPosition(eye.data());
}

} // namespace

//------------------------------------------------------------------------------
void vtkPalpPressStyle::OnMouseMove()
{
  const int* position = this->Interactor->GetEventPosition();
  if (this->Pressing)
  {
    this->Drag(this->PressedAt - position[1]);
  }
  else if (this->State == VTKIS_NONE)
  {
    this->Hover(position[0], position[1]);
  }
  this->Superclass::OnMouseMove();
}

//------------------------------------------------------------------------------
void vtkPalpPressStyle::OnLeftButtonDown()
{
  const int* position = this->Interactor->GetEventPosition();
  this->Pressing = true;
  this->PressedAt = position[1];
  this->Press(position[0], position[1]);
}

//------------------------------------------------------------------------------
void vtkPalpPressStyle::OnLeftButtonUp()
{
  this->Pressing = false;
  this->Release();
}

//------------------------------------------------------------------------------
void vtkPalpPressStyle::OnRightButtonDown()
{
  this->Turn();
  if (this->Interactor->GetControlKey())
  {
    this->Superclass::OnRightButtonDown();
  }
  else
  {
    this->Superclass::OnLeftButtonDown();
  }
}

//------------------------------------------------------------------------------
void vtkPalpPressStyle::OnRightButtonUp()
{
  this->Superclass::OnLeftButtonUp();
  this->Superclass::OnRightButtonUp();
}

//------------------------------------------------------------------------------
void vtkPalpPressStyle::OnMiddleButtonDown()
{
  this->Turn();
  this->Superclass::OnMiddleButtonDown();
}

//------------------------------------------------------------------------------
void vtkPalpPressStyle::OnMouseWheelForward()
{
  if (this->Interactor->GetControlKey())
  {
    this->Turn();
    this->Superclass::OnMouseWheelForward();
    return;
  }
  this->RollWheel(-1);
}

//------------------------------------------------------------------------------
void vtkPalpPressStyle::OnMouseWheelBackward()
{
  if (this->Interactor->GetControlKey())
  {
    this->Turn();
    this->Superclass::OnMouseWheelBackward();
    return;
  }
  this->RollWheel(1);
}

//------------------------------------------------------------------------------
void vtkPalpPressStyle::RollWheel(int notches)
{
  if (!this->Pressing && this->State == VTKIS_NONE)
  {
    const int* position = this->Interactor->GetEventPosition();
    this->Hover(position[0], position[1]); // the wheel may turn before the pointer has moved
  }
  this->Wheel(notches);
}

//------------------------------------------------------------------------------
void vtkPalpPressStyle::OnKeyPress()
{
  struct Key
  {
    const char* Name;
    int Right;
    int Up;
    int Deeper;
    int Nearer;
  };
  static constexpr std::array<Key, 10> kKeys{ { { "Left", -1, 0, 0, 0 }, { "Right", 1, 0, 0, 0 },
    { "Up", 0, 1, 0, 0 }, { "Down", 0, -1, 0, 0 }, { "Next", 0, 0, 1, 0 }, { "Prior", 0, 0, -1, 0 },
    { "plus", 0, 0, 0, 1 }, { "minus", 0, 0, 0, -1 }, { "KP_Add", 0, 0, 0, 1 },
    { "KP_Subtract", 0, 0, 0, -1 } } };
  constexpr double kTurn = 5.0; // [degrees]
  constexpr double kZoom = 1.1;
  const char* name = this->Interactor->GetKeySym();
  const auto* key = std::find_if(kKeys.begin(), kKeys.end(),
    [name](const Key& each) { return name && std::strcmp(name, each.Name) == 0; });
  if (key == kKeys.end())
  {
    return;
  }
  const bool moves = key->Right != 0 || key->Up != 0;
  const bool turns = this->Interactor->GetControlKey() != 0;
  if (turns && !moves)
  {
    return;
  }
  if (key->Nearer != 0 || turns)
  {
    this->Turn();
    const int* at = this->Interactor->GetEventPosition();
    this->FindPokedRenderer(at[0], at[1]);
    this->InvokeEvent(vtkCommand::StartInteractionEvent);
    key->Nearer != 0 ? this->Dolly(std::pow(kZoom, key->Nearer))
                     : this->RotateBy(-kTurn * key->Right, -kTurn * key->Up);
  }
  else
  {
    moves ? this->Slide(key->Right, key->Up) : this->Deepen(key->Deeper);
  }
}

//------------------------------------------------------------------------------
void vtkPalpPressStyle::OnLeave()
{
  if (!this->Pressing) // a drag may go on beyond the view
  {
    this->Leave();
  }
}

//------------------------------------------------------------------------------
void vtkPalpPressStyle::Rotate()
{
  if (!this->CurrentRenderer)
  {
    return;
  }
  constexpr double kDegrees = 20.0; // of a motion across the view, times the factor
  const int* now = this->Interactor->GetEventPosition();
  const int* before = this->Interactor->GetLastEventPosition();
  const int* size = this->CurrentRenderer->GetRenderWindow()->GetSize();
  this->RotateBy((before[0] - now[0]) * kDegrees / size[0] * this->MotionFactor,
    (before[1] - now[1]) * kDegrees / size[1] * this->MotionFactor);
}

//------------------------------------------------------------------------------
void vtkPalpPressStyle::RotateBy(double azimuth, double elevation)
{
  vtkCamera& camera = *this->CurrentRenderer->GetActiveCamera();
  const auto pivot = this->Pivot();
  camera.OrthogonalizeViewUp();
  const Vector kept = pivot ? InView(camera, *pivot) : Vector{};
  camera.Azimuth(azimuth);
  camera.Elevation(elevation);
  camera.OrthogonalizeViewUp();
  if (pivot)
  {
    const Vector moved = InView(camera, *pivot);
    const double* away = camera.GetDirectionOfProjection();
    const double* up = camera.GetViewUp();
    Vector right;
    Vector by;
    vtkMath::Cross(away, up, right.data());
    for (std::size_t i = 0; i < 3; ++i)
    {
      by[i] = (moved[0] - kept[0]) * right[i] + (moved[1] - kept[1]) * up[i] +
        (moved[2] - kept[2]) * away[i];
    }
    Shift(camera, by);
  }
  this->CurrentRenderer->ResetCameraClippingRange();
  this->Interactor->Render();
}

//------------------------------------------------------------------------------
void vtkPalpPressStyle::Dolly(double factor)
{
  if (!this->CurrentRenderer)
  {
    return;
  }
  const int* pointer = this->Interactor->GetEventPosition();
  vtkRenderer* renderer = this->CurrentRenderer;
  vtkCamera& camera = *renderer->GetActiveCamera();
  double focus[3];
  this->ComputeWorldToDisplay(renderer, camera.GetFocalPoint()[0], camera.GetFocalPoint()[1],
    camera.GetFocalPoint()[2], focus);
  const double seen = renderer->GetZ(pointer[0], pointer[1]);
  double place[4];
  double display[3];
  this->ComputeDisplayToWorld(
    renderer, pointer[0], pointer[1], seen < 1.0 ? seen : focus[2], place);
  camera.Dolly(factor);
  // what was below the pointer went away from it at its own distance
  renderer->ResetCameraClippingRange();
  this->ComputeWorldToDisplay(renderer, place[0], place[1], place[2], display);
  double after[4];
  this->ComputeDisplayToWorld(renderer, pointer[0], pointer[1], display[2], after);
  Shift(camera, { place[0] - after[0], place[1] - after[1], place[2] - after[2] });
  renderer->ResetCameraClippingRange();
  this->Interactor->Render();
}
