#pragma once

#include <QApplication>
#include <QDialog>
#include <QTimer>

#include <functional>
#include <utility>

namespace palp::test
{

/// Rejects each dialog that stands over the window while this lives, as a test that opens one waits
/// for its end.
class DialogCloser
{
public:
  /// @param look  before it is rejected; none: at nothing
  explicit DialogCloser(std::function<void(QDialog& dialog)> look = {})
    : look_(std::move(look))
  {
    constexpr int kOftenMs = 10;
    QObject::connect(&timer_, &QTimer::timeout,
      [this]
      {
        if (auto* dialog = qobject_cast<QDialog*>(QApplication::activeModalWidget()))
        {
          ++count_;
          look_ ? look_(*dialog) : void();
          dialog->reject();
        }
      });
    timer_.start(kOftenMs);
  }

  /// How many there were.
  [[nodiscard]] int count() const noexcept
  {
    return count_;
  }

private:
  std::function<void(QDialog& dialog)> look_;
  QTimer timer_;
  int count_ = 0;
};

} // namespace palp::test
