#pragma once

#include <QPointer>

#include <functional>

class QMessageBox;
class QWidget;

namespace palp
{

class Background;

/// Files that the user asked for, while they are written behind a window: one that is closed
/// meanwhile asks whether to wait for them.
class Saves
{
public:
  /// @param window, background  outlive it
  Saves(QWidget& window, Background& background)
    : window_(window)
    , background_(background)
  {
  }

  /// Does work that writes such a file; passes on what it throws.
  void write(const std::function<void()>& work);

  /// Whether the window may close at once. If not, asks; it is closed once all is written, or given
  /// up where that is the answer.
  [[nodiscard]] bool mayClose();

  /// The window stays, whatever was answered.
  void keepOpen() noexcept
  {
    quits_ = false;
  }

private:
  [[nodiscard]] bool isWriting() const;
  void ask();
  void quitOnceWritten();

  QWidget& window_;
  Background& background_;
  QPointer<QMessageBox> question_;
  int going_ = 0;      // works
  bool quits_ = false; // once they have ended
};

} // namespace palp
