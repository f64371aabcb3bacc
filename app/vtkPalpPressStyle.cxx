#include "app/vtkPalpPressStyle.h"

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
void vtkPalpPressStyle::OnMouseWheelForward()
{
  if (this->Interactor->GetControlKey())
  {
    this->Superclass::OnMouseWheelForward();
    return;
  }
  this->Wheel(-1);
}

//------------------------------------------------------------------------------
void vtkPalpPressStyle::OnMouseWheelBackward()
{
  if (this->Interactor->GetControlKey())
  {
    this->Superclass::OnMouseWheelBackward();
    return;
  }
  this->Wheel(1);
}
