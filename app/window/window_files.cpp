// What the window reads and writes, and says of it.

#include "app/panels/device_panel.h"
#include "app/panels/folder_dialog.h"
#include "app/panels/open_dialog.h"
#include "app/panels/press_bar.h"
#include "app/session/live_bodies.h"
#include "app/shell/message_bar.h"
#include "app/window/window.h"
#include "haptics/error.h"
#include "haptics/files/replace_file.h"
#include "haptics/units.h"
#include "pipeline/surface_io/surface_io.h"

#include <QVTKOpenGLNativeWidget.h>
#include <vtkGenericOpenGLRenderWindow.h>

#include <QApplication>
#include <QFileDialog>
#include <QImage>
#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QMenuBar>

namespace palp
{
namespace
{

const QKeySequence kExport("Ctrl+E");

// where a field has the focus, which would take the key for going to its end, or for undoing
// nothing
class KeysFromFields : public QObject
{
public:
  using QObject::QObject;
  bool eventFilter(QObject* watched, QEvent* event) override
  {
    if (event->type() != QEvent::ShortcutOverride)
    {
      return false;
    }
    const auto& key = *static_cast<QKeyEvent*>(event);
    const auto* field = qobject_cast<QLineEdit*>(watched);
    return QKeySequence(key.key() | static_cast<int>(key.modifiers())) == kExport ||
      (field != nullptr && !field->isUndoAvailable() && key.matches(QKeySequence::Undo));
  }
};

void writePicture(const QImage& picture, const std::filesystem::path& file)
{
  replaceFile(file,
    [&](const std::filesystem::path& fresh)
    {
      if (!picture.save(QString::fromStdString(fresh.string())))
      {
        throw Error(ErrorCode::BadFile,
          file.string() + ": cannot be written; choose another folder or a name in .png");
      }
    });
}

QString fileName(const MeshSource& source)
{
  return QString::fromStdString(
    source.bundled.empty() ? source.file.filename().string() : source.bundled);
}

} // namespace

void Window::addOpening(QMenu& file)
{
  QAction* opening = file.addAction(
    tr("&Open…"), this,
    [this]
    {
      if (!isFree())
      {
        return;
      }
      openFiles(QFileDialog::getOpenFileNames(this, tr("Open"), {},
        tr("Surfaces, images, scenes, places, paths, organ files (*.stl *.obj *.ply *.off *.vtk "
           "*.vtp *.vtu %1 *.json *.fcsv *.csv *.organ);;All files (*)")
          .arg(kImageFiles)));
    },
    QKeySequence::Open);
  opening->setObjectName("openAction");
  file.addAction(tr("Open &DICOM folder…"), this,
    [this]
    {
      const QString folder =
        isFree() ? QFileDialog::getExistingDirectory(this, tr("Open DICOM folder")) : QString();
      if (!folder.isEmpty())
      {
        openFile(folder);
      }
    });
  file.addAction(tr("&Load presses…"), this,
    [this]
    {
      const QString folder = isFree()
        ? QFileDialog::getExistingDirectory(this, tr("Load presses of an exported folder"))
        : QString();
      if (!folder.isEmpty())
      {
        loadPresses(folder);
      }
    });
  QAction* restore =
    file.addAction(tr("Restore &presses of before"), this, [this] { restorePresses(); });
  restore->setObjectName("restoreAction");
  connect(&file, &QMenu::aboutToShow, restore,
    [=, this] { restore->setEnabled(autosave_ != nullptr && !autosave_->left().empty()); });
  addRecentFiles(file);
}

void Window::makeFileMenu()
{
  QMenu* file = menuBar()->addMenu(tr("&File"));
  addOpening(*file);
  file->addSeparator();
  const auto addSave = [&](const QString& entry, const QString& title, const char* suggested,
                         const QString& kinds, bool (Window::*save)(const QString&),
                         bool isFilmed = false)
  {
    return file->addAction(entry, this,
      [=, this]
      {
        const bool mayAsk = !isFilmed || (isFree() && attempt([this] { (void)filmed(); }));
        const QString name =
          mayAsk ? QFileDialog::getSaveFileName(this, title, suggested, kinds) : QString();
        if (!name.isEmpty())
        {
          (this->*save)(name);
        }
      });
  };
  addSave(tr("Save &screenshot…"), tr("Save screenshot"), "palp.png", tr("PNG (*.png)"),
    &Window::saveScreenshot)
    ->setShortcut(QKeySequence::Save);
  file
    ->addAction(
      tr("Save fi&gure…"), this, [this] { askFigure(); },
      QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_S))
    ->setObjectName("figureAction");
  addSave(tr("Save &movie of the press…"), tr("Save movie"), "press.mp4",
    tr("Movies (*.mp4 *.ogv)"), &Window::saveReplay, true)
    ->setObjectName("movieAction");
  addSave(tr("Save &turntable…"), tr("Save turntable"), "turntable.mp4", tr("Movies (*.mp4 *.ogv)"),
    &Window::saveTurntable, true)
    ->setObjectName("turntableAction");
  QAction* curves = addSave(tr("Save &curves…"), tr("Save curves"), "curves.png",
    tr("Plots (*.png *.svg *.pdf *.csv)"), &Window::saveCurves);
  file->addSeparator();
  QAction* exporting = file->addAction(tr("&Export data…"), this,
    [this]
    {
      FolderDialog dialog(tr("Export data into"), "palp_export", this);
      if (isFree() && dialog.exec() == QDialog::Accepted)
      {
        exportData(dialog.folder());
      }
    });
  exporting->setObjectName("exportAction");
  exporting->setShortcut(kExport);
  qApp->installEventFilter(new KeysFromFields(this));
  QAction* refined = file->addAction(tr("Export the dent &refined"));
  refined->setObjectName("refinedExport");
  refined->setCheckable(true);
  QAction* allSamples = file->addAction(tr("Export samples &without contact, too"));
  allSamples->setObjectName("allSamplesExport");
  allSamples->setCheckable(true);
  for (QAction* action : { curves, exporting, refined, allSamples })
  {
    action->setEnabled(session_.plan().records()); // without plots no sample is kept
  }
  file->addSeparator();
  file->addAction(tr("&Quit"), this, &QWidget::close, QKeySequence::Quit);
}

