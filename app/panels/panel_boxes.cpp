#include "app/panels/panel_boxes.h"

#include "haptics/error.h"
#include "haptics/units.h"
#include "pipeline/view/appearance.h"

#include <QDialog>
#include <QGridLayout>
#include <QGroupBox>
#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QSignalBlocker>
#include <QStylePainter>
#include <QWheelEvent>

#include <cmath>
#include <utility>

namespace palp
{
namespace
{

double same(double value)
{
  return value;
}

QColor colorOf(const appearance::Color& color)
{
  return QColor::fromRgbF(color[0], color[1], color[2]);
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

} // namespace

ShownUnit ShownUnit::millimeters()
{
  return { "mm", Quantity::Length, units::toMillimeters };
}

ShownUnit ShownUnit::degrees()
{
  return { "°", Quantity::Angle, units::toDegrees };
}

ShownUnit ShownUnit::kilopascals()
{
  return { "kPa", Quantity::Pressure, units::toKilopascals };
}

ShownUnit ShownUnit::damping()
{
  return { "N·s/m", Quantity::Damping, same };
}

ShownUnit ShownUnit::speed()
{
  return { "mm/s", Quantity::Speed, units::toMillimeters };
}

ShownUnit ShownUnit::none()
{
  return { "", std::nullopt, same };
}

QuantityBox::QuantityBox(const char* name, const ShownUnit& unit)
  : unit_(unit)
{
  setObjectName(name);
  setFocusPolicy(Qt::StrongFocus);
  setKeyboardTracking(false);
  connect(this, &QAbstractSpinBox::editingFinished, this, &QuantityBox::take);
}

void QuantityBox::setCheck(std::function<void()> check)
{
  check_ = std::move(check);
}

void QuantityBox::setSi(double value)
{
  if (value != si_ || text().isEmpty())
  {
    si_ = value;
    forget();
  }
}

double QuantityBox::si() const
{
  return si_;
}

void QuantityBox::forget()
{
  refusal_.clear();
  showNumber(unit_.fromSi(si_));
  Q_EMIT refused({});
}

QString QuantityBox::refusal() const
{
  return refusal_;
}

QString QuantityBox::inUnit(double shown) const
{
  constexpr int kDigits = 10;
  const QString unit = QString::fromStdString(unit_.name);
  return (QString::number(shown, 'g', kDigits) + ' ' + unit).trimmed();
}

void QuantityBox::showNumber(double shown)
{
  read_ = inUnit(shown);
  lineEdit()->setText(read_);
  lineEdit()->setCursorPosition(0); // of a long number the first digits are seen
}

double QuantityBox::read() const
{
  const std::string typed = text().toStdString();
  const std::string name = accessibleName().toStdString();
  return unit_.kind ? parseQuantity(typed, *unit_.kind, name, unit_.name)
                    : parseNumber(typed, name);
}

// the field's own undo ends at what was shown last
bool QuantityBox::event(QEvent* event)
{
  const bool isOverride = event->type() == QEvent::ShortcutOverride;
  if ((isOverride || event->type() == QEvent::KeyPress) &&
    static_cast<QKeyEvent*>(event)->matches(QKeySequence::Undo))
  {
    const bool isTyped = !refusal_.isEmpty() || text() != read_;
    event->setAccepted(isTyped);
    isTyped && !isOverride ? forget() : void();
    return true;
  }
  return QAbstractSpinBox::event(event);
}

// also comes when the field is left as it was
void QuantityBox::take()
{
  if (text() == read_)
  {
    return;
  }
  read_ = text();
  const double before = si_;
  try
  {
    si_ = read();
    check_();
  }
  catch (const Error& error)
  {
    si_ = before;
    refusal_ = QString::fromStdString(error.what());
    Q_EMIT refused(refusal_ + "; still in use: " + inUnit(unit_.fromSi(si_)));
    return;
  }
  forget();
  if (si_ != before)
  {
    Q_EMIT changed();
  }
}

void QuantityBox::stepBy(int steps)
{
  constexpr double kFromZero = 0.1;
  const double shown = unit_.fromSi(si_);
  const double step = step_ > 0.0 ? step_
    : shown > 0.0                 ? std::pow(10.0, std::floor(std::log10(shown)) - 1.0)
                                  : kFromZero;
  showNumber(step * (std::round(shown / step) + steps));
  read_.clear();
  take();
}

// no quantity here may be negative
QAbstractSpinBox::StepEnabled QuantityBox::stepEnabled() const
{
  return si_ > 0.0 ? StepUpEnabled | StepDownEnabled : StepEnabled(StepUpEnabled);
}

QSize QuantityBox::sizeHint() const
{
  const int width = fontMetrics().horizontalAdvance("0000000.00 kPa");
  return QAbstractSpinBox::sizeHint() + QSize(width, 0);
}

QSize QuantityBox::minimumSizeHint() const
{
  return sizeHint();
}

void QuantityBox::wheelEvent(QWheelEvent* event)
{
  hasFocus() ? QAbstractSpinBox::wheelEvent(event) : event->ignore();
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

void ChoiceBox::paintEvent(QPaintEvent*)
{
  QStyleOptionComboBox option;
  initStyleOption(&option);
  const QRect room =
    style()->subControlRect(QStyle::CC_ComboBox, &option, QStyle::SC_ComboBoxEditField, this);
  constexpr int kSide = 2; // that the style leaves beside a text
  option.currentText =
    fontMetrics().elidedText(option.currentText, Qt::ElideRight, room.width() - kSide);
  QStylePainter painter(this);
  painter.drawComplexControl(QStyle::CC_ComboBox, option);
  painter.drawControl(QStyle::CE_ComboBoxLabel, option);
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
  field->setAccessibleName(label);
}

void addRow(QGridLayout& rows, const QString& label, QuantityBox* field)
{
  addRow(rows, label, static_cast<QWidget*>(field));
  QLabel* reason = addReason(rows, *field);
  QObject::connect(field, &QuantityBox::refused, reason,
    [=](const QString& why) { showReason(*reason, *field, why); });
}

QLabel* addReason(QGridLayout& rows, const QWidget& field)
{
  auto* reason = new QLabel;
  reason->setObjectName(field.objectName() + "Reason");
  reason->setWordWrap(true);
  reason->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred); // the panel keeps its width
  reason->setStyleSheet("color: " + colorOf(appearance::kBad).name());
  reason->hide();
  rows.addWidget(reason, rows.rowCount(), 0, 1, 2);
  return reason;
}

void markRefused(QWidget& field, bool isRefused)
{
  QPalette palette = field.parentWidget()->palette();
  if (isRefused)
  {
    palette.setColor(QPalette::Text, colorOf(appearance::kBad));
  }
  field.setPalette(palette);
}

void showReason(QLabel& row, QWidget& field, const QString& why)
{
  markRefused(field, !why.isEmpty());
  row.setText(why);
  row.setVisible(!why.isEmpty());
  if (auto* dialog = qobject_cast<QDialog*>(row.window()))
  {
    dialog->adjustSize(); // which a text of several lines does not by itself
  }
}

void setLabel(const QGridLayout& rows, QWidget* field, const QString& label)
{
  labelOf(rows, field)->setText(label);
  field->setAccessibleName(label);
}

void setRowVisible(const QGridLayout& rows, QWidget* field, bool visible)
{
  field->setVisible(visible);
  labelOf(rows, field)->setVisible(visible);
}

} // namespace palp
