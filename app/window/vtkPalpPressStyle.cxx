#include "app/window/vtkPalpPressStyle.h"

#include <vtkObjectFactory.h>
#include <vtkRenderWindowInteractor.h>

vtkStandardNewMacro(vtkPalpPressStyle);

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
void vtkPalpPressStyle::OnLeave()
{
  if (!this->Pressing) // a drag may go on beyond the view
  {
    this->Leave();
  }
}
