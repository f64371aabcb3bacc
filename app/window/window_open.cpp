// Files of every kind that the window reads, by the menu, dropped or chosen again.

#include "app/folder/export_folder.h"
#include "app/panels/press_bar.h"
#include "app/panels/tissue_panel.h"
#include "app/places/fiducial_file.h"
#include "app/scene/scene_file.h"
#include "app/supports/organ_seal.h"
#include "app/supports/support_text.h"
#include "app/window/window.h"
#include "calibration/tables/organ_table.h"
#include "haptics/error.h"
#include "haptics/files/input_text.h"

#include <QFileInfo>

#include <utility>

namespace palp
{
namespace
{

enum class FileKind
{
  Body,
  Export,
  Scene,
  Places,
  Profile,
  Path,
  Samples,
  Organ,
};

// a table is told by its columns
FileKind kindOfTable(const QString& file)
{
  const std::string text = readText(file.toStdString(), "the table");
  const auto has = [&text](const char* column) { return text.find(column) != std::string::npos; };
  return has("radius_mm,height_mm") ? FileKind::Profile
    : has("force_N")                ? FileKind::Samples
                                    : FileKind::Path;
}

FileKind kindOf(const QString& file)
{
  const auto ends = [&file](const char* ending)
  { return file.endsWith(ending, Qt::CaseInsensitive); };
  return isExport(file.toStdString())          ? FileKind::Export
    : ends(".fcsv") || ends(".mrk.json")       ? FileKind::Places
    : ends(".organ")                           ? FileKind::Organ
    : ends(".json")                            ? FileKind::Scene
    : ends(".csv") && QFileInfo(file).isFile() ? kindOfTable(file)
                                               : FileKind::Body;
}

// none where those that were painted are not there, or are others by now
std::vector<std::string> supportsBeside(
  const std::filesystem::path& organ, const std::string& described)
{
  std::vector<std::string> supports = supportsIn(described, organ.parent_path());
  try
  {
    checkSupports(supports, organ, described);
  }
  catch (const Error&)
  {
    supports.clear();
  }
  return supports;
}

} // namespace

void Window::openOther(const QString& file)
{
  switch (kindOf(file))
  {
    case FileKind::Export:
      loadPresses(file);
      break;
    case FileKind::Scene:
      openScene(file);
      break;
    case FileKind::Places:
      openPlaces(file);
      break;
    case FileKind::Profile:
      panel_->askForProfile(file);
      break;
    case FileKind::Path:
      applyDevice("path:" + file);
      break;
    case FileKind::Samples:
      applyDevice("replay:" + file);
      break;
    case FileKind::Organ:
      openOrgan(file);
      break;
    case FileKind::Body:
      break;
  }
}

// how the body that is open, or an organ of it, gives way as a whole
void Window::openOrgan(const QString& file)
{
  checkSeal(file.toStdString());
  const OrganTable table = readOrganTable(file.toStdString());
  const SceneBody& body = session_.body();
  std::vector<MeshSource> meshes = body.sources;
  bool isOfIt = false;
  for (std::size_t i = 0; i < meshes.size(); ++i)
  {
    const MeshFile& felt = body.organs.empty() ? body.files[i] : body.organs[i].files.front();
    if (identityOf(felt) == table.mesh)
    {
      meshes[i].organ = file.toStdString();
      meshes[i].supports = supportsBeside(file.toStdString(), table.supports);
      isOfIt = true;
    }
  }
  if (!isOfIt)
  {
    throw Error(ErrorCode::BadFile,
      file.toStdString() + ": is of another surface than what is open; open that first");
  }
  if (openBody({ .meshes = meshes, .organs = session_.organs() }))
  {
    say(tr("%1 gives way as a whole, by %2")
          .arg(QString::fromStdString(session_.body().name), QFileInfo(file).fileName()));
  }
}

// bodies first, for the others are of them; several are one that has several parts
bool Window::openFiles(const QStringList& files)
{
  if (!isFree())
  {
    return false;
  }
  return attempt(
    [&]
    {
      std::vector<MeshSource> parts;
      QStringList others;
      for (const QString& file : files)
      {
        kindOf(file) == FileKind::Body ? parts.push_back({ .file = file.toStdString() })
                                       : others.push_back(file);
      }
      if (parts.size() == 1)
      {
        openFile(QString::fromStdString(parts.front().file.string()));
      }
      else if (!parts.empty() && openBody({ .meshes = parts }))
      {
        say(tr("Opened %1 as one body").arg(QString::fromStdString(session_.body().name)));
      }
      for (const QString& file : others)
      {
        openOther(file);
      }
    });
}

// what a window can be changed to: body, tool, tissue, law, device and view
void Window::openScene(const QString& file)
{
  const ScenePlan plan = readScene(file.toStdString());
  const bool wasGraded = plan.training && plan.training->marks;
  if (!openBody({ .meshes = plan.meshes,
        .organs = plan.organs,
        .press = plan.press,
        .training = wasGraded ? plan.training : std::nullopt }))
  {
    return;
  }
  if (plan.organs.empty()) // which have theirs
  {
    Scene scene = session_.scene();
    scene.law = plan.press.tissue.law();
    scene.rule = plan.press.contact;
    scene.damping = plan.press.damping;
    panel_->setScene(scene);
    changeTissue();
  }
  if (plan.device.isScript())
  {
    applyDevice(QString::fromStdString(plan.device.name));
  }
  if (plan.presses)
  {
    pressBar_->offer(*plan.presses);
  }
  if (plan.camera)
  {
    lookFrom(*plan.camera);
  }
  if (plan.training && !wasGraded)
  {
    showTraining();
    startTraining(*plan.training);
    return;
  }
  say(tr("Opened the scene %1").arg(QFileInfo(file).fileName()));
}

void Window::openPlaces(const QString& file)
{
  PlacedPresses presses = pressBar_->values();
  Fiducials found = readFiducials(file.toStdString());
  presses.places = std::move(found.places);
  pressBar_->offer(presses);
  const auto count = [](std::size_t number, const char* what)
  { return QString::fromStdString(counted(number, what)); };
  const QString leftOut = found.unplaced > 0
    ? tr("; %1 without a place left out").arg(count(found.unplaced, "point"))
    : QString();
  message_->ask(tr("%1: %2, to be chosen at Place%3")
                  .arg(QFileInfo(file).fileName(), count(presses.places.size(), "place"), leftOut),
    { { tr("Press all"),
      [this, places = presses.places] { queued_.assign(places.begin(), places.end()); } } });
}

// what the one before met is told, and the next of several places, which names its press, pressed
void Window::pressQueued()
{
  PressLog& log = session_.presses();
  const bool isFree = !pointer_.pressesByItself() && !session_.newest().contact.touching();
  if (!isFree || log.isPressing())
  {
    return;
  }
  if (const std::string note = awaited_.end(log); !note.empty())
  {
    log.nameNext({}); // which was of that press
    message_->warn(QString::fromStdString(note));
    refusedPlace_ = message_->text();
  }
  if (!queued_.empty())
  {
    const PressPlace place = queued_.front();
    queued_.pop_front();
    pressBar_->showPlace(place.position);
    pressAtPlace() ? log.nameNext(place.name) : void();
  }
}

} // namespace palp
