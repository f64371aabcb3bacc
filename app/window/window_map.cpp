// The map of stiffness over the body: asked for, made while the window goes on, shown, exported.

#include "app/graphs/map_dialog.h"
#include "app/map/map_files.h"
#include "app/panels/press_bar.h"
#include "app/shell/message_bar.h"
#include "app/window/window.h"

#include <QAction>
#include <QMenu>

#include <utility>

namespace palp
{

void Window::addMap(QMenu& edit)
{
  edit.addSeparator();
  edit
    .addAction(
      tr("Stiffness &map…"), this, [this] { askMap(); }, QKeySequence("Ctrl+M"))
    ->setObjectName("mapAction");
  clearMap_ = edit.addAction(tr("Clear stiffness map"), this, [this] { dropMap(); });
  clearMap_->setObjectName("clearMapAction");
  clearMap_->setEnabled(false);
}

void Window::askMap()
{
  if (!isFree())
  {
    return;
  }
  if (!session_.organs().empty())
  {
    message_->warn(tr("The map is of one body: open the file of an organ by itself"));
    return;
  }
  MapRequest usual = map_ ? map_->map.asked : MapRequest{};
  const std::vector<KeptPress>& presses = session_.presses().presses();
  std::optional<Eigen::Vector3d> last;
  if (!presses.empty())
  {
    last = presses.back().summary.deepest.center;
    usual.depth = presses.back().summary.deepest.depth;
  }
  MapDialog dialog(usual, last, this);
  if (dialog.exec() == QDialog::Accepted)
  {
    attempt(
      [&] {
        mapWork_.emplace(session_.recording().scene, dialog.request(), *session_.body().display);
      });
  }
}

// of work that goes on
void Window::followMap()
{
  if (mapWork_ && !mapWork_->isDone())
  {
    message_->follow(
      tr("Pressing for the stiffness map"), mapWork_->percent(), [this] { mapWork_.reset(); });
  }
  else if (mapWork_)
  {
    attempt([this] { takeMap(); });
    mapWork_.reset();
  }
  if (const bool isStale = map_ && !map_->map.holdsIn(session_.recording().scene);
      isStale != mapIsStale_)
  {
    mapIsStale_ = isStale;
    map_->colors = colorsOf(map_->map, map_->points, isStale);
    showMap();
  }
}

void Window::takeMap()
{
  MapWork::Made made = mapWork_->take();
  if (made.map.scene.surface != session_.recording().scene.surface)
  {
    return; // another body is open by now
  }
  say(tr("Stiffness map: %1 of %2 places pressed, %3 to %4 N/mm; File > Export data writes it, too")
        .arg(made.map.pressed())
        .arg(made.map.places.size())
        .arg(made.colors.low, 0, 'f', 2)
        .arg(made.colors.high, 0, 'f', 2));
  map_ = std::move(made);
  mapIsStale_ = false;
  clearMap_->setEnabled(true);
  mapColors_->setEnabled(true);
  mapColors_->setChecked(true);
  showMap();
}

void Window::dropMap()
{
  mapWork_.reset();
  map_.reset();
  mapIsStale_ = false;
  clearMap_->setEnabled(false);
  mapColors_->setChecked(false);
  mapColors_->setEnabled(false);
  showMap();
}

void Window::showMap()
{
  view_.setMap(shownMap());
  isStale_ = true;
}

const SurfaceMap* Window::shownMap() const
{
  const bool isShown = map_ && mapColors_->isChecked() && !review_;
  return isShown ? &map_->colors : nullptr;
}

// null where there is none of the tool and tissue in use
const StiffnessMap* Window::currentMap() const
{
  return map_ && map_->map.holdsIn(session_.recording().scene) ? &map_->map : nullptr;
}

} // namespace palp
