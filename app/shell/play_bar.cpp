#include "app/shell/play_bar.h"

#include <QAbstractButton>
#include <QAbstractItemView>
#include <QApplication>
#include <QComboBox>
#include <QKeyEvent>
#include <QLabel>
#include <QMenu>
#include <QProxyStyle>
#include <QSignalBlocker>
#include <QSlider>

#include <algorithm>
#include <cmath>
#include <limits>

namespace palp
{
namespace
{

constexpr double kTick = 1e-3; // of the slider [s]

// a click takes a slider there, as in every player
class GoesThere : public QProxyStyle
{
public:
  using QProxyStyle::QProxyStyle;
  int styleHint(StyleHint hint, const QStyleOption* option, const QWidget* widget,
    QStyleHintReturn* data) const override
  {
    return hint == SH_Slider_AbsoluteSetButtons
      ? static_cast<int>(Qt::LeftButton)
      : QProxyStyle::styleHint(hint, option, widget, data);
  }
};

int ticksOf(double time)
{
  constexpr double kMost = std::numeric_limits<int>::max();
  return static_cast<int>(std::min(std::round(time / kTick), kMost));
}

// that Space works on by itself
bool takesSpace(const QWidget* control)
{
  return qobject_cast<const QAbstractButton*>(control) != nullptr ||
    qobject_cast<const QComboBox*>(control) != nullptr ||
    qobject_cast<const QAbstractItemView*>(control) != nullptr;
}

} // namespace

PlayBar::PlayBar(QWidget* parent)
  : QToolBar(tr("Play"), parent)
  , back_(addKey(tr("Step &back 10 ms"), tr("10 ms back"), Qt::Key_Comma))
  , play_(addKey(tr("&Play or pause"), tr("Plays, or pauses"), Qt::Key_Space))
  , forward_(addKey(tr("Step &forward 10 ms"), tr("10 ms forward"), Qt::Key_Period))
  , loop_(addKey(tr("&Loop"), tr("Begins anew at the end"), Qt::Key_L))
  , leave_(new QAction(tr("Back to live (Esc)"), this))
  , what_(new QLabel)
  , slider_(new QSlider(Qt::Horizontal))
  , shown_(new QLabel)
  , speed_(new QComboBox)
{
  setObjectName("playBar");
  setMovable(false);
  toggleViewAction()->setVisible(false); // as there is nothing to play, or it is shown
  setIconSize(QSize(16, 16));
  play_->setObjectName("playAction");
  loop_->setObjectName("loopAction");
  leave_->setObjectName("liveAction");
  what_->setObjectName("playedWhat");
  shown_->setObjectName("playedTime");
  back_->setIcon(style()->standardIcon(QStyle::SP_MediaSeekBackward));
  forward_->setIcon(style()->standardIcon(QStyle::SP_MediaSeekForward));
  loop_->setCheckable(true);
  leave_->setToolTip(tr("Shows what the tool does now; so does a press on the surface"));
  makeSlider();
  makeSpeed();
  lookPlaying();

  addWidget(what_);
  addActions({ back_, play_, forward_ });
  addWidget(slider_);
  addWidget(shown_);
  addWidget(speed_);
  addActions({ loop_, leave_ });
  connect(back_, &QAction::triggered, this, [this] { seek(time_ - kStep); });
  connect(forward_, &QAction::triggered, this, [this] { seek(time_ + kStep); });
  connect(play_, &QAction::triggered, this, &PlayBar::togglePlaying);
  connect(loop_, &QAction::toggled, this,
    [this](bool on)
    {
      order_.loops = on;
      send();
    });
  connect(leave_, &QAction::triggered, this, &PlayBar::left);
  if (parent != nullptr)
  {
    parent->installEventFilter(this);
  }
  end();
}

QAction* PlayBar::addKey(const QString& text, const QString& what, const QKeySequence& key)
{
  auto* action = new QAction(text, this);
  action->setShortcut(key);
  action->setToolTip(tr("%1 (%2)").arg(what, key.toString(QKeySequence::NativeText)));
  action->setIconVisibleInMenu(false);
  return action;
}

void PlayBar::makeSlider()
{
  slider_->setObjectName("playSlider");
  slider_->setAccessibleName(tr("Time played"));
  slider_->setToolTip(tr("Drag to look at another time; the arrow keys step by 10 ms"));
  slider_->setMinimumWidth(120);
  auto* goesThere = new GoesThere;
  goesThere->setParent(slider_);
  slider_->setStyle(goesThere);
  slider_->setSingleStep(ticksOf(kStep));
  connect(slider_, &QSlider::valueChanged, this, [this](int ticks) { seek(kTick * ticks); });
  connect(slider_, &QSlider::sliderPressed, this, &PlayBar::send);
  connect(slider_, &QSlider::sliderReleased, this, &PlayBar::send);
}

void PlayBar::makeSpeed()
{
  speed_->setObjectName("playSpeed");
  speed_->setAccessibleName(tr("Speed"));
  speed_->setToolTip(tr("How fast it is played"));
  for (const double speed : { Playhead::kSlowest, 0.25, 0.5, 1.0, 2.0, Playhead::kFastest })
  {
    speed_->addItem(tr("%1×").arg(speed), speed);
  }
  connect(speed_, qOverload<int>(&QComboBox::currentIndexChanged), this,
    [this]
    {
      order_.speed = speed_->currentData().toDouble();
      send();
    });
}

void PlayBar::addTo(QMenu& menu)
{
  menu.addActions({ play_, loop_, back_, forward_, leave_ });
}

void PlayBar::begin(const QString& what, double length, const PlayOrder& order, bool isRecorded)
{
  const QSignalBlocker quietLoop(loop_);
  const QSignalBlocker quietSpeed(speed_);
  const QSignalBlocker quietSlider(slider_);
  order_ = order;
  length_ = length;
  loop_->setChecked(order.loops);
  speed_->setCurrentIndex(speed_->findData(order.speed));
  what_->setText(QString(isRecorded ? " <b>%1</b> " : " %1 ").arg(what.toHtmlEscaped()));
  slider_->setRange(0, ticksOf(length));
  slider_->setPageStep(std::max(ticksOf(kStep), ticksOf(length / 10.0)));
  const QString widest = QString(" %1 / %1 s ").arg(length, 0, 'f', 2);
  // as a label that may change its size lays the whole window out whenever its text changes
  shown_->setFixedSize(
    shown_->fontMetrics().horizontalAdvance(widest), slider_->sizeHint().height());
  offer(true);
  show();
  leave_->setVisible(isRecorded);
  setTime(0.0);
}

void PlayBar::rest(const QString& what)
{
  what_->setText(QString(" %1 ").arg(what));
  offer(false);
}

void PlayBar::end()
{
  offer(false);
  hide();
}

void PlayBar::offer(bool something)
{
  for (QAction* action : { back_, play_, forward_, loop_, leave_ })
  {
    action->setEnabled(something);
  }
  slider_->setEnabled(something);
  speed_->setEnabled(something);
}

bool PlayBar::isPlaying() const
{
  return order_.plays && (order_.loops || time_ < length_);
}

void PlayBar::togglePlaying()
{
  order_.plays = !isPlaying();
  if (order_.plays && time_ >= length_)
  {
    seek(0.0);
    return;
  }
  send();
  refresh();
}

void PlayBar::seek(double time)
{
  time_ = std::clamp(time, 0.0, length_);
  order_.place = time_;
  ++order_.seeks;
  send();
  refresh();
}

// while the user holds the slider nothing pulls it away
void PlayBar::send()
{
  PlayOrder order = order_;
  order.plays = order.plays && !slider_->isSliderDown();
  Q_EMIT ordered(order);
}

void PlayBar::setTime(double time)
{
  if (!slider_->isSliderDown())
  {
    time_ = time;
    refresh();
  }
}

void PlayBar::refresh()
{
  const QSignalBlocker quiet(slider_);
  slider_->setValue(ticksOf(time_));
  shown_->setText(tr(" %1 / %2 s ").arg(time_, 0, 'f', 2).arg(length_, 0, 'f', 2));
  if (looksPlaying_ != isPlaying())
  {
    looksPlaying_ = !looksPlaying_;
    lookPlaying();
  }
}

void PlayBar::lookPlaying()
{
  play_->setIcon(
    style()->standardIcon(looksPlaying_ ? QStyle::SP_MediaPause : QStyle::SP_MediaPlay));
  play_->setIconText(looksPlaying_ ? tr("Pause") : tr("Play"));
}

// a control that has the focus has its key
bool PlayBar::eventFilter(QObject* window, QEvent* event)
{
  if (event->type() == QEvent::ShortcutOverride && takesSpace(QApplication::focusWidget()) &&
    static_cast<QKeyEvent*>(event)->key() == Qt::Key_Space)
  {
    event->accept();
    return true;
  }
  return QToolBar::eventFilter(window, event);
}

} // namespace palp
