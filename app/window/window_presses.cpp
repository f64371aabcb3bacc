// Presses as things of the window: listed, compared, repeated; and what is changed can be undone.

#include "app/input/law_options.h"
#include "app/input/tip_text.h"
#include "app/organs/organ_list.h"
#include "app/organs/tissue_map_dialog.h"
#include "app/panels/press_bar.h"
#include "app/panels/press_list.h"
#include "app/panels/tissue_panel.h"
#include "app/plots/kept_presses.h"
#include "app/press/press_fit.h"
#include "app/shell/change.h"
#include "app/shell/dock.h"
#include "app/window/window.h"
#include "haptics/error.h"
#include "haptics/files/input_text.h"
#include "haptics/units.h"

#include <QAction>
#include <QMenu>
#include <QMenuBar>

#include <algorithm>
#include <iterator>
#include <utility>

namespace palp
{
namespace
{

// with every setting of a law but its mode
ForceLaw inMode(const ForceLaw& law, LawMode mode)
{
  const LawSettings& before = law.settings();
  LawOptions options{ .mode = mode, .base = before.base, .constitution = before.constitution };
  if (mode == LawMode::Corrected)
  {
    options.coatings = before.coatings;
    options.relaxation = before.relaxation;
    options.friction = before.friction;
  }
  return { law.tip(), law.material(), options.settings() };
}

ForceLaw lawOf(const KeptPress& press, const ForceLaw& inUse, PressList::Again how)
{
  switch (how)
  {
    case PressList::Again::AsThen:
      return press.law;
    case PressList::Again::Paper:
      return inMode(press.law, LawMode::Paper);
    case PressList::Again::Exact:
      return inMode(press.law, LawMode::Exact);
    case PressList::Again::Corrected:
      return inMode(press.law, LawMode::Corrected);
    case PressList::Again::AsNow:
      break;
  }
  return inUse;
}

} // namespace

void Window::makePressList()
{
  pressList_ = new PressList(session_.presses());
  QDockWidget* dock = addDock(this, Qt::RightDockWidgetArea, tr("Presses"), pressList_);
  if (auto* chart = findChild<QDockWidget*>(tr("Force over time")))
  {
    tabifyDockWidget(chart, dock); // three below each other would be too low
    chart->raise();
  }
  auto* edit = findChild<QMenu*>("editMenu");
  edit->addSeparator();
  edit->addActions(pressList_->actions());
  connect(pressList_, &PressList::compareAsked, this, [this] { showPlots(tr("Presses")); });
  connect(pressList_, &PressList::tickedChanged, this, &Window::showTicked);
  connect(pressList_, &PressList::comparedChanged, this, [this] { chartsAreStale_ = true; });
  connect(pressList_, &PressList::fitAsked, this, &Window::fitPressed);
  connect(pressList_, &PressList::renamed, this, &Window::renamePress);
  connect(pressList_, &PressList::deleteAsked, this, &Window::deletePresses);
  connect(pressList_, &PressList::againAsked, this,
    [this](int id, PressList::Again how) {
      pressAgain(id, [&](const KeptPress& press) { return lawOf(press, tissueInUse().law, how); });
    });
  connect(pressList_, &PressList::againWithAsked, this,
    [this](int id, const QString& tool)
    {
      pressAgain(id,
        [&](const KeptPress& press) {
          return ForceLaw(parseTip(tool.toStdString()), press.law.material(), press.law.settings());
        });
    });
}

void Window::showTicked()
{
  charts_->setPresses(pressCurves(pressList_->ticked()));
  chartsAreStale_ = true;
}

void Window::makeEditMenu()
{
  QMenu* edit = menuBar()->addMenu(tr("&Edit"));
  edit->setObjectName("editMenu");
  QAction* undo = undo_.createUndoAction(this, tr("&Undo"));
  undo->setObjectName("undoAction");
  undo->setShortcut(QKeySequence::Undo);
  QAction* redo = undo_.createRedoAction(this, tr("&Redo"));
  redo->setShortcuts({ QKeySequence("Ctrl+Shift+Z"), QKeySequence("Ctrl+Y") });
  edit->addActions({ undo, redo });
  addMap(*edit);
  edit
    ->addAction(tr("&Young's modulus map…"), this,
      [this]
      {
        std::vector<MeshSource> meshes = session_.body().sources;
        const std::size_t first = organs_ && !session_.organs().empty() ? organs_->chosen() : 0;
        const auto map = isFree() ? askTissueMap(this, meshes[first].stiffness) : std::nullopt;
        if (map)
        {
          const auto end = session_.organs().empty() ? meshes.end() : meshes.begin() + first + 1;
          std::for_each(
            meshes.begin() + first, end, [&](MeshSource& mesh) { mesh.stiffness = *map; });
          attempt([&] { openBody({ .meshes = meshes, .organs = session_.organs() }); });
        }
      })
    ->setObjectName("tissueMapAction");
  edit->addAction(tr("S&upports…"), this, [this] { showSupports(); })
    ->setObjectName("supportsAction");
  edit
    ->addAction(
      tr("&Check surface…"), this, [this] { checkSurface(); }, QKeySequence(Qt::Key_F7))
    ->setObjectName("checkAction");
}

// there, as deep as then
void Window::pressAgain(int id, const std::function<ForceLaw(const KeptPress&)>& lawOf)
{
  if (!isFree())
  {
    return;
  }
  attempt(
    [&]
    {
      const KeptPress* press = session_.presses().find(id);
      if (press == nullptr)
      {
        return;
      }
      if (press->mesh != session_.body().name)
      {
        throw Error(ErrorCode::BadValue,
          press->summary.name + ": it was of " + press->mesh + "; open that first");
      }
      organs_ ? organs_->choose(press->organ) : void();
      Scene scene = tissueInUse();
      scene.law = lawOf(*press);
      pressBar_->showPress(press->summary.deepest);
      panel_->setScene(scene);
      changeTissue() ? void(pressAtPlace()) : void();
    });
}

void Window::fitPressed(int id)
{
  if (!isFree())
  {
    return;
  }
  attempt(
    [&]
    {
      const KeptPress* press = session_.presses().find(id);
      if (press == nullptr)
      {
        return;
      }
      const std::string name = press->summary.name;
      const auto made = inBackground<fit::ModulusFit>(
        tr("Fitting E"), [press = *press] { return fitPress(press); });
      if (!made)
      {
        return;
      }
      const fit::ModulusFit& fit = *made;
      const auto text = [](double pascals)
      { return QString::number(units::toKilopascals(pascals), 'g', 4); };
      const fit::Estimate& modulus = fit.asked().curve.scale;
      QString answer = tr("%1: E = %2 kPa, 95 % interval %3 to %4 kPa, by the %5 law")
                         .arg(QString::fromStdString(name), text(modulus.value), text(modulus.low),
                           text(modulus.high), QString::fromStdString(fit.asked().name));
      if (const fit::Estimate* exponent = fit.exponent())
      {
        answer += tr("; F grows as δ^%1").arg(exponent->value, 0, 'f', 2);
      }
      say(answer +
        tr("; explained best by the %1 law").arg(QString::fromStdString(fit.laws[fit.best].name)));
    });
}

void Window::renamePress(int id, const QString& name)
{
  const KeptPress* press = session_.presses().find(id);
  if (press == nullptr)
  {
    return;
  }
  const std::string before = press->summary.name;
  const int saved = press->saved;
  const std::string after = name.isEmpty() ? before : name.toStdString();
  const auto call = [this, id, saved](const std::string& called)
  {
    return [this, id, saved, called]
    {
      session_.presses().rename(id, called);
      saveAs(saved);
    };
  };
  call(after)();
  if (after != before)
  {
    undo_.push(new Change(tr("rename a press"), call(before), call(after)));
  }
}

void Window::deletePresses(const std::vector<int>& ids)
{
  PressLog& log = session_.presses();
  std::vector<KeptPress> gone;
  std::ranges::copy_if(log.presses(), std::back_inserter(gone),
    [&ids](const KeptPress& press) { return std::ranges::find(ids, press.id) != ids.end(); });
  const auto remove = [this, &log, gone]
  {
    for (const KeptPress& press : gone)
    {
      log.remove(press.id);
      saveAs(press.saved);
    }
  };
  const auto restore = [this, &log, gone]
  {
    for (const KeptPress& press : gone)
    {
      log.restore(press);
      saveAs(press.saved);
    }
  };
  remove();
  const QString what = QString::fromStdString(counted(gone.size(), "press", "presses"));
  undo_.push(new Change(tr("delete %1").arg(what), restore, remove));
}

} // namespace palp
