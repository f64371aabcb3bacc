#include "app/panel_boxes.h"

#include "haptics/units.h"

#include <QGridLayout>
#include <QGroupBox>
#include <QLabel>
#include <QSignalBlocker>
#include <QWheelEvent>

namespace palp
{
namespace
{

double same(double value)
{
  return value;
}

} // namespace

ShownUnit ShownUnit::millimetres()
{
  return { QStringLiteral("mm"), units::toMillimetres, units::fromMillimetres };
}

ShownUnit ShownUnit::degrees()
{
  return { QStringLiteral("°"), units::toDegrees, units::fromDegrees };
}

ShownUnit ShownUnit::kilopascals()
{
  return { QStringLiteral("kPa"), units::toKilopascals, units::fromKilopascals };
}

ShownUnit ShownUnit::si(const QString& suffix)
{
  return { suffix, same, same };
}

QuantityBox::QuantityBox(
  const char* name, const ShownUnit& unit, int decimals, double low, double high)
  : unit_(unit)
{
  setObjectName(name);
  setDecimals(decimals);
  setRange(low, high);
  setSuffix(unit.suffix.isEmpty() ? QString() : " " + unit.suffix);
  setKeyboardTracking(false);
  setStepType(QAbstractSpinBox::AdaptiveDecimalStepType);
  setFocusPolicy(Qt::StrongFocus);
}

void QuantityBox::setSi(double value)
{
  const QSignalBlocker quiet(this);
  setValue(unit_.fromSi(value));
  exact_ = value;
  exactAs_ = this->value();
}

double QuantityBox::si() const
{
  return value() == exactAs_ ? exact_ : unit_.toSi(value());
}

// 10 mm, not 10.000 mm
QString QuantityBox::textFromValue(double value) const
{
  QString text = QDoubleSpinBox::textFromValue(value);
  if (text.contains(locale().decimalPoint()))
  {
    while (text.endsWith(locale().zeroDigit()))
    {
      text.chop(1);
    }
    if (text.endsWith(locale().decimalPoint()))
    {
      text.chop(1);
    }
  }
  return text;
}

void QuantityBox::wheelEvent(QWheelEvent* event)
{
  hasFocus() ? QDoubleSpinBox::wheelEvent(event) : event->ignore();
}

ChoiceBox::ChoiceBox(const char* name, const QStringList& choices)
{
  setObjectName(name);
  addItems(choices);
  setFocusPolicy(Qt::StrongFocus);
}

void ChoiceBox::show(int index)
{
  const QSignalBlocker quiet(this);
  setCurrentIndex(index);
}

void ChoiceBox::wheelEvent(QWheelEvent* event)
{
  hasFocus() ? QComboBox::wheelEvent(event) : event->ignore();
}

QGridLayout* makeRows(QGroupBox& group)
{
  constexpr int kSide = 8;
  constexpr int kBetween = 3; // low, as a screen of 768 rows has to show all of a panel
  auto* rows = new QGridLayout(&group);
  rows->setContentsMargins(kSide, kBetween, kSide, kBetween);
  rows->setVerticalSpacing(kBetween);
  rows->setColumnStretch(1, 1);
  // the fields of all groups begin at one edge
  rows->setColumnMinimumWidth(0, group.fontMetrics().horizontalAdvance("Young's modulus E"));
  return rows;
}

void addRow(QGridLayout& rows, const QString& label, QWidget* field)
{
  const int row = rows.rowCount();
  auto* text = new QLabel(label);
  text->setBuddy(field);
  rows.addWidget(text, row, 0);
  rows.addWidget(field, row, 1);
}

QLabel* labelOf(const QGridLayout& rows, const QWidget* field)
{
  for (int row = 0; row < rows.rowCount(); ++row)
  {
    QLayoutItem* item = rows.itemAtPosition(row, 1);
    if (item != nullptr && item->widget() == field)
    {
      return qobject_cast<QLabel*>(rows.itemAtPosition(row, 0)->widget());
    }
  }
  return nullptr;
}

void setRowVisible(const QGridLayout& rows, QWidget* field, bool visible)
{
  field->setVisible(visible);
  labelOf(rows, field)->setVisible(visible);
}

} // namespace palp
