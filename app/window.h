#pragma once

#include "app/pointer_tool.h"
#include "app/session.h"
#include "haptics/force/validity.h"
#include "pipeline/force_charts.h"
#include "pipeline/press_view.h"

#include <QMainWindow>
#include <vtkNew.h>

#include <cstdint>
#include <functional>
#include <memory>

class QLabel;
class QVTKOpenGLNativeWidget;
class vtkContextView;
class vtkGenericOpenGLRenderWindow;
class vtkPalpPressStyle;
class vtkRenderer;

namespace palp
{

class DevicePanel;
class Ledger;
class PlotPanel;
class ReliancePanel;
class TissuePanel;

/// The window: the body in 3-D, tool and tissue at the left, live curves at the right.
///
/// Draws what the servo thread publishes and never holds that thread up.
class Window : public QMainWindow
{
  Q_OBJECT

public:
  /// @param session  outlives the window
  Window(Session& session, Ledger& ledger);
  ~Window() override;

  // What the menus do, once a file is chosen; a failure becomes a message, and false.

  bool openSurface(const QString& file, const QString& unit);
  bool saveScreenshot(const QString& file);
  bool savePlots(const QString& file);
  bool exportData(const QString& directory);

protected:
  void changeEvent(QEvent* event) override;

private:
  static constexpr const char* kLookForDevices = "look for devices…";
  static constexpr const char* kHint =
    "Point at the surface, press with the left button, drag down to go deeper; the wheel holds a "
    "depth; the right button turns the view, Ctrl and the wheel zoom, the middle button moves it";

  void makeView();
  void makeDocks();
  void makeCharts();
  void makeDevicePanel();
  void makePlots(bool shown);
  void offerDevices();
  void makeFileMenu();
  void makeDeviceMenu();
  void makeViewMenu();
  void showBody();

  // the pointer as a tool, in display pixels
  void makePointer();
  [[nodiscard]] SightLine sightLine(double x, double y);
  void aim();
  void letGo();

  void takeSamples();
  void clearCharts();
  void refresh();
  void refreshPanels();
  void showReliance(const Sample& sample);
  void applyTissue();
  void applyDevice(const QString& name);
  bool attempt(const std::function<void()>& work);

  Session& session_;
  vtkNew<vtkGenericOpenGLRenderWindow> renderWindow_;
  vtkNew<vtkRenderer> renderer_;
  vtkNew<vtkPalpPressStyle> style_;
  PressView view_;
  std::unique_ptr<ForceCharts> charts_; // null: the plan names no curves

  PointerTool pointer_;
  std::uint32_t acting_ = 0; // flags since the panels were last brought up to date
  Validity validity_;        // of the law that the session uses
  Sample shown_;             // in the picture
  bool isStale_ = true;      // the picture, whatever the newest sample is

  QVTKOpenGLNativeWidget* canvas_ = nullptr;
  vtkNew<vtkContextView> timeView_;
  vtkNew<vtkContextView> depthView_;
  TissuePanel* panel_ = nullptr;
  DevicePanel* devicePanel_ = nullptr;
  ReliancePanel* reliance_ = nullptr; // null: the plan rates no sample
  PlotPanel* plots_ = nullptr;        // null: never shown
  QLabel* forceLabel_ = nullptr;
  QLabel* servoLabel_ = nullptr;
};

} // namespace palp
