#include "app/train/panel/training_panel.h"

#include "app/train/training_text.h"
#include "haptics/error.h"

#include <QComboBox>
#include <QFormLayout>
#include <QGridLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QRandomGenerator>
#include <QVBoxLayout>

namespace palp
{
namespace
{

constexpr int kSecondsPerMinute = 60;

QPushButton* button(const QString& text, const char* name, const QString& what)
{
  auto* button = new QPushButton(text);
  button->setObjectName(name);
  button->setToolTip(what);
  button->setFocusPolicy(Qt::TabFocus); // the keys of the picture stay with it
  return button;
}

QString tableOf(const ScoreSheet& sheet)
{
  QString rows;
  for (const Measure& one : measuresOf(sheet))
  {
    const QString value = one.value.empty() ? "-" : QString::fromStdString(one.value);
    rows += QStringLiteral("<tr><td>%1&nbsp;</td><td align=right>%2</td><td>&nbsp;%3</td></tr>")
              .arg(QString::fromStdString(one.title), value, QString::fromStdString(one.unit));
  }
  return "<table>" + rows + "</table>";
}

QString verdictOf(const ScoreSheet& sheet)
{
  if (!sheet.grade.isPassed)
  {
    return QObject::tr("Not passed: search again with another seed");
  }
  return sheet.next.empty()
    ? QObject::tr("Passed")
    : QObject::tr("Passed; next: %1").arg(QString::fromStdString(sheet.next));
}

} // namespace

TrainingPanel::TrainingPanel(const Curriculum& curriculum, QWidget* parent)
  : QWidget(parent)
  , level_(new QComboBox)
  , seed_(new QLineEdit)
  , start_(button(tr("Start"), "trainingStart", tr("Hide nodules and begin to search")))
  , mark_(button(tr("Mark (M)"), "trainingMark",
      tr("A nodule is where the tool touched last; Ctrl+Z takes the last mark back")))
  , finish_(button(tr("Finish"), "trainingFinish", tr("Grade the search and show the nodules")))
  , save_(button(tr("Save sheet…"), "trainingSave",
      tr("Score sheet as JSON, CSV and page, and all that repeats the search")))
  , told_(new QLabel(tr("Nodules hidden at random are found by their resistance alone")))
{
  for (const TrainingLevel& level : curriculum.levels)
  {
    level_->addItem(
      QString::fromStdString(level.name + ": " + level.title), QString::fromStdString(level.name));
  }
  level_->setObjectName("trainingLevel");
  level_->setToolTip(tr("How many nodules are hidden, how large, how deep and how stiff"));
  seed_->setObjectName("trainingSeed");
  seed_->setPlaceholderText(tr("random"));
  seed_->setToolTip(tr("From which the places follow, 0 to 4294967295; empty: any"));
  told_->setObjectName("trainingTold");
  told_->setWordWrap(true);
  told_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  auto* form = new QFormLayout;
  form->addRow(tr("Level"), level_);
  form->addRow(tr("Seed"), seed_);
  auto* buttons = new QGridLayout; // four beside each other would leave the picture no room
  for (int i = 0; QPushButton * each : { start_, mark_, finish_, save_ })
  {
    buttons->addWidget(each, i / 2, i % 2);
    ++i;
  }
  auto* layout = new QVBoxLayout(this);
  layout->addLayout(form);
  layout->addLayout(buttons);
  layout->addWidget(told_);
  layout->addStretch();
  connect(start_, &QPushButton::clicked, this, &TrainingPanel::start);
  connect(mark_, &QPushButton::clicked, this, &TrainingPanel::markAsked);
  connect(finish_, &QPushButton::clicked, this, &TrainingPanel::finishAsked);
  connect(save_, &QPushButton::clicked, this, &TrainingPanel::saveAsked);
  setSearching(false);
  save_->setEnabled(false);
}

void TrainingPanel::start()
{
  try
  {
    const QString seed = seed_->text().trimmed();
    const std::uint32_t number = seed.isEmpty() ? QRandomGenerator::global()->generate()
                                                : parseSeed(seed.toStdString(), "Seed");
    Q_EMIT startAsked({ .level = level_->currentData().toString().toStdString(), .seed = number });
  }
  catch (const Error& error)
  {
    Q_EMIT refused(QString::fromStdString(error.what()));
  }
}

void TrainingPanel::setSearching(bool searches)
{
  for (QWidget* each : std::initializer_list<QWidget*>{ level_, seed_, start_ })
  {
    each->setEnabled(!searches);
  }
  mark_->setEnabled(searches);
  finish_->setEnabled(searches);
}

void TrainingPanel::showSearch(const TrainingPlan& plan)
{
  level_->setCurrentIndex(level_->findData(QString::fromStdString(plan.level)));
  seed_->setText(QString::number(plan.seed));
  setSearching(true);
  save_->setEnabled(false);
}

void TrainingPanel::showProgress(double time, std::size_t marks)
{
  const int seconds = static_cast<int>(time);
  told_->setText(tr("Searching for %1:%2, %3 marked")
                   .arg(seconds / kSecondsPerMinute)
                   .arg(seconds % kSecondsPerMinute, 2, 10, QChar('0'))
                   .arg(marks));
}

void TrainingPanel::showResult(const ScoreSheet* sheet)
{
  setSearching(false);
  seed_->clear(); // the next one is another
  save_->setEnabled(sheet != nullptr);
  told_->setText(sheet == nullptr ? tr("Nothing was touched: nothing is graded")
                                  : "<b>" + QString::fromStdString(summaryOf(sheet->grade)) +
        "</b><br>" + verdictOf(*sheet) + tableOf(*sheet));
}

} // namespace palp
