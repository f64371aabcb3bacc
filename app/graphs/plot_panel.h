#pragma once

#include "app/graphs/chart_panel.h"
#include "app/plots/press_plots.h"

#include <functional>

class QTabBar;

namespace palp
{

/// Plots that judge the press as it is: section, comparison of forces, R_d. One at a time, drawn
/// only while it can be seen.
class PlotPanel : public ChartPanel
{
  Q_OBJECT

public:
  /// What a tab is called, how its plots are made, and what to do where there is nothing to make
  /// them of.
  struct Page
  {
    QString name;
    std::function<Plots()> make;
    QString hint{};
    bool stays = false; ///< what was made of what is no longer there
  };

  explicit PlotPanel(std::vector<Page> pages, QWidget* parent = nullptr);

  /// Brings a tab to the front.
  void turnTo(const QString& page);

  /// Makes and draws the plots of the tab in front, if anybody sees them; the axes that are held
  /// and the curves that are hidden stay.
  void refresh();

  /// What is shown; nothing before the first press.
  [[nodiscard]] const Plots& plots() const noexcept
  {
    return plots_;
  }

private:
  void put(Plots plots);

  std::vector<Page> pages_;
  Plots plots_;
  int page_ = 0; // that they are of
  QTabBar* tabs_;
};

} // namespace palp
