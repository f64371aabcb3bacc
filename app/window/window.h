#pragma once

#include "app/session/pointer_tool.h"
#include "app/session/session.h"
#include "haptics/force/validity.h"
#include "pipeline/charts/force_charts.h"
#include "pipeline/view/press_view.h"

#include <QMainWindow>
#include <vtkNew.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

class QLabel;
class QVTKOpenGLNativeWidget;
class vtkContextView;
class vtkGenericOpenGLRenderWindow;
class vtkPalpPressStyle;
class vtkRenderer;

namespace palp
{

class DevicePanel;
class BuildTrace;
class PlotPanel;
class ValidityPanel;
class TissuePanel;

/// The window: the body in 3-D, tool and tissue at the left, live curves at the right.
///
/// Draws what the servo thread publishes and never holds that thread up.
class Window : public QMainWindow
{
  Q_OBJECT

public:
  /// @param session  outlives the window
  Window(Session& session, BuildTrace& trace);
  ~Window() override;

  // What the menus do, once a file is chosen; a failure becomes a message, and false.

  bool openFile(const QString& file); // asks for what the file does not tell
  bool saveScreenshot(const QString& file);
  bool savePlots(const QString& file);
  bool saveCurves(const QString& file);
  bool exportData(const QString& directory);

protected:
  void changeEvent(QEvent* event) override;

private:
  static constexpr const char* kScan = "Scan for devices…";
  static constexpr const char* kHint =
    "Drag down: press    Wheel: hold a depth    Right-drag: rotate    Middle-drag: move    "
    "Ctrl+wheel: zoom";

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
  void fitView();
  void keepView();
  void showReadings();
  void refreshPanels();
  void refreshCharts();
  void refreshTiming();
  void showValidity(const Sample& sample);
  void applyTissue();
  void applyDevice(const QString& name);
  void sayWhatIsKept();
  void sayWhatIsThinned();
  void say(const QString& what);
  bool attempt(const std::function<void()>& work);

  Session& session_;
  vtkNew<vtkGenericOpenGLRenderWindow> renderWindow_;
  vtkNew<vtkRenderer> renderer_;
  vtkNew<vtkPalpPressStyle> style_;
  PressView view_;
  std::unique_ptr<ForceCharts> charts_; // null: the plan names no curves

  PointerTool pointer_;
  std::uint32_t acting_ = 0; // flags since the panels were last brought up to date
  std::uint32_t acted_ = 0;  // and in the time before
  Validity validity_;        // of the law that the session uses
  Sample shown_;             // in the picture
  bool isStale_ = true;      // the picture, whatever the newest sample is
  bool chartsAreStale_ = true;
  std::optional<std::pair<int, int>> fittedTo_ =
    std::pair(0, 0); // size that all of the body is seen in
  std::size_t takesKept_ = 0;
  bool saidThinned_ = false;

  QVTKOpenGLNativeWidget* canvas_ = nullptr;
  vtkNew<vtkContextView> timeView_;
  vtkNew<vtkContextView> depthView_;
  TissuePanel* panel_ = nullptr;
  DevicePanel* devicePanel_ = nullptr;
  ValidityPanel* validityPanel_ = nullptr; // null: the plan rates no sample
  PlotPanel* plots_ = nullptr;             // null: never shown
  QAction* refinedExport_ = nullptr;
  QLabel* forceLabel_ = nullptr;
  QLabel* servoLabel_ = nullptr;
};

} // namespace palp
