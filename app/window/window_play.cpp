// What the window plays: the path of a device, or what was recorded.

#include "app/input/tip_text.h"
#include "app/shell/play_bar.h"
#include "app/window/window.h"
#include "haptics/devices/simulated/scripted_device.h"

#include <QLabel>
#include <QMenuBar>

#include <utility>

namespace palp
{
namespace
{

QString titleOf(const Recording& recording)
{
  return QObject::tr("%1, %2, %3")
    .arg(QString::fromStdString(recording.mesh),
      QString::fromStdString(describeTip(recording.scene.law.tip())),
      QString::fromStdString(recording.device));
}

} // namespace

void Window::makePlaying()
{
  sincePicture_.start();
  playBar_ = new PlayBar(this);
  addToolBar(Qt::BottomToolBarArea, playBar_);
  connect(playBar_, &PlayBar::ordered, this, &Window::play);
  connect(playBar_, &PlayBar::left, this, &Window::endReview);

  QMenu* menu = menuBar()->addMenu(tr("&Play"));
  QAction* latest =
    menu->addAction(tr("&Review the recording"), this, &Window::reviewLatest, Qt::Key_R);
  latest->setObjectName("reviewAction");
  latest->setEnabled(session_.plan().records());
  addEarlierTakes(*menu);
  menu->addSeparator();
  playBar_->addTo(*menu);
}

// listed when they are looked at, the newest first
void Window::addEarlierTakes(QMenu& menu)
{
  QMenu* earlier = menu.addMenu(tr("Review an &earlier one"));
  earlier->setObjectName("earlierTakes");
  connect(earlier, &QMenu::aboutToShow, this,
    [this, earlier]
    {
      earlier->clear();
      const std::size_t count = session_.earlier().size();
      for (std::size_t ago = 1; ago <= count; ++ago)
      {
        const Recording& recording = session_.earlier()[count - ago].recording;
        const QString what = titleOf(recording).replace('&', "&&");
        earlier->addAction(
          tr("%1: %2").arg(count - ago + 1).arg(what), this, [this, ago] { review(ago); });
      }
      if (count == 0)
      {
        earlier->addAction(tr("none so far"))->setEnabled(false);
      }
    });
}

// with all that a recording was made on
Pictured Window::recorded(std::size_t ago) const
{
  const std::vector<Session::Take>& earlier = session_.earlier();
  if (ago == 0 || ago > earlier.size())
  {
    return { session_.body(), session_.recording(), session_.calibration() };
  }
  const Session::Take& take = earlier[earlier.size() - ago];
  return { take.body, take.recording, take.calibration, take.seenFrom };
}

Pictured Window::pictured() const
{
  return recorded(review_ ? reviewed_ : 0);
}

const Sample& Window::sampleToShow()
{
  const Sample& live = session_.newest();
  const bool touched = std::exchange(touched_, live.contact.touching());
  const double elapsed = 1e-9 * static_cast<double>(sincePicture_.nsecsElapsed());
  sincePicture_.start();
  if (review_)
  {
    review_->head().advance(elapsed);
    const bool isPressed = isPressing() || (touched_ && !touched);
    const Sample* sample = isPressed ? nullptr : review_->at(pictured().recording);
    if (sample)
    {
      playBar_->setTime(review_->head().time());
      return *sample;
    }
    endReview();
  }
  followDevice();
  return live;
}

bool Window::isPressing() const
{
  const auto target = pointer_.target();
  return target && target->depth > 0.0;
}

// A bar that goes takes the surface from under the pointer: not while it presses.
void Window::followDevice()
{
  const ScriptedDevice* scripted = session_.scripted();
  if (scripted != scripted_)
  {
    scripted_ = scripted;
    order_ = {};
    barIsStale_ = true;
  }
  if (barIsStale_ && !isPressing())
  {
    handPlayBar();
  }
  if (scripted && !barIsStale_)
  {
    playBar_->setTime(scripted->reached());
  }
}

// to what it plays now
void Window::handPlayBar()
{
  barIsStale_ = false;
  if (review_)
  {
    playBar_->begin(tr("Recorded, not live"), review_->head().length(), {}, true);
  }
  else if (session_.scripted())
  {
    playBar_->begin(tr("Path"), session_.scripted()->duration(), order_, false);
  }
  else
  {
    playBar_->end();
  }
}

void Window::play(const PlayOrder& order)
{
  if (review_)
  {
    review_->head().obey(order);
  }
  else if (ScriptedDevice* scripted = session_.scripted())
  {
    order_ = order;
    scripted->play(order);
  }
}

void Window::reviewLatest()
{
  takeSamples();
  review(session_.recording().isTouched() ? 0 : 1);
}

// while the tool rests
void Window::review(std::size_t ago)
{
  const Recording& recording = recorded(ago).recording;
  if (!recording.isTouched())
  {
    say(tr("Nothing is recorded yet: press first"));
    return;
  }
  letGo();
  if (!review_)
  {
    PlayOrder order = order_;
    order.plays = false;
    play(order);
  }
  review_.emplace(recording);
  reviewed_ = ago;
  handPlayBar();
  showPictured();
}

void Window::endReview()
{
  if (review_)
  {
    review_.reset();
    barIsStale_ = true;
    playBar_->rest(tr("Live"));
    showPictured();
  }
}

// the surface, the tool and the law of what is seen; of several organs, of that last touched
void Window::showPictured()
{
  const Pictured seen = pictured();
  if (shown_.organ >= organCount(seen.recording.scene))
  {
    shown_ = {}; // of organs that are no longer felt
  }
  const bool isQuick = hasCard_ != true; // also in the first picture, which tells what draws
  const PressMoment moment =
    momentOf(seen.body, seen.recording, seen.calibration, shown_, shownMap(), isQuick);
  vtkPolyData* coarse = moment.body.coarse;
  const bool isOther =
    !view_.shows(*moment.body.display) && (coarse == nullptr || !view_.shows(*coarse));
  if (isOther && seen.recording.organs.empty())
  {
    fittedTo_ = std::pair(0, 0);
  }
  isOther ? scaleBar_.setPlace(std::nullopt) : void();
  prepareView(view_, around_, moment);
  validity_ = Validity(moment.law, { .stableStiffness = session_.stableStiffness() });
  showModel();
  isStale_ = true;
  forceLabel_->setToolTip(QString::fromStdString(moment.calibration.note));
}

} // namespace palp
