// The map of stiffness over the body: asked for, made while the window goes on, shown, exported.

#include "app/graphs/map_dialog.h"
#include "app/map/map_files.h"
#include "app/organs/organ_list.h"
#include "app/panels/press_bar.h"
#include "app/shell/message_bar.h"
#include "app/window/window.h"
#include "haptics/units.h"

#include <QAction>
#include <QMenu>

#include <algorithm>
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
  QAction* clear = edit.addAction(tr("Clear stiffness map"), this, [this] { dropMap(); });
  clear->setObjectName("clearMapAction");
  clear->setEnabled(false);
}

// the place of the organ that is chosen among those that are felt; 0 where there is one body
std::optional<int> Window::chosenFelt() const
{
  if (session_.organs().empty())
  {
    return 0;
  }
  const std::vector<std::size_t> felt = feltOrgans(session_.organs());
  const auto found = std::ranges::find(felt, organs_->chosen());
  return found != felt.end() ? std::optional(static_cast<int>(found - felt.begin())) : std::nullopt;
}

// the place of an organ among those that are felt; none: it is not, or no longer
std::optional<int> Window::placeOf(const StiffnessMap& map) const
{
  const Scene& scene = session_.scene();
  for (int organ = 0; organ < organCount(scene); ++organ)
  {
    if (organOf(scene, organ).surface == map.scene.surface)
    {
      return organ;
    }
  }
  return std::nullopt;
}

void Window::askMap()
{
  if (!isFree())
  {
    return;
  }
  const std::optional<int> organ = chosenFelt();
  if (!organ)
  {
    message_->warn(tr("A map is of an organ that is pressed: choose one of these in the list"));
    return;
  }
  MapRequest usual = map_ ? map_->map.asked : MapRequest{};
  const std::vector<KeptPress>& presses = session_.presses().presses();
  std::optional<Eigen::Vector3d> last;
  if (!presses.empty() && presses.back().summary.organ == *organ)
  {
    last = presses.back().summary.deepest.center;
    usual.depth = depthToType(presses.back().summary.deepest);
  }
  MapDialog dialog(usual, last, this);
  if (dialog.exec() == QDialog::Accepted)
  {
    attempt(
      [&]
      {
        Scene scene = organOf(session_.scene(), *organ);
        scene.others.clear();
        const SceneBody& body = session_.body().felt(session_.organs(), *organ);
        mapWork_.emplace(scene, dialog.request(), *body.display);
      });
  }
}

// of work that goes on
void Window::followMap()
{
  if (mapWork_ && !mapWork_->isDone())
  {
    message_->follow(tr("Pressing for the stiffness map"), tr("places"), mapWork_->percent(),
      [this] { mapWork_.reset(); });
  }
  else if (mapWork_)
  {
    attempt([this] { takeMap(); });
    mapWork_.reset();
  }
  if (const bool isStale = map_ && currentMap() == nullptr; isStale != mapIsStale_)
  {
    mapIsStale_ = isStale;
    map_->colors = colorsOf(map_->map, map_->points, isStale);
    showMap();
  }
}

void Window::takeMap()
{
  MapWork::Made made = mapWork_->take();
  if (!placeOf(made.map))
  {
    return; // another body is open by now
  }
  const QString found = tr("Stiffness map: %1 of %2 places pressed, %3 to %4 N/mm; ")
                          .arg(made.map.pressed())
                          .arg(made.map.places.size())
                          .arg(made.colors.low, 0, 'g', 3)
                          .arg(made.colors.high, 0, 'g', 3);
  map_ = std::move(made);
  say(found +
    (currentMap() != nullptr ? tr("File > Export data writes it, too")
                             : tr("it is of the tool and the tissue before, and exported once "
                                  "these are taken back (Ctrl+Z)")));
  mapIsStale_ = false;
  findChild<QAction*>("clearMapAction")->setEnabled(true);
  mapColors_->setEnabled(true);
  mapColors_->setChecked(true);
  showMap();
}

void Window::dropMap()
{
  mapWork_.reset();
  map_.reset();
  mapIsStale_ = false;
  findChild<QAction*>("clearMapAction")->setEnabled(false);
  mapColors_->setChecked(false);
  mapColors_->setEnabled(false);
  showMap();
}

// asks about one that would be lost
bool Window::mayDropMap(const QString& otherwise, const std::function<void()>& goOn)
{
  if (!map_ || map_->isKept)
  {
    return true;
  }
  message_->ask(tr("The stiffness map is not exported yet") +
      (currentMap() != nullptr ? QString()
                               : tr("; it is once the tool and the tissue that it is of are taken "
                                    "back (Ctrl+Z)")),
    { { tr("Export data…"), [this] { findChild<QAction*>("exportAction")->trigger(); } },
      { otherwise,
        [this, goOn]
        {
          dropMap();
          goOn();
        } } });
  return false;
}

void Window::showMap()
{
  if (map_)
  {
    const MapRequest& asked = map_->map.asked;
    map_->colors.origin = "stiffness by " + toolAndTissue(map_->map.scene.law) + ", " +
      units::inMillimeters(asked.depth) + " deep";
  }
  view_.setMap(shownMap());
  isStale_ = true;
}

// of the organ that is in the picture
const SurfaceMap* Window::shownMap() const
{
  const bool isShown = map_ && mapColors_->isChecked() && !review_;
  return isShown && placeOf(map_->map) == shown_.organ ? &map_->colors : nullptr;
}

// null where there is none of the tool and tissue in use
const StiffnessMap* Window::currentMap() const
{
  const std::optional<int> organ = map_ ? placeOf(map_->map) : std::nullopt;
  const bool holds = organ && map_->map.holdsIn(organOf(session_.scene(), *organ));
  return holds ? &map_->map : nullptr;
}

} // namespace palp
