#pragma once

#include "haptics/devices/simulated/playhead.h"

#include <QToolBar>

class QComboBox;
class QLabel;
class QMenu;
class QSlider;

namespace palp
{

/// Plays, pauses, loops, slows and scrubs one thing at a time; hidden where there is nothing.
class PlayBar : public QToolBar
{
  Q_OBJECT

public:
  static constexpr double kStep = 0.010; ///< of a key [s]

  explicit PlayBar(QWidget* parent = nullptr);

  /// What the bar does, with its keys.
  void addTo(QMenu& menu);

  /// From now on plays something else.
  /// @param what        in a word or two
  /// @param length      [s]
  /// @param order       as it is played now; a speed that the bar has
  /// @param isRecorded  so that what is live can be gone back to, see left()
  void begin(const QString& what, double length, const PlayOrder& order, bool isRecorded);

  /// Nothing is there to play: it stays, and only says something.
  void rest(const QString& what);

  /// And goes away.
  void end();

  /// Where it is by now, from its beginning [s].
  void setTime(double time);

Q_SIGNALS:
  void ordered(const PlayOrder& order);
  void left(); ///< what is recorded

protected:
  bool eventFilter(QObject* window, QEvent* event) override;

private:
  [[nodiscard]] QAction* addKey(const QString& text, const QString& what, const QKeySequence& key);
  void makeSlider();
  void makeSpeed();
  void offer(bool something);
  [[nodiscard]] bool isPlaying() const;
  void togglePlaying();
  void seek(double time);
  void send();
  void refresh();
  void lookPlaying();

  PlayOrder order_; // what the user wants
  double length_ = 0.0;
  double time_ = 0.0;

  bool looksPlaying_ = false;

  QAction* back_;
  QAction* play_;
  QAction* forward_;
  QAction* loop_;
  QAction* leave_;
  QLabel* what_;
  QSlider* slider_;
  QLabel* shown_;
  QComboBox* speed_;
};

} // namespace palp