void Window::say(const QString& what)
{
  message_->tell(what);
}

// its meshes, organs and, of a search that was graded, nodules; false: given up
bool Window::openBody(const ScenePlan& plan)
{
  if (!mayDropMap(tr("Clear it"), [] {}))
  {
    return false;
  }
  std::optional<SceneBody> body =
    inBackground<SceneBody>(tr("Reading %1").arg(fileName(plan.meshes.front())),
      [plan]
      {
        SceneBody read = loadLiveBodies(plan);
        read.training ? revealNodules(read) : void();
        return read;
      });
  if (!body)
  {
    return false;
  }
  takeSamples();
  const LawMode before = tissueInUse().law.settings().mode;
  session_.open(*std::move(body), plan.organs);
  clearCharts();
  showBody();
  pressBar_->clearPlace();
  if (tissueInUse().law.settings().mode != before)
  {
    say(tr("The law is Corrected now, which alone feels what is inside"));
  }
  return true;
}

// none where it has none or they cannot be read, which is told already
FileOrgans Window::labelsIn(const QString& file)
{
  try
  {
    auto found = inBackground<FileOrgans>(
      tr("Reading the labels"), [file] { return readFileOrgans(file.toStdString(), {}, true); });
    return found ? *std::move(found) : FileOrgans{};
  }
  catch (const Error&)
  {
    return {};
  }
}

bool Window::openFile(const QString& file, UnitChoice unit)
{
  if (!isFree())
  {
    return false;
  }
  bool isOpened = false;
  attempt([&] { isOpened = openAsked({ .file = file.toStdString(), .unit = unit }); });
  tellDevices();
  return isOpened;
}

// with what has to be asked for; throws what no answer to that mends
bool Window::openAsked(MeshSource source)
{
  checkExists(source);
  const QString file = QString::fromStdString(source.file.string());
  std::vector<FileOrgan> organs; // labels of it, an organ each; none: it is one body
  std::optional<OpenDialog> dialog;
  bool opened = false;
  for (bool isAsked = true; isAsked && !opened;)
  {
    try
    {
      isAsked = opened =
        organs.empty() ? openBody({ .meshes = { source } }) : openLabels(source, organs);
    }
    catch (const Error& error)
    {
      if (!dialog)
      {
        if (error.code() != ErrorCode::BadValue || background_.isBusy())
        {
          throw;
        }
        dialog.emplace(file, this).setLabels(isImageFile(file) ? labelsIn(file) : FileOrgans{});
      }
      dialog->setReason(QString::fromStdString(error.what()));
      isAsked = dialog->exec() == QDialog::Accepted;
      source = isAsked ? dialog->source() : source;
      organs = isAsked ? dialog->organs() : organs;
    }
  }
  if (opened)
  {
    memory_.addRecentFile(file);
    QStringList notes;
    for (const std::string& note : session_.body().notes)
    {
      const bool isTold = organs.empty() || note.find("warning: ") != std::string::npos;
      isTold ? void(notes << QString::fromStdString(note)) : void();
    }
    const QString name = QString::fromStdString(session_.body().name);
    const QString told = notes.join("; ");
    say(tr("Opened %1").arg(told.startsWith(name + ':') ? told : (name + ". " + told).trimmed()));
  }
  return opened;
}

bool Window::saveScreenshot(const QString& file)
{
  message_->tell({}); // which the picture gives room to, and does not show
  renderWindow_->Render();
  return saveInTurn(
    [this, file, picture = canvas_->grabFramebuffer()]
    {
      const auto written = inBackground<bool>(tr("Saving the screenshot"),
        [picture, to = file.toStdString()]
        {
          writePicture(picture, to);
          return true;
        });
      say(written
          ? tr("Written to %1: %2 x %3 pixels").arg(file).arg(picture.width()).arg(picture.height())
          : tr("No screenshot: it was canceled"));
    });
}

} // namespace palp
