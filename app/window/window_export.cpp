// The folder that the window exports: what was recorded is repeated and drawn by palp run, so that
// the same command gives the same bytes later.

#include "app/folder/autosave.h"
#include "app/folder/export_folder.h"
#include "app/folder/played_plan.h"
#include "app/map/map_files.h"
#include "app/press/export.h"
#include "app/shell/message_bar.h"
#include "app/window/window.h"
#include "haptics/error.h"
#include "haptics/files/input_text.h"
#include "haptics/files/prefix.h"
#include "haptics/files/replace_file.h"

#include <vtkCamera.h>
#include <vtkRenderer.h>

#include <QAction>
#include <QEventLoop>
#include <QProcess>
#include <QTemporaryDir>

#include <algorithm>

namespace palp
{
namespace
{

constexpr int kNoPicture = 4; // exit code of a run that cannot draw

struct Ended
{
  int code;
  QString said; // in one sentence
};

// palp run, while the window goes on
Ended runPalp(const QStringList& arguments)
{
  QProcess palp;
  QEventLoop untilEnd;
  QObject::connect(
    &palp, qOverload<int, QProcess::ExitStatus>(&QProcess::finished), &untilEnd, &QEventLoop::quit);
  QObject::connect(&palp, &QProcess::errorOccurred, &untilEnd, &QEventLoop::quit);
  palp.start(QString::fromStdString((prefix() / "bin" / "palp").string()),
    QStringList{ "run" } << arguments);
  if (palp.state() != QProcess::NotRunning)
  {
    untilEnd.exec(QEventLoop::ExcludeUserInputEvents);
  }
  const bool isWell =
    palp.error() == QProcess::UnknownError && palp.exitStatus() == QProcess::NormalExit;
  const QStringList lines =
    QString::fromLocal8Bit(palp.readAllStandardError()).split('\n', Qt::SkipEmptyParts);
  return { isWell ? palp.exitCode() : -1, lines.isEmpty() ? palp.errorString() : lines.last() };
}

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

ScenePlan Window::stageTake(const std::filesystem::path& folder, const SceneBody& body,
  Recording& recording, const Calibration& calibration) const
{
  ScenePlan plan = planOf(session_.plan(), body, recording);
  plan.allSamples = allSamplesExport_->isChecked();
  plan.refined = refinedExport_->isChecked();
  plan.camera = cameraPlace();
  if (!plan.allSamples)
  {
    keepContact(recording);
  }
  writeSamples(folder / "samples.csv", recording, &calibration);
  writeProvenance(folder, plan, recording);
  return plan;
}

// what was recorded goes into a folder of its own, from which the exported one is made
void Window::exportTake(const QString& directory, const SceneBody& body, Recording recording,
  const Calibration& calibration, const Timing* timing)
{
  const QTemporaryDir stage;
  const std::filesystem::path folder = pathOf(stage);
  recording.names = session_.presses().namesIn(recording);
  ScenePlan plan = stageTake(folder, body, recording, calibration);
  if (timing)
  {
    writeTiming(folder / "servo.csv", *timing);
  }
  Ended ended{ kNoPicture, {} };
  for (const bool draws : { true, false })
  {
    if (ended.code == kNoPicture)
    {
      plan.picture = draws;
      plan.plots = draws ? plan.plots : std::vector<PlotKind>{};
      writeScene(folder, plan, "");
      ended = runPalp({ stage.path(), "--overwrite", "--out", directory });
    }
  }
  if (ended.code != 0)
  {
    throw Error(ErrorCode::BadFile, ended.said.toStdString());
  }
}

// drawn by palp run, while the window goes on
bool Window::saveMovie(const QString& file, MovieKind kind)
{
  return attempt(
    [&]
    {
      takeSamples();
      const Pictured seen = pictured();
      if (seen.recording.deepest() == nullptr)
      {
        throw Error(ErrorCode::BadValue, "a movie shows a press: press first");
      }
      const QTemporaryDir stage;
      const QTemporaryDir made;
      const SceneBody body = seen.body;
      const Calibration calibration = seen.calibration;
      Recording recording = seen.recording;
      ScenePlan plan = stageTake(pathOf(stage), body, recording, calibration);
      plan.picture = plan.deformed = false;
      plan.plots.clear();
      writeScene(pathOf(stage), plan, "");
      say(tr("Drawing the movie…"));
      const std::string& name = kMovieNames[static_cast<std::size_t>(kind)];
      const Ended ended = runPalp({ stage.path(), "--movie", QString::fromStdString(name),
        "--overwrite", "--out", made.path() });
      if (ended.code != 0)
      {
        throw Error(ErrorCode::BadFile, ended.said.toStdString());
      }
      std::filesystem::path from = pathOf(made) / (name + ".mp4");
      from.replace_extension(std::filesystem::exists(from) ? ".mp4" : ".ogv");
      std::filesystem::path to = file.toStdString();
      to.replace_extension(from.extension());
      replaceFile(to, readText(from, "the movie"));
      say(tr("Written to %1").arg(QString::fromStdString(to.string())));
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
  const QString found = filesFoundIn(directory.toStdString());
  if (found.isEmpty())
  {
    return exportInto(directory);
  }
  message_->ask(tr("%1 holds %2 already").arg(directory, found),
    { { tr("Replace"), [this, directory] { exportInto(directory); } } });
  return false;
}

bool Window::exportInto(const QString& directory)
{
  return attempt(
    [&]
    {
      takeSamples();
      const std::filesystem::path folder = directory.toStdString();
      say(tr("Exporting…"));
      QStringList written;
      if (session_.recording().deepest() != nullptr || session_.earlier().empty())
      {
        exportTake(directory, session_.body(), session_.recording(), session_.calibration(),
          &session_.timing());
        written << tr("scene, samples, presses, deformed mesh and pictures");
      }
      for (std::size_t i = 0; i < session_.earlier().size(); ++i)
      {
        const std::filesystem::path name = earlierTake("", i + 1);
        const Session::Take take = session_.earlier()[i]; // the window goes on
        exportTake(QString::fromStdString((folder / name).string()), take.body, take.recording,
          take.calibration, nullptr);
        written << QString::fromStdString(name.string());
      }
      if (const StiffnessMap* map = currentMap())
      {
        writeMap(folder, *map, session_.body(), session_.recording().rated);
        isExport(folder) ? addToProvenance(folder, { kMapTable, kMapSurface }) : void();
        written << tr("stiffness map");
      }
      autosave_ != nullptr ? autosave_->clear() : void();
      say(tr("Written to %1: %2").arg(directory, written.join(", ")));
    });
}

} // namespace palp
