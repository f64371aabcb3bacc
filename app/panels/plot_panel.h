#pragma once

#include "app/plots/press_plots.h"

#include <QWidget>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkNew.h>

#include <functional>

class QTabBar;

namespace palp
{

/// Plots that judge the press as it is: section, comparison of forces, R_d. One at a time, drawn
/// only while it can be seen.
class PlotPanel : public QWidget
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

  /// Makes and draws the plots of the tab in front, if anybody sees them; where there is nothing to
  /// make them of, those before stay.
  void refresh();

  /// Writes what is shown; see savePlots.
  /// @throws Error  as savePlots; BadValue: nothing is shown yet
  QString save(const std::filesystem::path& file);

Q_SIGNALS:
  void saveAsked();

private:
  std::vector<Page> pages_;
  Plots plots_;
  int page_ = 0; // that they are of
  QTabBar* tabs_;
  vtkNew<vtkGenericOpenGLRenderWindow> window_;
};

/// Writes plots, laid out for print whatever size they have on the screen.
/// @return         what was written, for people, as in `1600 x 1000 pixels`
/// @throws Error   as writePlots
QString savePlots(const Plots& plots, const std::filesystem::path& file);

} // namespace palp
