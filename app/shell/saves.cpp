#include "app/shell/saves.h"

#include "app/shell/background.h"

#include <QMessageBox>
#include <QPushButton>
#include <QTimer>
#include <QWidget>

#include <memory>

namespace palp
{

void Saves::write(const std::function<void()>& work)
{
  const auto end = [this](int* going)
  {
    --*going;
    quitOnceWritten();
  };
  const std::unique_ptr<int, decltype(end)> counted(&++going_, end); // where it fails, too
  work();
}

bool Saves::isWriting() const
{
  return going_ > 0 || background_.waiting() > 0;
}

bool Saves::mayClose()
{
  if (!isWriting())
  {
    return true;
  }
  ask();
  return false;
}

// beside the bar of messages, which shows the progress meanwhile
void Saves::ask()
{
  auto* box = new QMessageBox(QMessageBox::Question, QMessageBox::tr("Quit"),
    QMessageBox::tr("A file is still being written: wait for it, or quit without it?"),
    QMessageBox::Cancel, &window_);
  box->setObjectName("quitQuestion");
  box->setAttribute(Qt::WA_DeleteOnClose);
  auto* wait = box->addButton(QMessageBox::tr("&Wait, then quit"), QMessageBox::AcceptRole);
  const auto* quit =
    box->addButton(QMessageBox::tr("&Quit without it"), QMessageBox::DestructiveRole);
  QObject::connect(box, &QMessageBox::buttonClicked, box,
    [this, wait, quit](const QAbstractButton* answer)
    {
      quits_ = answer == wait || answer == quit;
      answer == quit ? background_.giveUpAll() : void();
      quitOnceWritten();
    });
  box->open();
  box->setDefaultButton(wait);
  question_ = box;
}

// from the event loop, as what has ended is still to be told of
void Saves::quitOnceWritten()
{
  QTimer::singleShot(0, &window_,
    [this]
    {
      if (isWriting())
      {
        return;
      }
      question_ ? question_->reject() : void(); // of what has ended
      quits_ ? void(window_.close()) : void();
    });
}

} // namespace palp
