// The folder that the window exports: what was recorded is repeated and drawn by palp run, so that
// the same command gives the same bytes later.

#include "app/folder/autosave.h"
#include "app/folder/export_folder.h"
#include "app/folder/played_plan.h"
#include "app/map/map_files.h"
#include "app/press/export.h"
#include "app/shell/message_bar.h"
#include "app/window/child_program.h"
#include "app/window/exported.h"
#include "app/window/window.h"
#include "haptics/error.h"
#include "haptics/files/input_text.h"
#include "haptics/files/replace_file.h"

#include <vtkCamera.h>
#include <vtkRenderer.h>

#include <QAction>
#include <QTemporaryDir>

#include <memory>
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
    if (std::filesystem::exists(directory / name))
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
  Recording recording = seen.recording;
  recording.names = session_.presses().namesIn(recording);
  ScenePlan plan = planOf(session_.plan(), seen.body, recording);
  Exported made{ std::move(plan), std::move(recording), seen.calibration };
  made.plan.allSamples = allSamplesExport_->isChecked();
  made.plan.refined = refinedExport_->isChecked();
  made.plan.camera = cameraPlace();
  return made;
}

bool Window::saveMovie(const QString& file, MovieKind kind)
{
  if (!isFree())
  {
    return false;
  }
  return attempt(
    [&]
    {
      takeSamples();
      const Pictured seen = pictured();
      if (seen.recording.deepest() == nullptr)
      {
        throw Error(ErrorCode::BadValue, "a movie shows a press: press first");
      }
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
bool Window::exportTake(const QString& directory, const Pictured& seen, const Timing* timing)
{
  const auto stage = std::make_shared<QTemporaryDir>();
  if (timing)
  {
    writeTiming(pathOf(*stage) / "servo.csv", *timing);
  }
  return inBackground<bool>(tr("Exporting"),
    [made = exported(seen), directory, stage]() mutable
    {
      writeExport(directory, *stage, std::move(made));
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
  return attempt(
    [&]
    {
      takeSamples();
      const std::filesystem::path folder = directory.toStdString();
      const int saved = autosave_ != nullptr ? autosave_->saved() : 0; // presses go on meanwhile
      const bool isNewest = session_.recording().deepest() != nullptr || session_.earlier().empty();
      const std::size_t takes = session_.earlier().size() + (isNewest ? 1 : 0);
      QStringList written;
      bool goesOn = true;
      for (std::size_t i = 0; goesOn && i < takes; ++i) // the oldest first
      {
        const bool isLast = i + 1 == takes; // whose folder is opened and repeated
        const std::filesystem::path name = earlierTake("", i + 1);
        goesOn = exportTake(QString::fromStdString((isLast ? folder : folder / name).string()),
          recorded(session_.earlier().size() - i),
          isLast && isNewest ? &session_.timing() : nullptr);
        written << (isLast ? tr("scene, samples, presses, deformed mesh and pictures")
                           : QString::fromStdString(name.string()));
      }
      if (const StiffnessMap* map = currentMap(); goesOn && map)
      {
        goesOn = exportMap(folder, *map);
        written << tr("stiffness map");
      }
      if (!goesOn)
      {
        say(tr("Not exported whole: it was canceled"));
        return;
      }
      for (std::size_t i = takes; isExport(earlierTake(folder, i)); ++i) // of what was replaced
      {
        std::filesystem::remove_all(earlierTake(folder, i));
      }
      autosave_ != nullptr ? autosave_->clear(saved) : void();
      say(tr("Written to %1: %2").arg(directory, written.join(", ")));
    });
}

} // namespace palp
