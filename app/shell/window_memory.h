#pragma once

#include <QStringList>

#include <optional>

class QMainWindow;

namespace palp
{

/// What a window knows of the last time it was open, kept in the user's configuration folder.
///
/// All of it is a convenience: what cannot be read or written is as if it had never been.
class WindowMemory
{
public:
  /// Size, place, and which panels are open where.
  void save(const QMainWindow& window) const;
  void restore(QMainWindow& window) const;

  /// The newest first, ten at most, by absolute path; also those that are gone by now.
  [[nodiscard]] QStringList recentFiles() const;
  void addRecentFile(const QString& file) const;
  void forgetRecentFile(const QString& file) const;

  /// True once.
  [[nodiscard]] bool isFirstTime() const;

  /// Whether the live picture is realistic; none where the user never said so.
  [[nodiscard]] std::optional<bool> isRealistic() const;
  void setRealistic(bool realistic) const;

  /// The number of a Theme; 0 where none was ever set.
  [[nodiscard]] int theme() const;
  void setTheme(int theme) const;
};

} // namespace palp
