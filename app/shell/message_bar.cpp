#include "app/shell/message_bar.h"

#include <QApplication>
#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QStyle>
#include <QTimer>
#include <QToolButton>

#include <algorithm>
#include <utility>

namespace palp
{
namespace
{

constexpr int kLong = 15'000; // [ms], to be read

} // namespace

MessageBar::MessageBar(QWidget* over)
  : QFrame(over)
  , icon_(new QLabel)
  , text_(new QLabel)
  , choices_(new QHBoxLayout)
  , progress_(new QProgressBar)
  , end_(new QTimer(this))
{
  setObjectName("messageBar");
  setAccessibleName(tr("Message"));
  setAutoFillBackground(true);
  setFrameShape(QFrame::StyledPanel);
  text_->setObjectName("message");
  text_->setTextFormat(Qt::PlainText);
  text_->setWordWrap(true);
  text_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  auto* close = new QToolButton;
  close->setObjectName("closeMessage");
  close->setIcon(style()->standardIcon(QStyle::SP_TitleBarCloseButton));
  close->setToolTip(tr("Close this message"));
  close->setAccessibleName(close->toolTip());
  close->setAutoRaise(true);
  progress_->setObjectName("progress");
  progress_->setAccessibleName(tr("Progress"));
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(6, 3, 6, 3);
  row->addWidget(icon_, 0, Qt::AlignTop);
  row->addWidget(text_, 1);
  row->addWidget(progress_);
  row->addLayout(choices_);
  row->addWidget(close, 0, Qt::AlignTop);
  end_->setSingleShot(true);
  connect(end_, &QTimer::timeout, this, [this] { show({}); });
  connect(close, &QToolButton::clicked, this, &QWidget::hide);
  qApp->installEventFilter(this);
  const QMargins margins = row->contentsMargins();
  line_ = QPushButton(tr("Cancel")).sizeHint().height() + margins.top() + margins.bottom() +
    2 * frameWidth();
  hide();
}

void MessageBar::tell(const QString& text)
{
  text.isEmpty() ? warning_.clear() : void();
  show(text);
  end_->start(kLong);
}

void MessageBar::add(const QString& text)
{
  if (isHidden() || !followed_.isEmpty()) // work tells itself again and again
  {
    tell(text);
    return;
  }
  news_ = news_.isEmpty() ? text : tr("%1. %2").arg(news_, text);
  write();
}

void MessageBar::warn(const QString& text)
{
  warning_ = text;
  isRead_ = listens_ = false;
  show({});
  end_->stop();
  QTimer::singleShot(0, this, [this] { listens_ = true; });
}

void MessageBar::withdraw(const QString& warning)
{
  if (warning_ == warning)
  {
    warning_.clear();
    write();
  }
}

void MessageBar::ask(const QString& text, const std::vector<Choice>& choices)
{
  show(text);
  end_->stop();
  for (const Choice& choice : choices)
  {
    auto* button = new QPushButton(choice.name);
    choices_->addWidget(button);
    button->show(); // takes its room at once, of which the text's height depends
    connect(button, &QPushButton::clicked, this,
      [this, act = choice.act]
      {
        hide();
        act();
      });
  }
  place();
}

void MessageBar::follow(const QString& text, const QString& step, std::optional<int> percent,
  const std::function<void()>& cancel)
{
  if (followed_ != text || isHidden())
  {
    ask(text, { { tr("Cancel"), cancel } });
    followed_ = text;
    progress_->show();
  }
  const bool saysMore = !step.isEmpty() && step.compare(text, Qt::CaseInsensitive) != 0;
  const QString whole = saysMore ? text + ": " + step : text;
  progress_->setRange(0, percent ? 100 : 0);
  progress_->setValue(percent.value_or(0));
  if (news_ != whole || height() != wantedHeight())
  {
    news_ = whole;
    write();
  }
}

void MessageBar::unfollow(const QString& text)
{
  followed_ == text ? show({}) : void();
}

QString MessageBar::text() const
{
  return isHidden() ? QString() : news_.isEmpty() ? warning_ : news_;
}

void MessageBar::show(const QString& news)
{
  isRead_ && !news.isEmpty() ? warning_.clear() : void();
  news_ = news;
  progress_->hide();
  followed_.clear();
  while (QLayoutItem* item = choices_->takeAt(0))
  {
    item->widget()->deleteLater(); // may be the one that was pressed
    delete item;
  }
  write();
}

void MessageBar::write()
{
  const bool warns = !warning_.isEmpty();
  const auto icon = warns ? QStyle::SP_MessageBoxWarning : QStyle::SP_MessageBoxInformation;
  icon_->setPixmap(style()->standardIcon(icon).pixmap(fontMetrics().height()));
  text_->setText(warns && !news_.isEmpty() ? warning_ + '\n' + news_ : warning_ + news_);
  setVisible(!text_->text().isEmpty());
  place();
}

// a key or a button of the mouse is something that the user does, but for one in the bar itself
bool MessageBar::eventFilter(QObject* watched, QEvent* event)
{
  const bool isOther = (event->type() == QEvent::Resize && watched == parentWidget()) ||
    (event->type() == QEvent::LayoutRequest && watched == this); // a style gives other sizes
  isOther ? place() : void();
  const bool isDone =
    event->type() == QEvent::MouseButtonPress || event->type() == QEvent::KeyPress;
  if (isDone && listens_ && watched->isWidgetType())
  {
    isRead_ = isRead_ || !isAncestorOf(static_cast<QWidget*>(watched));
  }
  return QFrame::eventFilter(watched, event);
}

void MessageBar::hideEvent(QHideEvent* event)
{
  QFrame::hideEvent(event);
  isHidden() ? warning_.clear() : void(); // closed
  place();
}

int MessageBar::wantedHeight() const
{
  return isHidden() ? line_ : std::max(line_, heightForWidth(parentWidget()->width()));
}

void MessageBar::place()
{
  const QWidget* over = parentWidget();
  const int height = wantedHeight();
  setGeometry(0, over->height() - height, over->width(), height);
  raise();
  if (std::exchange(covered_, height) != height)
  {
    Q_EMIT covers(height);
  }
}

} // namespace palp
