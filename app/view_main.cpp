// palp-view: palp with its window.

#include "app/commands/program.h"
#include "app/folder/autosave.h"
#include "app/folder/export_folder.h"
#include "app/program/build_trace.h"
#include "app/program/machine.h"
#include "app/session/session.h"
#include "app/shell/message_bar.h"
#include "app/shell/theme.h"
#include "app/window/window.h"

#include "haptics/error.h"

#include <QApplication>
#include <QSurfaceFormat>
#include <QVTKOpenGLNativeWidget.h>

#include <QTimer>

#include <atomic>
#include <clocale>
#include <csignal>
#include <cstdlib>
#include <iostream>

namespace
{

// stops the force in the next tick of the servo, though the window may hang
std::atomic<bool> gEnded = false;
std::atomic<int> gSignal = 0; // that asked for it
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free);

// then ends the program in order, so that the last force sent is zero
void endOnSignals(QApplication& application)
{
  constexpr int kCheckEvery = 20; // [ms]
  for (const int number : { SIGTERM, SIGINT, SIGHUP })
  {
    std::signal(number,
      [](int signal)
      {
        gSignal = signal;
        gEnded = true;
      });
  }
  auto* timer = new QTimer(&application);
  QObject::connect(timer, &QTimer::timeout, &application,
    [&application]
    {
      if (gEnded)
      {
        application.quit();
      }
    });
  timer->start(kCheckEvery);
}

void explainOmissions(const palp::ScenePlan& plan, palp::BuildTrace& trace)
{
  trace.skip("USB libraries", "come when a device there is looked for",
    plan.device.kind != palp::DeviceChoice::Kind::Driver);
  trace.skip("plots, sample ring", "no plot is named", !plan.records());
  trace.skip("validity panel", "\"validity\" is false", !plan.validity);
  trace.skip("other overlays", "computed when the View menu shows them", plan.overlays.has_value());
  trace.skip("fitted surfaces", "\"dent\" is the paper's",
    plan.press.dent.surface != palp::DentSurface::Fitted);
}

// Qt aborts where it finds no display
void refuseToAbort(QtMsgType type, const QMessageLogContext&, const QString& text)
{
  std::cerr << (type == QtFatalMsg ? "palp: window: the display cannot be used; check DISPLAY, or "
                                     "use palp run, which needs none\n"
                                   : text.toStdString() + '\n');
  if (type == QtFatalMsg)
  {
    std::_Exit(palp::exitCode(palp::ErrorCode::NoPicture));
  }
}

// What nobody caught is told in the window, and the presses in it stay: Qt would end the program.
class Application : public QApplication
{
public:
  using QApplication::QApplication;

  bool notify(QObject* receiver, QEvent* event) override
  {
    try
    {
      return QApplication::notify(receiver, event);
    }
    catch (const std::exception& error)
    {
      for (const QWidget* window : topLevelWidgets())
      {
        auto* bar = window->findChild<palp::MessageBar*>();
        bar != nullptr ? bar->warn(error.what()) : void();
      }
      return true;
    }
  }
};

int view(const palp::ViewOptions& options)
{
  if (!qEnvironmentVariableIsSet("DISPLAY") && !qEnvironmentVariableIsSet("WAYLAND_DISPLAY"))
  {
    throw palp::Error(palp::ErrorCode::NoPicture,
      "window: there is no display here; use palp run, which needs none, or a scene with a path as "
      "device and with exports");
  }
  palp::giveBackLargeBlocks();
  palp::BuildTrace trace(options.explain);
  QSurfaceFormat format = QVTKOpenGLNativeWidget::defaultFormat();
  format.setSamples(0); // several times slower without a graphics card
  QSurfaceFormat::setDefaultFormat(format);

  int count = 1;
  char name[] = "palp";
  char* words[] = { name, nullptr };
  const QtMessageHandler before = qInstallMessageHandler(refuseToAbort);
  Application application(count, words);
  qInstallMessageHandler(before);
  if (const palp::Theme theme = palp::rememberedTheme(); theme != palp::Theme::System)
  {
    palp::setTheme(theme);
  }
  // Qt takes the user's; files and VTK want a decimal point
  std::setlocale(LC_NUMERIC, "C"); // NOLINT(concurrency-mt-unsafe): no other thread yet

  palp::Autosave autosave(palp::Autosave::usualRoot());
  palp::Session session(options.plan, trace, &gEnded);
  for (const std::string& note : session.body().notes)
  {
    std::cerr << "palp: " << note << '\n';
  }
  if (options.made)
  {
    for (const std::filesystem::path& take : palp::takesIn(options.made->folder))
    {
      session.add(session.takeOf(palp::readExport(take))());
    }
  }
  std::cerr << "palp: servo thread: " << session.schedule() << '\n';
  palp::Window window(session, trace);
  window.greet();
  window.saveTo(autosave);
  trace.build("first picture", "drawn on the display",
    [&]
    {
      window.show();
      QApplication::processEvents();
    });
  if (options.explain)
  {
    explainOmissions(options.plan, trace);
    trace.write(std::cout);
    return 0;
  }
  endOnSignals(application);
  const int code = QApplication::exec();
  constexpr int kSignaled = 128; // as a shell tells of a program that a signal ended
  return gEnded ? kSignaled + gSignal : code;
}

} // namespace

int main(int argc, char** argv)
{
  return palp::runProgram(argc, argv, { .view = view });
}
