// Presses that are kept on the disk: as they end, or in an export.

#include "app/folder/autosave.h"
#include "app/folder/export_folder.h"
#include "app/shell/change.h"
#include "app/shell/message_bar.h"
#include "app/window/window.h"
#include "haptics/files/input_text.h"

#include <algorithm>
#include <utility>

namespace palp
{

void Window::saveTo(Autosave& autosave)
{
  autosave_ = &autosave;
  session_.saveTo(autosave_);
  autosave_->folder().empty()
    ? message_->warn(tr("Presses are not kept on the disk: export them before you quit; no folder "
                        "can be made in %1")
                       .arg(QString::fromStdString(Autosave::usualRoot().string())))
    : offerPresses();
}

void Window::checkSaved()
{
  try
  {
    autosave_ != nullptr ? autosave_->check() : void();
  }
  catch (const std::exception& error)
  {
    message_->warn(
      tr("A press is not kept on the disk: export it before you quit; %1").arg(error.what()));
  }
}

// asks about those that are nowhere else
bool Window::mayDropPresses()
{
  if (autosave_ == nullptr)
  {
    return true;
  }
  const auto isLost = [this](const KeptPress& press)
  { return press.saved != KeptPress::kElsewhere && !autosave_->has(press.saved); };
  const auto lost =
    static_cast<std::size_t>(std::ranges::count_if(session_.presses().presses(), isLost));
  if (lost == 0)
  {
    return true;
  }
  const QString what = QString::fromStdString(counted(lost, "press", "presses"));
  message_->ask(tr("Neither exported nor kept on the disk: %1").arg(what),
    { { tr("Export data…"), [this] { findChild<QAction*>("exportAction")->trigger(); } },
      { tr("Quit without"),
        [this]
        {
          session_.presses().noteExported(session_.presses().newest());
          close();
        } } });
  return false;
}

void Window::offerPresses()
{
  if (const std::size_t left = autosave_->left().size(); left > 0)
  {
    const QString what = QString::fromStdString(counted(left, "press", "presses"));
    message_->ask(tr("Not exported yet: %1 of before").arg(what),
      { { tr("Restore"), [this] { restorePresses(); } },
        { tr("Discard"), [this] { discardPresses(); } } });
  }
}

void Window::discardPresses()
{
  const std::size_t left = autosave_->left().size();
  if (left == 0)
  {
    message_->warn(tr("None is left to discard: another window has them"));
    return;
  }
  const QString what = QString::fromStdString(counted(left, "press", "presses"));
  const auto discard = [this, what]
  {
    autosave_->discard();
    say(tr("Discarded %1 of before; Undo (Ctrl+Z) brings them back until Palp ends").arg(what));
  };
  const auto undo = [this]
  {
    autosave_->undiscard();
    offerPresses();
  };
  discard();
  undo_.push(new Change(tr("discard %1").arg(what), undo, discard));
}

// as earlier recordings, each on the body that was pressed
std::size_t Window::addTake(const ExportFolder& folder)
{
  std::optional<Session::Take> take =
    inBackground<Session::Take>(tr("Pressing once more"), session_.takeOf(folder));
  const std::size_t found = take ? session_.add(*std::move(take)) : 0;
  takesKept_ = session_.earlier().size();
  return found;
}

bool Window::loadPresses(const QString& folder, bool isAgain)
{
  if (!isFree())
  {
    return false;
  }
  return attempt(
    [&]
    {
      const std::filesystem::path from = std::filesystem::weakly_canonical(folder.toStdString());
      if (loaded_.contains(from) && !isAgain)
      {
        message_->ask(tr("%1 is loaded already").arg(folder),
          { { tr("Load again"), [this, folder] { loadPresses(folder, true); } } });
        return;
      }
      endReview(); // which counts recordings from the last
      std::size_t loaded = 0;
      for (const std::filesystem::path& take : takesIn(folder.toStdString()))
      {
        loaded += addTake(readExport(take));
      }
      loaded_.insert(from);
      sayListed(tr("loaded from %1").arg(folder), loaded);
    });
}

void Window::sayListed(const QString& how, std::size_t presses)
{
  const QString what = QString::fromStdString(counted(presses, "press", "presses"));
  const std::vector<KeptPress>& all = session_.presses().presses();
  const auto isElsewhere = [&](const KeptPress& press)
  { return press.mesh != session_.body().name; };
  const auto other = std::ranges::find_if(all, isElsewhere);
  const QString of = other == all.end()
    ? QString()
    : tr("; some are of %1, not of what is open").arg(QString::fromStdString(other->mesh));
  say(tr("%1 %2: in the list of presses, and exported with the data%3").arg(what, how, of));
}

void Window::restorePresses()
{
  if (!isFree())
  {
    return;
  }
  if (autosave_->left().empty())
  {
    message_->warn(tr("None is left to restore: another window has them"));
    return;
  }
  endReview();
  std::size_t restored = 0;
  for (const std::filesystem::path& press : autosave_->left())
  {
    try
    {
      const std::size_t found = addTake(readExport(press));
      found > 0 ? session_.presses().noteSaved(autosave_->adopt(press)) : void();
      restored += found;
    }
    catch (const std::exception& error)
    {
      message_->warn(tr("A press of before is kept, but not restored: %1").arg(error.what()));
    }
  }
  if (restored > 0)
  {
    sayListed(tr("restored"), restored);
  }
}

// as it is called now; set aside where it is gone
void Window::saveAs(int saved)
{
  if (autosave_ != nullptr && saved > 0)
  {
    autosave_->update(saved, session_.presses().namesOf(saved));
  }
}

} // namespace palp
