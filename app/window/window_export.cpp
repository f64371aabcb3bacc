// The folder that the window exports: what was recorded is repeated and drawn by palp run, so that
// the same command gives the same bytes later.

#include "app/folder/autosave.h"
#include "app/folder/export_folder.h"
#include "app/folder/played_plan.h"
#include "app/map/map_files.h"
#include "app/press/export.h"
#include "app/scene/scene_text.h"
#include "app/shell/child_program.h"
#include "app/shell/message_bar.h"
#include "app/window/exported.h"
#include "app/window/window.h"
#include "haptics/error.h"
#include "haptics/files/input_text.h"
#include "haptics/files/replace_file.h"

#include <vtkCamera.h>
#include <vtkRenderer.h>

#include <QAction>
#include <QTemporaryDir>

#include <algorithm>
#include <memory>
#include <system_error>
#include <utility>

namespace palp
{

namespace
{

constexpr int kNoPicture = 4; // exit code of a run that cannot draw

QString filesFoundIn(const std::filesystem::path& directory)
{
  QStringList found;
  for (const std::string& name : exportFiles())
  {
    std::error_code none; // that it cannot be looked into is told by who writes there
    if (std::filesystem::exists(directory / name, none))
    {
      found << QString::fromStdString(name);
    }
  }
  return found.join(", ");
}

std::filesystem::path pathOf(const QTemporaryDir& folder)
{
  if (!folder.isValid())
  {
    throw Error(ErrorCode::BadFile, "no temporary folder can be made; free some space in /tmp");
  }
  return folder.path().toStdString();
}

// what was recorded goes into a folder of its own, from which all else is made
void stage(const std::filesystem::path& folder, Exported& made)
{
  made.take();
  if (!made.plan.allSamples)
  {
    keepContact(made.recording);
  }
  writeSamples(folder / "samples.csv", made.recording, &made.calibration);
  writeProvenance(folder, made.plan, made.recording);
}

void writeExport(const QString& directory, const QTemporaryDir& folder, Exported made)
{
  stage(pathOf(folder), made);
  EndedProgram ended{ kNoPicture, {} };
  for (const bool draws : { true, false })
  {
    if (ended.code == kNoPicture)
    {
      made.plan.picture = draws;
      made.plan.plots = draws ? made.plan.plots : std::vector<PlotKind>{};
      writeScene(pathOf(folder), made.plan, "");
      ended = runProgram("palp", { "run", folder.path(), "--overwrite", "--out", directory });
    }
  }
  throwUnlessWell(ended);
}

// the file that was written, whose ending tells what it is
std::filesystem::path writeMovie(std::filesystem::path to, MovieKind kind, Exported made)
{
  const QTemporaryDir folder;
  const QTemporaryDir drawn;
  stage(pathOf(folder), made);
  made.plan.picture = made.plan.deformed = false;
  made.plan.plots.clear();
  writeScene(pathOf(folder), made.plan, "");
  const std::string& name = kMovieNames[static_cast<std::size_t>(kind)];
  throwUnlessWell(runProgram("palp",
    { "run", folder.path(), "--movie", QString::fromStdString(name), "--overwrite", "--out",
      drawn.path() }));
  std::filesystem::path from = pathOf(drawn) / (name + ".mp4");
  from.replace_extension(std::filesystem::exists(from) ? ".mp4" : ".ogv");
  to.replace_extension(from.extension());
  replaceFile(to, readText(from, "the movie"));
  return to;
}

std::function<Recording()> partOf(const Session& session, const Recording& recording)
{
  return [part = recording.head(), samples = session.samplesOf(recording)]() mutable
  {
    part.samples = samples();
    return std::move(part);
  };
}

// whether one table tells of both: of the same body, tool, tissue and hand, apart in between
bool continues(const ScenePlan& opened, const Pictured& before, const Pictured& after)
{
  const auto isPart = [](const Recording& recording)
  { return !recording.samples.empty() && recording.thinned == 0 && !recording.second; };
  const auto sceneOf = [&opened](const Pictured& seen)
  {
    ScenePlan plan = planOf(opened, seen.body, seen.recording);
    plan.recording.reset();
    return sceneText(plan, "/");
  };
  return isPart(before.recording) && isPart(after.recording) &&
    !before.recording.samples.back().contact.touching() &&
    !after.recording.samples.front().contact.touching() &&
    std::ranges::equal(
      before.recording.files, after.recording.files, {}, &MeshFile::sha256, &MeshFile::sha256) &&
    before.recording.device == after.recording.device && sceneOf(before) == sceneOf(after);
}

} // namespace

CameraPlace Window::cameraPlace() const
{
  vtkCamera& camera = *renderer_->GetActiveCamera();
  return { .position = Eigen::Vector3d(camera.GetPosition()),
    .focus = Eigen::Vector3d(camera.GetFocalPoint()),
    .up = Eigen::Vector3d(camera.GetViewUp()) };
}

void Window::lookFrom(const CameraPlace& place)
{
  vtkCamera& camera = *renderer_->GetActiveCamera();
  camera.SetPosition(place.position.data());
  camera.SetFocalPoint(place.focus.data());
  camera.SetViewUp(place.up.data());
  renderer_->ResetCameraClippingRange();
  keepView();
  isStale_ = true;
}

// a copy, as the window goes on
Exported Window::exported(const Pictured& seen)
{
  Exported made{ .plan = planOf(session_.plan(), seen.body, seen.recording),
    .recording = seen.recording.head(),
    .calibration = seen.calibration,
    .parts = { partOf(session_, seen.recording) },
    .names = session_.presses().names() };
  made.plan.allSamples = findChild<QAction*>("allSamplesExport")->isChecked();
  made.plan.refined = findChild<QAction*>("refinedExport")->isChecked();
  made.plan.camera = seen.seenFrom.value_or(cameraPlace());
  return made;
}

// what is shown, or the newest recording with a press, which may have been loaded
Pictured Window::filmed()
{
  takeSamples();
  const Pictured seen = pictured().recording.isTouched() ? pictured() : recorded(1);
  if (!seen.recording.isTouched())
  {
    throw Error(ErrorCode::BadValue, "a movie shows a press: press first");
  }
  return seen;
}

bool Window::saveMovie(const QString& file, MovieKind kind)
{
  if (!isFree())
  {
    return false;
  }
  return saveInTurn(
    [this, file, kind]
    {
      const Pictured seen = filmed();
      const auto written = inBackground<std::filesystem::path>(tr("Drawing the movie"),
        [made = exported(seen), to = file.toStdString(), kind]() mutable
        { return writeMovie(to, kind, std::move(made)); });
      say(written ? tr("Written to %1").arg(QString::fromStdString(written->string()))
                  : tr("No movie: it was canceled"));
    });
}

bool Window::saveReplay(const QString& file)
{
  return saveMovie(file, MovieKind::Replay);
}

bool Window::saveTurntable(const QString& file)
{
  return saveMovie(file, MovieKind::Turntable);
}

bool Window::exportData(const QString& directory)
{
  if (!isFree())
  {
    return false;
  }
  if (background_.isBusy()) // whose progress would take a question away
  {
    return saveInTurn([this, directory] { exportData(directory); });
  }
  const QString found = filesFoundIn(directory.toStdString());
  if (found.isEmpty())
  {
    return exportInto(directory);
  }
  message_->ask(tr("%1 holds %2 already").arg(directory, found),
    { { tr("Replace"), [this, directory] { exportInto(directory); } } });
  return false;
}

// false: canceled
bool Window::exportOne(const QString& to, Exported made, const Timing* timing)
{
  const auto stage = std::make_shared<QTemporaryDir>();
  if (timing)
  {
    writeTiming(pathOf(*stage) / "servo.csv", *timing);
  }
  return inBackground<bool>(tr("Exporting"),
    [made = std::move(made), to, stage]() mutable
    {
      writeExport(to, *stage, std::move(made));
      return true;
    })
    .has_value();
}

bool Window::exportMap(const std::filesystem::path& folder, const StiffnessMap& map)
{
  return inBackground<bool>(tr("Exporting the map"),
    [folder, map, body = session_.body().felt(session_.organs(), placeOf(map).value_or(0)),
      rated = session_.recording().rated]
    {
      writeMap(folder, map, body, rated);
      isExport(folder) ? addToProvenance(folder, { kMapTable, kMapSurface }) : void();
      return true;
    })
    .has_value();
}

bool Window::exportInto(const QString& directory)
{
  return saveInTurn(
    [this, directory]
    {
      takeSamples();
      const std::filesystem::path folder = directory.toStdString();
      const int saved = autosave_ != nullptr ? autosave_->saved() : 0; // presses go on meanwhile
      const int newest = session_.presses().newest();
      const bool isNewest = session_.recording().isTouched() || session_.earlier().empty();
      const std::size_t takes = session_.earlier().size() + (isNewest ? 1 : 0);
      const auto taken = [this](std::size_t i) { return recorded(session_.earlier().size() - i); };
      QStringList written;
      bool goesOn = true;
      std::size_t folders = 0;
      for (std::size_t i = 0; goesOn && i < takes; ++folders) // the oldest first
      {
        Exported all = exported(taken(i));
        while (++i < takes && continues(session_.plan(), taken(i - 1), taken(i)))
        {
          all.parts.push_back(partOf(session_, taken(i).recording));
        }
        const bool isLast = i == takes; // whose folder is opened and repeated
        const std::filesystem::path name = earlierTake("", folders + 1);
        goesOn = exportOne(QString::fromStdString((isLast ? folder : folder / name).string()),
          std::move(all), isLast && isNewest ? &session_.timing() : nullptr);
        written << (isLast ? tr("scene, samples, presses, deformed mesh and pictures")
                           : QString::fromStdString(name.string()));
      }
      if (const StiffnessMap* map = currentMap(); goesOn && map)
      {
        goesOn = map_->isKept = exportMap(folder, *map);
        written << tr("stiffness map");
      }
      else if (goesOn && map_)
      {
        written << tr("not the stiffness map: take back the change of tool or tissue since "
                      "(Ctrl+Z) to export it");
      }
      if (!goesOn)
      {
        say(tr("Not exported whole: it was canceled"));
        return;
      }
      for (std::size_t i = folders; isExport(earlierTake(folder, i)); ++i) // of what was replaced
      {
        std::filesystem::remove_all(earlierTake(folder, i));
      }
      autosave_ != nullptr ? autosave_->clear(saved) : void();
      session_.presses().noteExported(newest);
      const QString pressless =
        isNewest && !session_.recording().isTouched() ? tr("; no press is in it") : QString();
      say(tr("Written to %1: %2").arg(directory, written.join(", ")) + pressless);
    });
}

} // namespace palp
