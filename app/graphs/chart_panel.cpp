#include "app/graphs/chart_panel.h"

#include "app/graphs/axes_dialog.h"
#include "app/graphs/chart_theme.h"
#include "app/shell/compose_alone.h"
#include "app/shell/theme.h"

#include <QVTKOpenGLNativeWidget.h>
#include <vtkCommand.h>
#include <vtkContextMouseEvent.h>
#include <vtkContextScene.h>
#include <vtkRenderWindowInteractor.h>

#include <QHBoxLayout>
#include <QLabel>
#include <QToolButton>
#include <QVBoxLayout>

namespace palp
{
namespace
{

QToolButton* addButton(
  QHBoxLayout& row, int at, const QString& name, const char* id, const QString& tip)
{
  auto* button = new QToolButton;
  button->setText(name);
  button->setObjectName(id);
  button->setToolTip(tip);
  button->setAutoRaise(true);
  row.insertWidget(at, button);
  return button;
}

} // namespace

ChartPanel::ChartPanel(const QString& name, QWidget* parent)
  : QWidget(parent)
  , canvas_(new QVTKOpenGLNativeWidget)
  , hint_(new QLabel)
  , row_(new QHBoxLayout)
{
  window_->SetMultiSamples(0);
  canvas_->setObjectName(name);
  canvas_->setAccessibleName(tr("Chart"));
  composeAlone(*canvas_);
  canvas_->setRenderWindow(window_);
  canvas_->setMinimumSize(260, 120);
  canvas_->setToolTip(tr("Wheel: zoom, beside an axis that axis alone\nDrag: move    "
                         "Right-drag: zoom into a rectangle\nDouble click: follow the data again\n"
                         "Click at a name: hide its curve or show it"));
  canvas_->setToolTipDuration(8000);
  window_->GetInteractor()->SetInteractorStyle(style_);
  window_->GetInteractor()->RemoveObservers(vtkCommand::CharEvent); // 3: stereo, e: the end
  window_->GetInteractor()->AddObserver(vtkCommand::LeaveEvent, this, &ChartPanel::leave);
  row_->addStretch(1);
  connect(addButton(*row_, 1, tr("Fit"), "fit", tr("Let the axes follow the data")),
    &QToolButton::clicked, this,
    [this]
    {
      for (vtkPalpChart* chart : charts())
      {
        chart->FollowData();
      }
      draw();
    });
  connect(addButton(*row_, 2, tr("Axes…"), "axes", tr("Hold axes at a range")),
    &QToolButton::clicked, this, &ChartPanel::askAxes);
  connect(addButton(*row_, 3, tr("Save…"), "save",
            tr("Save what is shown, at a size of your choice: PNG, SVG, PDF, CSV")),
    &QToolButton::clicked, this, &ChartPanel::saveAsked);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  layout->addLayout(row_);
  layout->addWidget(canvas_, 1);
  hint_->setObjectName("hint");
  hint_->setAlignment(Qt::AlignCenter);
  hint_->setWordWrap(true);
  hint_->setAttribute(Qt::WA_TransparentForMouseEvents);
  hint_->hide();
  auto* over = new QVBoxLayout(canvas_);
  over->addWidget(hint_);
}

void ChartPanel::setHint(const QString& hint)
{
  hint_->setText(hint);
  hint_->setVisible(!hint.isEmpty());
}

void ChartPanel::offerPause()
{
  pause_ = addButton(*row_, 1, tr("Pause"), "pause",
    tr("Keep the curves as they are; what happens meanwhile is recorded all the same"));
  pause_->setCheckable(true);
  connect(pause_, &QToolButton::toggled, this, &ChartPanel::pauseToggled);
  connect(addButton(*row_, 2, tr("Clear"), "clear",
            tr("Begin the curves anew; the recording keeps what they showed")),
    &QToolButton::clicked, this, &ChartPanel::clearAsked);
}

void ChartPanel::setPaused(bool paused)
{
  pause_->setChecked(paused);
}

void ChartPanel::setScene(vtkContextScene* scene)
{
  style_->SetScene(scene);
}

std::vector<vtkPalpChart*> ChartPanel::charts() const
{
  std::vector<vtkPalpChart*> charts;
  vtkContextScene* scene = style_->GetScene();
  for (unsigned i = 0; scene != nullptr && i < scene->GetNumberOfItems(); ++i)
  {
    if (auto* chart = vtkPalpChart::SafeDownCast(scene->GetItem(i)))
    {
      charts.push_back(chart);
    }
  }
  return charts;
}

void ChartPanel::draw()
{
  if (isVisible())
  {
    const bool dark = isDark(palette());
    for (vtkPalpChart* chart : charts())
    {
      paintChart(*chart, dark);
    }
    paintGround(*window_, dark);
    window_->Render();
  }
}

// which the style of VTK does not tell the charts
void ChartPanel::leave()
{
  for (vtkPalpChart* chart : charts())
  {
    chart->MouseLeaveEvent({});
  }
  draw();
}

void ChartPanel::askAxes()
{
  if (AxesDialog(charts(), this).exec() == QDialog::Accepted)
  {
    draw();
  }
}

} // namespace palp
