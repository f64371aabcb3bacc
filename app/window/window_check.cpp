// What is wrong with the surface that is open: looked for in its file behind the window, marked in
// the picture, repaired into another file.

#include "app/check/check_text.h"
#include "app/check/checked_surface.h"
#include "app/check/panel/check_panel.h"
#include "app/check/panel/repair_dialog.h"
#include "app/check/panel/surface_check.h"
#include "app/organs/organ_list.h"
#include "app/press/body.h"
#include "app/shell/dock.h"
#include "app/shell/message_bar.h"
#include "app/window/window.h"
#include "haptics/error.h"
#include "haptics/files/output_folder.h"

#include <QDockWidget>
#include <vtkCamera.h>
#include <vtkRenderer.h>

#include <cmath>
#include <numbers>

namespace palp
{
namespace
{

// in its file once that is published
struct StagedRepair
{
  CheckedRepair surface;
  std::unique_ptr<OutputFolder> folder;
};

StagedRepair stagedRepair(
  const CheckedSurface& checked, double largestHole, const std::filesystem::path& file)
{
  auto folder = std::make_unique<OutputFolder>(
    file.parent_path(), std::vector{ file.filename().string() }, OutputFolder::Earlier::Replace);
  CheckedRepair surface = repairedSurface(checked, largestHole);
  writeRepaired(folder->stage() / file.filename(), surface, checked);
  return { std::move(surface), std::move(folder) };
}

} // namespace

// the organ that is chosen, or the only body
void Window::checkSurface()
{
  if (!isFree())
  {
    return;
  }
  attempt(
    [this]
    {
      const SceneBody& all = session_.body();
      const SceneBody& body = session_.organs().empty() ? all : all.organs[organs_->chosen()];
      if (body.sources.size() > 1)
      {
        throw Error(ErrorCode::BadValue,
          body.name + ": is of several files, and a check is of one; open that alone");
      }
      const auto felt = body.haptic;
      const MeshSource source = body.sources.front();
      auto checked =
        inBackground<CheckedSurface>(tr("Checking %1").arg(QString::fromStdString(body.name)),
          [source, opened = body.files.front()] { return checkOpened(source, opened); });
      if (checked)
      {
        check_ == nullptr ? makeCheck() : void();
        check_->open(
          std::make_shared<const CheckedSurface>(*std::move(checked)), felt, source.frame());
        auto* dock = findChild<QDockWidget*>(tr("Surface check"));
        dock->show();
        bringUp(dock);
        dock->findChild<QWidget*>("faults")->setFocus();
      }
    });
}

// below the picture, whose marks stay in sight
void Window::makeCheck()
{
  auto* panel = new CheckPanel;
  setCorner(Qt::BottomLeftCorner, Qt::LeftDockWidgetArea); // whose panels want their height
  QDockWidget* dock = addDock(this, Qt::BottomDockWidgetArea, tr("Surface check"), panel);
  check_ = std::make_unique<SurfaceCheck>(*renderer_, *panel, [this] { isStale_ = true; });
  connect(dock, &QDockWidget::visibilityChanged, this,
    [this, dock] { check_->setVisible(!dock->isHidden()); });
  connect(panel, &CheckPanel::lookAsked, this, &Window::lookAtFault);
  connect(panel, &CheckPanel::repairAsked, this, &Window::repairSurface);
}

// which is of the body before
void Window::closeCheck()
{
  if (check_ != nullptr)
  {
    check_->close();
    findChild<QDockWidget*>(tr("Surface check"))->hide();
  }
}

// as near as a third of the body's size
void Window::lookAtFault()
{
  const std::optional<SurfacePoint> fault = check_->place();
  if (!fault)
  {
    return;
  }
  const double halfAngle =
    renderer_->GetActiveCamera()->GetViewAngle() * std::numbers::pi / 180.0 / 2.0;
  const double away = check_->diagonal() / 6.0 / std::tan(halfAngle);
  const bool isUpright = std::abs(fault->normal.z()) > 0.9;
  lookFrom({ .position = fault->position + away * fault->normal,
    .focus = fault->position,
    .up = { 0.0, isUpright ? -1.0 : 0.0, isUpright ? 0.0 : 1.0 } });
}

// published by this thread, so that what is canceled leaves no file
void Window::repairSurface()
{
  const std::shared_ptr<const CheckedSurface> checked = check_->checked();
  RepairDialog dialog(checked->file, this);
  if (dialog.exec() != QDialog::Accepted)
  {
    return;
  }
  saveInTurn(
    [this, checked, file = dialog.file(), hole = dialog.largestHole()]
    {
      const auto repaired = inBackground<StagedRepair>(
        tr("Repairing %1").arg(QString::fromStdString(checked->file.filename().string())),
        [checked, file, hole] { return stagedRepair(*checked, hole, file); });
      if (!repaired)
      {
        say(tr("Nothing is repaired: it was canceled"));
        return;
      }
      repaired->folder->publish();
      const QString name = QString::fromStdString(file.string());
      message_->ask(tr("Written to %1: %2. Checked again: %3")
                      .arg(name, QString::fromStdString(doneIn(repaired->surface.mesh)),
                        QString::fromStdString(verdictOf(repaired->surface.health))),
        { { tr("Open it"), [this, name] { openFile(name, LengthUnit::Millimeter); } } });
    });
}

} // namespace palp
