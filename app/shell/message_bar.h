#pragma once

#include <QFrame>
#include <QString>

#include <functional>
#include <optional>
#include <vector>

class QHBoxLayout;
class QLabel;
class QProgressBar;
class QTimer;

namespace palp
{

/// What the window has to say, over the lower edge of another widget, whose size it leaves alone: a
/// press under the pointer stays where it is. All of the text is shown, in as many lines as it
/// takes, until it was read or is closed.
class MessageBar : public QFrame
{
  Q_OBJECT

public:
  /// @param over  where it stands; owns it
  explicit MessageBar(QWidget* over);

  /// What was done; goes away by itself. Here and below: an empty text shows nothing, and nothing
  /// takes a warning's place that nobody can have read: it stands below.
  void tell(const QString& text);

  /// Tells it behind what is shown, which stays as it is.
  void add(const QString& text);

  /// What went wrong, and what to do; stays until it is closed, or until there is something newer
  /// after the user did something.
  void warn(const QString& text);

  /// Takes a warning away, as that is mended; another stays.
  void withdraw(const QString& warning);

  /// What the user may choose.
  struct Choice
  {
    QString name;
    std::function<void()> act;
  };

  /// A question; stays until it is answered or closed, or until there is something newer.
  void ask(const QString& text, const std::vector<Choice>& choices);

  /// How far work is that goes on; stays until there is something newer. To be called again and
  /// again, with the same text.
  /// @param step     what of it is done just now; empty: not known
  /// @param percent  none: nobody knows
  void follow(const QString& text, const QString& step, std::optional<int> percent,
    const std::function<void()>& cancel);

  /// Ends that, unless there is something newer.
  void unfollow(const QString& text);

  /// What is shown, the newest of it; empty: nothing.
  [[nodiscard]] QString text() const;

  bool eventFilter(QObject* over, QEvent* event) override;

Q_SIGNALS:
  /// @param height  of the widget below that is its own, from below, once it is another: of a line
  ///                and its buttons at least, so that nothing there moves when they come and go
  void covers(int height);

protected:
  void hideEvent(QHideEvent* event) override;

private:
  void show(const QString& news);
  void write();
  [[nodiscard]] int wantedHeight() const;
  void place();

  QLabel* icon_;
  QLabel* text_;
  QHBoxLayout* choices_;
  QProgressBar* progress_;
  QString warning_;      // empty: there is none
  bool isRead_ = false;  // that, as the user did something since
  bool listens_ = false; // for that: not while what led to the warning is still being done
  QString news_;
  QString followed_; // empty: no work is
  int line_ = 0;     // height of one, with its buttons
  int covered_ = 0;
  QTimer* end_;
};

} // namespace palp
