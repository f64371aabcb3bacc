#pragma once

#include "haptics/force/force_law.h"
#include "haptics/servo/sample.h"
#include "pipeline/charts/plot.h"
#include "pipeline/charts/vtkPalpSampleSource.h"

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>
#include <vtkContextScene.h>
#include <vtkNew.h>
#include <vtkTable.h>

class vtkPlot;

namespace palp
{

/// The curve of a press that is over, beside the live ones.
struct PressCurve
{
  std::string name;
  std::vector<double> depths{}; ///< [m]
  std::vector<double> forces{}; ///< [N], as many
  appearance::Color color{};
  appearance::LineStyle style = appearance::LineStyle::Solid;
};

/// The live curves: force over the last minute, of the law and as it was sent to the hand, and
/// force over depth with the law under it.
///
/// Each chart is put into a scene of the caller, so that both may share a window or not.
/// Main thread only.
class ForceCharts
{
public:
  /// @param duration  of the whole press [s], from time 0; none: the last minute is shown, without
  ///                  titles, as each chart has those of the panel around it
  explicit ForceCharts(std::optional<double> duration = std::nullopt);
  ForceCharts(const ForceCharts&) = delete;
  ForceCharts& operator=(const ForceCharts&) = delete;

  void addForceOverTime(vtkContextScene& scene);
  void addForceOverDepth(vtkContextScene& scene);

  /// Whether a device is sent a force, which is drawn beside the law's. At first none is.
  void setSent(bool isSent);

  /// Takes a sample; the charts follow at the next refresh().
  void add(const Sample& sample);

  /// Brings plots and axes up to the samples that are seen; the cost does not depend on their
  /// number. Does nothing while it is paused.
  void refresh();

  /// Whether the charts stay as they are; samples, presses and laws are taken all the same. At
  /// first they do not.
  void setPaused(bool paused) noexcept
  {
    isPaused_ = paused;
  }

  /// Forgets the samples, and shows so even while it is paused.
  void clear();

  /// Marks a moment of the samples in both charts; null: none, as at first.
  void mark(const Sample* moment);

  /// The law drawn under the measured points.
  void setLaw(const ForceLaw& law);

  /// Presses drawn over the samples and the law, in their order, from the next refresh() on; they
  /// stay when the samples are cleared. At first there are none.
  void setPresses(std::vector<PressCurve> presses)
  {
    waiting_ = std::move(presses);
  }

  /// Both charts as they were last refreshed, to be laid out anew for a file.
  [[nodiscard]] std::vector<std::unique_ptr<Plot>> plots() const;

private:
  void update();
  void drawPresses();
  void drawLaw(double depthLimit);
  [[nodiscard]] double deepest() const;

  vtkNew<vtkPalpSampleSource> samples_;
  vtkNew<vtkPalpSampleSource> rendered_; // the force that was sent in the place of the law's
  vtkNew<vtkTable> lawTable_;
  vtkNew<vtkTable> marked_; // a row of time [s], depth [mm] and force [N], or none
  vtkNew<vtkPalpPointedChart> overTime_;
  vtkNew<vtkPalpPointedChart> overDepth_;
  vtkPlot* timePlot_ = nullptr; // owned by its chart, as the others
  vtkPlot* lawPlot_ = nullptr;
  vtkPlot* renderedPlot_ = nullptr;
  vtkPlot* depthPlot_ = nullptr;
  std::optional<std::vector<PressCurve>> waiting_; // presses that are not yet drawn
  std::vector<PressCurve> presses_;
  std::vector<vtkPlot*> pressPlots_; // of them
  double duration_;                  // of a press that is known from the start [s]; else 0
  bool isPaused_ = false;
  bool isSent_ = false;
  ForceLaw law_;
  double lawLimit_ = 0.0; // depth to which the law is drawn [m]
};

} // namespace palp
