#pragma once

#include "app/session.h"
#include "pipeline/force_charts.h"
#include "pipeline/press_view.h"

#include <QMainWindow>
#include <vtkNew.h>
#include <vtkSmartPointer.h>

#include <memory>

class QLabel;
class QTimer;
class QVTKOpenGLNativeWidget;
class vtkGenericOpenGLRenderWindow;
class vtkPalpPressStyle;
class vtkRenderer;

namespace palp
{

class TissuePanel;

/// The window: the body in 3-D, tool and tissue at the left, live curves at the right.
///
/// Draws at 60 Hz what the servo thread publishes and never holds that thread up.
class Window : public QMainWindow
{
  Q_OBJECT

public:
  explicit Window(Session& session);
  ~Window() override;

  /// Writes the 3-D view as it is now. Returns false, and tells the user, when it cannot.
  bool saveScreenshot(const QString& file);
  /// Writes samples.csv and deformed.vtp into a directory; as saveScreenshot.
  bool exportData(const QString& directory);
  /// Shows another surface; as saveScreenshot.
  bool openSurface(const QString& file);

protected:
  void keyPressEvent(QKeyEvent* event) override;

private:
  void makeView();
  void makeDocks();
  void makeMenus();
  void refresh();     // every frame
  void refreshCharts(); // ten times a second
  void applyTissue();
  void showStatus(const Sample& sample);
  bool attempt(const std::function<void()>& work); // an Error becomes a message box

  Session& session_;
  std::unique_ptr<PressView> view_;
  std::unique_ptr<ForceCharts> charts_;
  vtkNew<vtkGenericOpenGLRenderWindow> renderWindow_;
  vtkNew<vtkRenderer> renderer_;
  vtkNew<vtkPalpPressStyle> style_;
  QVTKOpenGLNativeWidget* canvas_ = nullptr;
  QVTKOpenGLNativeWidget* timeChart_ = nullptr;
  QVTKOpenGLNativeWidget* depthChart_ = nullptr;
  TissuePanel* panel_ = nullptr;
  QLabel* forceLabel_ = nullptr;
  QLabel* servoLabel_ = nullptr;
  QTimer* frames_ = nullptr;
  QTimer* plots_ = nullptr;
};

} // namespace palp
