// What a window of any program has: recent files, drag and drop, panels, help, a bar of tools.

#include "app/shell/key_sheet.h"
#include "app/shell/message_bar.h"
#include "app/window/window.h"

#include <QAction>
#include <QCloseEvent>
#include <QDockWidget>
#include <QDragEnterEvent>
#include <QFileInfo>
#include <QMenuBar>
#include <QMessageBox>
#include <QMimeData>
#include <QStyle>
#include <QTimer>
#include <QToolBar>
#include <QUrl>
#include <vtkVersion.h>

namespace palp
{
namespace
{

QStringList filesOf(const QMimeData& dragged)
{
  QStringList files;
  for (const QUrl& url : dragged.urls())
  {
    if (url.isLocalFile())
    {
      files << url.toLocalFile();
    }
  }
  return files;
}

} // namespace

void Window::closeEvent(QCloseEvent* event)
{
  if (!saves_.mayClose() || !mayDropPresses() ||
    !mayDropMap(tr("Quit without it"), [this] { close(); }))
  {
    event->ignore();
    return;
  }
  background_.giveUpAll();
  memory_.save(*this);
  QMainWindow::closeEvent(event);
}

void Window::dragEnterEvent(QDragEnterEvent* event)
{
  if (!filesOf(*event->mimeData()).isEmpty())
  {
    event->acceptProposedAction();
  }
}

void Window::dropEvent(QDropEvent* event)
{
  const QStringList files = filesOf(*event->mimeData());
  if (files.isEmpty())
  {
    return;
  }
  event->acceptProposedAction();
  // when the drop is over: the program that the files are from waits for that, and not for answers
  QTimer::singleShot(0, this, [this, files] { openFiles(files); });
}

// listed when it is looked at, as another window may have opened more
void Window::addRecentFiles(QMenu& menu)
{
  QMenu* recent = menu.addMenu(tr("Open &recent"));
  recent->setObjectName("recentFiles");
  connect(recent, &QMenu::aboutToShow, this,
    [this, recent]
    {
      recent->clear();
      for (const QString& file : memory_.recentFiles())
      {
        QAction* entry = recent->addAction(
          QFileInfo(file).fileName().replace('&', "&&"), this, [this, file] { openRecent(file); });
        entry->setToolTip(file);
      }
      if (recent->isEmpty())
      {
        recent->addAction(tr("none so far"))->setEnabled(false);
      }
    });
  recent->setToolTipsVisible(true);
}

void Window::openRecent(const QString& file)
{
  if (QFileInfo::exists(file))
  {
    openFiles({ file });
    return;
  }
  memory_.forgetRecentFile(file);
  say(tr("%1 is there no longer; it is off the list").arg(file));
}

void Window::greet()
{
  if (!search_ && memory_.isFirstTime()) // a search has told what to do
  {
    say(tr("Drag down on the organ to press it; H shows all keys and what the mouse does"));
  }
  const QString warning = "warning: "; // behind the name of an organ
  QStringList warnings;
  for (const std::string& note : session_.body().notes)
  {
    const QString text = QString::fromStdString(note);
    text.contains(warning) ? void(warnings << QString(text).remove(warning)) : void();
  }
  warnings.empty() ? void() : message_->warn(warnings.join("; "));
}

void Window::makeHelpMenu()
{
  QMenu* help = menuBar()->addMenu(tr("&Help"));
  QAction* keys = help->addAction(tr("&Mouse and keys"), this,
    [this]
    {
      const std::vector<KeyEntry> mouse{ { tr("Left button, drag down"), tr("Press, and deeper") },
        { tr("Click"), tr("Press 1 mm") },
        { tr("Wheel"), tr("Hold a depth while the tool slides") },
        { tr("Place, Return"), tr("Press at a place that is typed above the picture") },
        { tr("Arrows, Page Down or Up"), tr("In the picture: slide, press 0.1 mm deeper or less") },
        { tr("F2"), tr("In the list of presses: rename") },
        { tr("Right-drag, Ctrl+arrows"), tr("Rotate the view") },
        { tr("C, held"), tr("A device's tool stays while the hand goes elsewhere") },
        { tr("Middle-drag"), tr("Move the view") }, { tr("Ctrl+wheel, + or -"), tr("Zoom") } };
      showKeySheet(*this, mouse, *menuBar());
    });
  keys->setObjectName("keysAction");
  keys->setShortcuts({ QKeySequence(Qt::Key_F1), QKeySequence(Qt::Key_H) });
  help->addAction(tr("&About Palp"), this,
    [this]
    {
      QMessageBox::about(this, tr("About Palp"),
        tr("<b>Palp " PALP_VERSION "</b><p>Press a liver on the screen: see the dent, feel the "
           "reaction, watch the force, keep every number.<p>VTK %1, Qt %2")
          .arg(QString(vtkVersion::GetVTKVersion()), qVersion()));
    });
}

// what is used most
void Window::makeToolBar()
{
  QToolBar* bar = addToolBar(tr("Tools"));
  bar->setObjectName("toolBar");
  bar->setIconSize(QSize(16, 16));
  bar->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  struct Entry
  {
    const char* action;
    QString name;
    QStyle::StandardPixmap icon;
  };
  for (const Entry& entry : { Entry{ "openAction", tr("Open"), QStyle::SP_DialogOpenButton },
         Entry{ "figureAction", tr("Figure"), QStyle::SP_DialogSaveButton },
         Entry{ "exportAction", tr("Export"), QStyle::SP_DriveHDIcon },
         Entry{ "resetViewAction", tr("Reset view"), QStyle::SP_BrowserReload },
         Entry{ "plotsAction", tr("Plots"), QStyle::SP_FileDialogDetailedView } })
  {
    auto* action = findChild<QAction*>(entry.action);
    action->setIconText(entry.name);
    action->setIcon(style()->standardIcon(entry.icon));
    action->setIconVisibleInMenu(false);
    bar->addAction(action);
  }
}

void Window::showProgress(const QString& what, const FollowedWork::Step& step)
{
  constexpr int kWhole = 100;
  const QString waiting = background_.waiting() > 0
    ? tr(" (then %1 more to save)").arg(background_.waiting())
    : QString();
  message_->follow(what, QString::fromStdString(step.what) + waiting,
    step.done ? std::optional(static_cast<int>(kWhole * *step.done)) : std::nullopt,
    [this] { background_.giveUp(); });
}

// at once, or after what is saved already
bool Window::saveInTurn(const std::function<void()>& save)
{
  const auto saveNow = [this, save] { return attempt([&] { saves_.write(save); }); };
  if (!background_.isBusy())
  {
    return saveNow();
  }
  background_.later(saveNow);
  return true;
}

bool Window::attempt(const std::function<void()>& work)
{
  try
  {
    work();
    return true;
  }
  catch (const std::exception& error)
  {
    saves_.keepOpen(); // else nobody reads it
    message_->warn(QString::fromStdString(error.what()));
    return false;
  }
}

} // namespace palp
