#pragma once

#include "pipeline/charts/vtkPalpChart.h"

#include <QWidget>
#include <vtkContextInteractorStyle.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkNew.h>

#include <vector>

class QHBoxLayout;
class QLabel;
class QToolButton;
class QVTKOpenGLNativeWidget;

namespace palp
{

/// Charts under the pointer, with what is done to them in a row above: the axes, the file, and for
/// curves that grow, pause and clear.
class ChartPanel : public QWidget
{
  Q_OBJECT

public:
  /// @param name  of the canvas, for who looks for it
  explicit ChartPanel(const QString& name, QWidget* parent = nullptr);

  /// Adds pause and clear.
  void offerPause();

  /// Where another panel was paused.
  void setPaused(bool paused);

  [[nodiscard]] vtkRenderWindow& window()
  {
    return *window_;
  }

  ///@{
  /// The scene, of the window, whose charts the pointer acts on.
  void setScene(vtkContextScene* scene);
  [[nodiscard]] vtkContextScene* scene()
  {
    return style_->GetScene();
  }
  ///@}

  [[nodiscard]] std::vector<vtkPalpChart*> charts() const;

  /// What to do where there is nothing to draw; empty: there is.
  void setHint(const QString& hint);

  /// Draws, where anybody sees it.
  void draw();

Q_SIGNALS:
  void pauseToggled(bool paused);
  void clearAsked();
  void saveAsked();

private:
  void askAxes();
  void leave();

  vtkNew<vtkGenericOpenGLRenderWindow> window_;
  vtkNew<vtkContextInteractorStyle> style_;
  QVTKOpenGLNativeWidget* canvas_;
  QLabel* hint_;
  QHBoxLayout* row_;
  QToolButton* pause_ = nullptr; // null: not offered
};

} // namespace palp
