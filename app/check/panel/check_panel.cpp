#include "app/check/panel/check_panel.h"

#include "app/check/check_text.h"
#include "app/check/panel/fault_marks.h"
#include "app/panels/panel_area.h"

#include <QColor>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QKeyEvent>
#include <QLabel>
#include <QPushButton>
#include <QScrollArea>
#include <QScrollBar>
#include <QStyle>
#include <QTableWidget>
#include <QVBoxLayout>

#include <algorithm>

namespace palp
{
namespace
{

constexpr int kColumns = 6;
constexpr int kTexts = 4; // the first of those that have lines of text

QLabel* makeText(const char* name)
{
  auto* text = new QLabel;
  text->setObjectName(name);
  text->setWordWrap(true);
  text->setTextInteractionFlags(Qt::TextSelectableByMouse);
  return text;
}

QPushButton* makeButton(const QString& text, const char* name, const QString& what)
{
  auto* button = new QPushButton(text);
  button->setObjectName(name);
  button->setToolTip(what);
  return button;
}

} // namespace

CheckPanel::CheckPanel(QWidget* parent)
  : QWidget(parent)
  , verdict_(makeText("checkVerdict"))
  , measures_(makeText("checkMeasures"))
  , rows_(new QTableWidget)
  , legend_(makeText("checkLegend"))
  , look_(makeButton(tr("&Look at"), "lookAtFault",
      tr("Turn the picture to the place of the fault that is chosen (Return, double click)")))
  , all_(makeButton(
      tr("Mark &all"), "markAllFaults", tr("Choose none: mark all faults that disturb a press")))
  , repair_(makeButton(tr("&Repair…"), "repairSurface",
      tr("Write a repaired surface to another file; this one stays as it is")))
{
  QFont bold = verdict_->font();
  bold.setBold(true);
  verdict_->setFont(bold);
  rows_->setObjectName("faults");
  rows_->setAccessibleName(tr("Faults"));
  rows_->setToolTip(tr("The fault that is chosen is marked in the picture; its place is that of "
                       "the first one, of holes that of the widest"));
  rows_->setColumnCount(kColumns);
  rows_->setHorizontalHeaderLabels({ tr("Fault"), tr("Count"), tr("Place [mm]"), tr("Around [mm]"),
    tr("On loading"), tr("In a press") });
  for (int column = 0; column < kTexts; ++column)
  {
    rows_->horizontalHeader()->setSectionResizeMode(column, QHeaderView::ResizeToContents);
  }
  rows_->verticalHeader()->setSectionResizeMode(QHeaderView::ResizeToContents);
  rows_->horizontalHeader()->setDefaultAlignment(Qt::AlignLeft | Qt::AlignVCenter);
  rows_->horizontalHeader()->setHighlightSections(false);
  rows_->verticalHeader()->hide();
  rows_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  rows_->setSelectionBehavior(QAbstractItemView::SelectRows);
  rows_->setSelectionMode(QAbstractItemView::SingleSelection);
  rows_->setTabKeyNavigation(false); // it leaves the table
  rows_->setHorizontalScrollMode(QAbstractItemView::ScrollPerPixel);
  rows_->installEventFilter(this);
  rows_->viewport()->installEventFilter(this);
  rows_->setMinimumHeight(2 * rows_->verticalHeader()->defaultSectionSize()); // on a low screen
  auto* foot = new QHBoxLayout;
  foot->addWidget(legend_, 1);
  foot->addWidget(look_);
  foot->addWidget(all_);
  foot->addWidget(repair_);
  auto* measures = new QScrollArea; // on a low screen a line of them
  scrollDownOnly(*measures, measures_);
  measures->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Preferred);
  measures->setMinimumHeight(measures_->fontMetrics().lineSpacing());
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(4, 0, 4, 2);
  layout->setSpacing(2);
  layout->addWidget(verdict_);
  layout->addWidget(measures);
  layout->addWidget(rows_, 1);
  layout->addLayout(foot);
  connect(rows_, &QTableWidget::itemSelectionChanged, this, &CheckPanel::chosenChanged);
  connect(rows_, &QTableWidget::activated, this, &CheckPanel::lookAsked);
  connect(look_, &QPushButton::clicked, this, &CheckPanel::lookAsked);
  connect(all_, &QPushButton::clicked, rows_, &QTableWidget::clearSelection);
  connect(repair_, &QPushButton::clicked, this, &CheckPanel::repairAsked);
}

void CheckPanel::show(const QString& verdict, const QString& measures, const figures::Table& faults)
{
  verdict_->setText(verdict);
  measures_->setText(measures);
  rows_->setRowCount(0);
  rows_->setRowCount(static_cast<int>(faults.rows.size()));
  for (int row = 0; row < rows_->rowCount(); ++row)
  {
    const std::vector<figures::Cell>& cells = faults.rows[static_cast<std::size_t>(row)];
    for (int column = 0; column < rows_->columnCount(); ++column)
    {
      const figures::Cell& cell = cells[static_cast<std::size_t>(column)];
      rows_->setItem(row, column,
        new QTableWidgetItem(QString::fromStdString(figures::textOf(cell, kCheckDigits))));
    }
    if (!rows_->item(row, rows_->columnCount() - 1)->text().isEmpty())
    {
      rows_->item(row, 0)->setIcon(style()->standardIcon(QStyle::SP_MessageBoxWarning));
    }
  }
  fit();
  const bool hasFaults = rows_->rowCount() > 0;
  look_->setEnabled(hasFaults);
  all_->setEnabled(hasFaults);
  repair_->setEnabled(hasFaults);
}

void CheckPanel::showLegend(const QString& what)
{
  const auto& [red, green, blue] = FaultMarks::kColor;
  legend_->setText(what.isEmpty()
      ? tr("Nothing is marked in the picture")
      : tr("<span style=\"color:%1\">■</span> marked in the picture: %2")
          .arg(QColor::fromRgbF(red, green, blue).name(), what));
}

std::optional<std::size_t> CheckPanel::chosen() const
{
  const QModelIndexList rows = rows_->selectionModel()->selectedRows();
  return rows.isEmpty() ? std::nullopt : std::optional<std::size_t>(rows.front().row());
}

// the texts have the room that is left, and lines
void CheckPanel::fit()
{
  constexpr int kLeast = 190; // [pixels]
  const int left = rows_->viewport()->width() - rows_->columnViewportPosition(kTexts) -
    rows_->horizontalScrollBar()->value();
  rows_->setColumnWidth(kTexts, std::max(kLeast, 2 * left / 5));
  rows_->setColumnWidth(kTexts + 1, std::max(kLeast, left - rows_->columnWidth(kTexts)));
}

// the first arrow key chooses the first row, which the table would go on from
bool CheckPanel::eventFilter(QObject* rows, QEvent* event)
{
  event->type() == QEvent::Resize ? fit() : void();
  const auto* key = event->type() == QEvent::KeyPress ? static_cast<QKeyEvent*>(event) : nullptr;
  const bool isFirst = key != nullptr && !chosen() && rows_->rowCount() > 0 &&
    (key->key() == Qt::Key_Down || key->key() == Qt::Key_Up);
  isFirst ? rows_->selectRow(0) : void();
  return isFirst || QWidget::eventFilter(rows, event);
}

} // namespace palp
