#pragma once

#include <QApplication>
#include <QSettings>
#include <QSurfaceFormat>
#include <QTemporaryDir>
#include <QVTKOpenGLNativeWidget.h>

namespace palp::test
{

/// One application for all tests of a program; a missing display is a failure, not a skip.
inline QApplication& application()
{
  static int count = 1;
  static char name[] = "test";
  static char* words[] = { name, nullptr };
  QSurfaceFormat format = QVTKOpenGLNativeWidget::defaultFormat();
  format.setSamples(0); // as the program has it
  QSurfaceFormat::setDefaultFormat(format);
  // what a user's windows remember is neither read nor changed
  static const QTemporaryDir settings;
  QSettings::setPath(QSettings::IniFormat, QSettings::UserScope, settings.path());
  static auto* instance =
    new QApplication(count, words); // stays, as it may not outlive Qt's statics
  return *instance;
}

} // namespace palp::test
