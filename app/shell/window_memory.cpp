#include "app/shell/window_memory.h"

#include <QApplication>
#include <QFileInfo>
#include <QMainWindow>
#include <QScreen>
#include <QSettings>

namespace palp
{
namespace
{

constexpr int kLayout = 1; // counted up when panels change names or meaning
constexpr int kFrame = 16; // [pixels] that a window manager adds at both sides
constexpr int kTitle = 48; // above and below
constexpr const char* kRecent = "recentFiles";
constexpr const char* kTheme = "theme";
constexpr const char* kRealistic = "realistic";
constexpr const char* kGreeted = "greeted";

QSettings settings()
{
  return { QSettings::IniFormat, QSettings::UserScope, "palp", "window" };
}

} // namespace

void WindowMemory::save(const QMainWindow& window) const
{
  QSettings kept = settings();
  kept.setValue("geometry", window.saveGeometry());
  kept.setValue("layout", window.saveState(kLayout));
}

void WindowMemory::restore(QMainWindow& window) const
{
  const QSettings kept = settings();
  window.restoreGeometry(kept.value("geometry").toByteArray());
  const QScreen& screen = window.screen() != nullptr ? *window.screen() : *qApp->primaryScreen();
  const QRect room = screen.availableGeometry(); // which was another then, perhaps
  const QRect wanted = window.geometry();
  const QSize size = wanted.size().boundedTo(room.size() - QSize(kFrame, kTitle));
  if (size != wanted.size() && !window.isMaximized() && !window.isFullScreen())
  {
    window.setGeometry(QRect(room.topLeft() + QPoint(kFrame / 2, kTitle - kFrame / 2), size));
  }
  window.restoreState(kept.value("layout").toByteArray(), kLayout);
}

QStringList WindowMemory::recentFiles() const
{
  return settings().value(kRecent).toStringList();
}

void WindowMemory::addRecentFile(const QString& file) const
{
  constexpr int kMost = 10;
  const QString path = QFileInfo(file).absoluteFilePath();
  QStringList files = recentFiles();
  files.removeAll(path);
  files.prepend(path);
  settings().setValue(kRecent, QStringList(files.mid(0, kMost)));
}

void WindowMemory::forgetRecentFile(const QString& file) const
{
  QStringList files = recentFiles();
  files.removeAll(QFileInfo(file).absoluteFilePath());
  settings().setValue(kRecent, files);
}

bool WindowMemory::isFirstTime() const
{
  QSettings kept = settings();
  const bool isFirst = !kept.value(kGreeted).toBool();
  kept.setValue(kGreeted, true);
  return isFirst;
}

std::optional<bool> WindowMemory::isRealistic() const
{
  const QVariant kept = settings().value(kRealistic);
  return kept.isValid() ? std::optional(kept.toBool()) : std::nullopt;
}

void WindowMemory::setRealistic(bool realistic) const
{
  settings().setValue(kRealistic, realistic);
}

int WindowMemory::theme() const
{
  return settings().value(kTheme).toInt();
}

void WindowMemory::setTheme(int theme) const
{
  settings().setValue(kTheme, theme);
}

} // namespace palp
