#pragma once

#include "app/graphs/chart_panel.h"
#include "app/input/scene_plan.h"
#include "app/plots/press_plots.h"

#include <functional>
#include <optional>

class QTabBar;

namespace palp
{

/// Plots that judge the press as it is: section, comparison of forces, R_d. One at a time, drawn
/// only while it can be seen.
class PlotPanel : public ChartPanel
{
  Q_OBJECT

public:
  /// What a tab is called, and how its plots are made.
  struct Page
  {
    QString name;
    std::function<Plots()> make;
  };

  explicit PlotPanel(std::vector<Page> pages, QWidget* parent = nullptr);

  /// Brings a tab to the front.
  void turnTo(const QString& page);

  /// Makes and draws the plots of the tab in front, if anybody sees them; where there is nothing to
  /// make them of, those before stay. So do the axes that are held and the curves that are hidden.
  void refresh();

  /// Writes what is shown; see savePlots.
  /// @throws Error  as savePlots; BadValue: nothing is shown yet
  QString save(const std::filesystem::path& file, std::optional<ImageSize> size = std::nullopt);

  /// The size in which it is saved if nobody wishes another.
  [[nodiscard]] ImageSize usualSize() const;

private:
  void put(Plots plots);

  std::vector<Page> pages_;
  Plots plots_;
  int page_ = 0; // that they are of
  QTabBar* tabs_;
};

/// Writes plots, laid out for print whatever size they have on the screen: letters and lines grow
/// with the size.
///
/// @param size     none: the usual one
/// @return         what was written, for people, as in `1600 x 1000 pixels`
/// @throws Error   as writePlots
QString savePlots(const Plots& plots, const std::filesystem::path& file,
  std::optional<ImageSize> size = std::nullopt);

} // namespace palp
