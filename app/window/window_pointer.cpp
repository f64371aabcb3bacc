// The mouse pointer in the view of the window, as a tool.

#include "app/panels/press_bar.h"
#include "app/panels/press_list.h"
#include "app/places/placed_press.h"
#include "app/shell/dock.h"
#include "app/shell/message_bar.h"
#include "app/window/vtkPalpPressStyle.h"
#include "app/window/window.h"
#include "haptics/error.h"

#include <QVTKOpenGLNativeWidget.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>

#include <QEvent>
#include <QLineEdit>
#include <QTimer>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace palp
{
namespace
{

// since some moment [s]
double now()
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// a place of the picture, 0 at the near plane and 1 at the far one
Eigen::Vector3d worldPoint(vtkRenderer& renderer, double x, double y, double depth)
{
  renderer.SetDisplayPoint(x, y, depth);
  renderer.DisplayToWorld();
  const double* world = renderer.GetWorldPoint();
  return Eigen::Vector3d(world[0], world[1], world[2]) / world[3];
}

} // namespace

SightLine Window::sightLine(double x, double y)
{
  const Eigen::Vector3d near = worldPoint(*renderer_, x, y, 0.0);
  const Eigen::Vector3d far = worldPoint(*renderer_, x, y, 1.0);
  return { .origin = near, .direction = (far - near).normalized() };
}

void Window::makePointer()
{
  style_->Hover = [this](int x, int y)
  {
    pointer_.hover(x, y);
    followPointer();
  };
  style_->Press = [this](int x, int y)
  {
    const bool isOver = pointer_.press(x, y, now());
    followPointer();
    if (isOver)
    {
      pressBar_->showPlace(pointer_.target()->position);
    }
  };
  style_->Drag = [this](int pixelsDown)
  {
    pointer_.drag(pixelsDown);
    followPointer();
  };
  style_->Release = [this]
  {
    pointer_.release(now());
    followPointer();
  };
  style_->Wheel = [this](int notches)
  {
    pointer_.wheel(notches);
    followPointer();
  };
  style_->Slide = [this](int right, int up) { slide(right, up); };
  style_->Deepen = [this](int steps)
  {
    constexpr double kStep = 0.1e-3; // [m]
    pointer_.target() ? void() : slide(0, 0);
    pointer_.deepen(steps * kStep);
    followPointer();
  };
  style_->Turn = [this] { pointer_.turnView(); };
  style_->Pivot = [this]() -> std::optional<std::array<double, 3>>
  {
    const Eigen::Vector3d& center = shown_.contact.center;
    return shown_.contact.touching()
      ? std::optional(std::array{ center.x(), center.y(), center.z() })
      : std::nullopt;
  };
  style_->Leave = [this]
  {
    if (!pointer_.pressesByItself())
    {
      letGo();
    }
  };
  canvas_->interactor()->SetInteractorStyle(style_);
}

void Window::makePressBar()
{
  pressBar_ = new PressBar(this);
  addToolBar(pressBar_);
  connect(pressBar_, &PressBar::pressAsked, this,
    [this]
    {
      const bool isTyped = qobject_cast<QLineEdit*>(focusWidget()) != nullptr;
      pressAtPlace() && isTyped ? canvas_->setFocus() : void(); // whose keys act on the press
    });
  connect(pressBar_, &PressBar::refused, this,
    [this, before = QString()](const QString& why) mutable
    {
      message_->withdraw(before);
      why.isEmpty() ? void() : message_->warn(why);
      before = why;
    });
}

bool Window::pressAtPlace()
{
  const bool isPressed = attempt(
    [this]
    {
      const PlacedPresses presses = pressBar_->presses();
      if (!session_.isLed())
      {
        throw Error(ErrorCode::BadValue,
          "the tool is held by " + session_.recording().device +
            "; choose mouse or hand as the device, which can be led to a place");
      }
      const PressPlace& place = presses.places.front();
      const SurfacePoint point = pressedPoint(place, presses, session_.scene());
      awaited_.begin(presses, session_.recording(), session_.presses());
      pointer_.pressAt(point, presses.depth, presses.speed);
      session_.presses().nameNext(place.name);
      aim();
      if (pressList_ != nullptr && !search_) // which tells what comes of it
      {
        bringUp(qobject_cast<QDockWidget*>(pressList_->parentWidget()));
      }
    });
  isPressed ? message_->withdraw(refusedPlace_) : void(); // which is mended
  refusedPlace_ = isPressed ? QString() : message_->text();
  return isPressed;
}

void Window::aim()
{
  pointer_.update(now());
  pointer_.lead(session_.newest());
  if (const auto target = pointer_.target())
  {
    session_.aim(*target);
  }
}

// where nothing moved before it is shown as soon as the servo has answered
void Window::followPointer()
{
  constexpr int kAnswerMs = 2;
  aim();
  if (still_ > 0 && frames_->remainingTime() > kAnswerMs)
  {
    frames_->start(kAnswerMs);
  }
}

// from where the tool is, or the middle of the picture
void Window::slide(int right, int up)
{
  constexpr int kStep = 4; // [pixels]
  const int* size = renderWindow_->GetSize();
  double at[2]{ 0.5 * size[0], 0.5 * size[1] };
  if (const auto target = pointer_.target())
  {
    renderer_->SetWorldPoint(target->position.x(), target->position.y(), target->position.z(), 1.0);
    renderer_->WorldToDisplay();
    std::copy_n(renderer_->GetDisplayPoint(), 2, at);
  }
  pointer_.hover(static_cast<int>(std::lround(at[0])) + kStep * right,
    static_cast<int>(std::lround(at[1])) + kStep * up);
  followPointer();
}

void Window::letGo()
{
  pointer_.letGo();
  aim();
}

// whoever works in another window holds nothing here
void Window::changeEvent(QEvent* event)
{
  QMainWindow::changeEvent(event);
  if (event->type() == QEvent::ActivationChange && !isActiveWindow() && !pointer_.pressesByItself())
  {
    letGo();
  }
  if (event->type() == QEvent::ActivationChange && !isActiveWindow() && session_.plan().deadMan)
  {
    session_.arm(false); // nor can anybody stop what is felt here
  }
  if (event->type() == QEvent::PaletteChange)
  {
    takeTheme();
  }
}

} // namespace palp
