#include "app/graphs/axes_dialog.h"

#include "pipeline/charts/vtkPalpChart.h"

#include <vtkAxis.h>

#include <QCheckBox>
#include <QDialogButtonBox>
#include <QGridLayout>
#include <QLabel>
#include <QLineEdit>
#include <QMessageBox>

namespace palp
{

AxesDialog::AxesDialog(std::span<vtkPalpChart* const> charts, QWidget* parent)
  : QDialog(parent)
{
  setWindowTitle(tr("Axes"));
  auto* grid = new QGridLayout(this);
  grid->addWidget(new QLabel(tr("Hold")), 0, 0);
  grid->addWidget(new QLabel(tr("from")), 0, 1);
  grid->addWidget(new QLabel(tr("to")), 0, 2);
  for (vtkPalpChart* chart : charts)
  {
    for (const int side : { vtkAxis::BOTTOM, vtkAxis::LEFT })
    {
      vtkAxis* axis = chart->GetAxis(side);
      const Row row{ chart, side, new QCheckBox(QString::fromStdString(axis->GetTitle())),
        new QLineEdit(QString::number(axis->GetMinimum(), 'g', 6)),
        new QLineEdit(QString::number(axis->GetMaximum(), 'g', 6)) };
      row.isHeld->setChecked(chart->IsHeld(side));
      row.isHeld->setToolTip(tr("Keeps the axis at this range; else it follows the data"));
      const int line = grid->rowCount();
      grid->addWidget(row.isHeld, line, 0);
      grid->addWidget(row.from, line, 1);
      grid->addWidget(row.to, line, 2);
      for (QLineEdit* edit : { row.from, row.to })
      {
        edit->setAccessibleName(
          row.isHeld->text() + ' ' + (edit == row.from ? tr("from") : tr("to")));
        edit->setToolTip(tr("%1, in its unit; typing holds the axis").arg(edit->accessibleName()));
        connect(edit, &QLineEdit::textEdited, row.isHeld,
          [held = row.isHeld] { held->setChecked(true); });
      }
      rows_.push_back(row);
    }
  }
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel);
  connect(buttons, &QDialogButtonBox::accepted, this, &AxesDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &AxesDialog::reject);
  grid->addWidget(buttons, grid->rowCount(), 0, 1, 3);
}

void AxesDialog::accept()
{
  for (const Row& row : rows_)
  {
    bool isFrom = false;
    bool isTo = false;
    const double from = row.from->text().toDouble(&isFrom);
    const double to = row.to->text().toDouble(&isTo);
    if (!row.isHeld->isChecked())
    {
      row.chart->Follow(row.side);
    }
    else if (isFrom && isTo && from < to)
    {
      row.chart->Hold(row.side, from, to);
    }
    else
    {
      QMessageBox::warning(this, tr("Palp"),
        tr("%1: '%2' to '%3' is no range; write two numbers, the smaller one first")
          .arg(row.isHeld->text(), row.from->text(), row.to->text()));
      return;
    }
  }
  QDialog::accept();
}

} // namespace palp
