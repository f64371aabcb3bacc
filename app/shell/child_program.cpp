#include "app/shell/child_program.h"

#include "haptics/error.h"
#include "haptics/files/prefix.h"
#include "haptics/threads/followed_work.h"

#include <QProcess>
#include <QProcessEnvironment>

#include <sys/resource.h>

namespace palp
{
namespace
{

// what a program has said, its lines of progress told on
QStringList linesOf(QProcess& palp)
{
  const QString mark = "palp: progress ";
  QStringList said;
  while (palp.canReadLine())
  {
    const QString line = QString::fromLocal8Bit(palp.readLine()).trimmed();
    if (!line.startsWith(mark))
    {
      said << line;
      continue;
    }
    const QString step = line.mid(mark.size()); // 34 pictures
    FollowedWork& work = *FollowedWork::ofThisThread();
    work.begin(step.section(' ', 1).toStdString());
    const int percent = step.section(' ', 0, 0).toInt();
    percent > 0 ? work.tell(percent / 100.0) : void();
  }
  return said;
}

// with all its threads behind the window, from its first moment on
class ProgramBehind : public QProcess
{
protected:
  void setupChildProcess() override // between fork and exec, where little may be called
  {
    constexpr int kNiceness = 10;
    setpriority(PRIO_PROCESS, 0, kNiceness);
  }
};

} // namespace

EndedProgram runProgram(const char* name, const QStringList& arguments)
{
  constexpr int kEvery = 50; // [ms]
  ProgramBehind palp;
  QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
  environment.insert("PALP_PROGRESS", "1");
  palp.setProcessEnvironment(environment);
  palp.setReadChannel(QProcess::StandardError);
  palp.start(QString::fromStdString((prefix() / "bin" / name).string()), arguments);
  palp.waitForStarted();
  QStringList lines;
  while (FollowedWork::ofThisThread()->isWanted() && !palp.waitForFinished(kEvery) &&
    palp.state() != QProcess::NotRunning)
  {
    lines << linesOf(palp);
  }
  if (palp.state() != QProcess::NotRunning)
  {
    palp.terminate();
    palp.waitForFinished();
  }
  const bool isWell =
    palp.error() != QProcess::FailedToStart && palp.exitStatus() == QProcess::NormalExit;
  lines << linesOf(palp);
  return { isWell ? palp.exitCode() : -1, lines.isEmpty() ? palp.errorString() : lines.last() };
}

void throwUnlessWell(const EndedProgram& ended)
{
  if (ended.code != 0)
  {
    throw Error(ErrorCode::BadFile, ended.said.toStdString());
  }
}

} // namespace palp
