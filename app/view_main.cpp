// palp-view: palp with its window.

#include "app/program.h"
#include "app/session.h"
#include "app/window.h"

#include "haptics/error.h"

#include <QApplication>
#include <QSurfaceFormat>
#include <QVTKOpenGLNativeWidget.h>

#include <clocale>
#include <cstdlib>
#include <iostream>

namespace
{

int view(const palp::ViewOptions& options)
{
  if (!std::getenv("DISPLAY") && !std::getenv("WAYLAND_DISPLAY"))
  {
    throw palp::Error(palp::ErrorCode::NoPicture,
      "window: there is no display here; use palp run, which needs none");
  }
  QSurfaceFormat format = QVTKOpenGLNativeWidget::defaultFormat();
  format.setSamples(0); // several times slower without a graphics card
  QSurfaceFormat::setDefaultFormat(format);

  int count = 1;
  char name[] = "palp";
  char* words[] = { name, nullptr };
  QApplication application(count, words);
  std::setlocale(LC_NUMERIC, "C"); // Qt takes the user's; files and VTK want a decimal point

  palp::Session session(options);
  for (const std::string& note : session.body().notes)
  {
    std::cerr << "palp: " << note << '\n';
  }
  std::cerr << "palp: servo thread: " << session.schedule() << '\n';
  palp::Window window(session);
  window.show();
  return QApplication::exec();
}

} // namespace

int main(int argc, char** argv)
{
  return palp::runProgram(argc, argv, { .view = view });
}
