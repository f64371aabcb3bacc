#pragma once

#include "app/input/quantity.h"

#include <QAbstractSpinBox>
#include <QComboBox>

#include <functional>
#include <optional>

class QGridLayout;
class QGroupBox;
class QLabel;

namespace palp
{

/// How people read and write a quantity that is SI inside.
struct ShownUnit
{
  std::string name; ///< behind the number; empty for one without unit
  std::optional<Quantity> kind;
  double (*fromSi)(double);

  [[nodiscard]] static ShownUnit millimeters();
  [[nodiscard]] static ShownUnit degrees();
  [[nodiscard]] static ShownUnit kilopascals();
  [[nodiscard]] static ShownUnit damping();
  [[nodiscard]] static ShownUnit speed();
  [[nodiscard]] static ShownUnit none();
};

/// A quantity to type, read as on the command line; a bare number has the unit shown.
///
/// What is refused stays to be mended, and the value before stays in use, which the key of Undo
/// brings back; where nothing is typed that key is left to the window. A value that nobody
/// changes stays exact, whatever digits are shown. The wheel scrolls the panel and changes nothing,
/// unless the box was clicked.
class QuantityBox : public QAbstractSpinBox
{
  Q_OBJECT

public:
  QuantityBox(const char* name, const ShownUnit& unit);

  /// What a value has to pass before it is in use; throws Error.
  void setCheck(std::function<void()> check);

  /// What an arrow key adds, in the unit that is shown; at first one in the second digit.
  void setStep(double shown) noexcept
  {
    step_ = shown;
  }

  /// Without a signal; what was refused stays where the value is the same.
  void setSi(double value);
  [[nodiscard]] double si() const;

  /// Gives up what was refused.
  void forget();

  /// Why what is typed is not in use; empty: it is.
  [[nodiscard]] QString refusal() const;

  void stepBy(int steps) override;
  [[nodiscard]] QSize sizeHint() const override;
  [[nodiscard]] QSize minimumSizeHint() const override;

Q_SIGNALS:
  void changed();
  void refused(const QString& why); ///< empty: no longer

protected:
  bool event(QEvent* event) override;
  [[nodiscard]] StepEnabled stepEnabled() const override;
  void wheelEvent(QWheelEvent* event) override;

private:
  [[nodiscard]] double read() const;
  void take();
  [[nodiscard]] QString inUnit(double shown) const;
  void showNumber(double shown);

  ShownUnit unit_;
  std::function<void()> check_;
  double step_ = 0.0; // 0: by the number
  double si_ = 0.0;
  QString read_; // text that was taken or refused
  QString refusal_;
};

/// A list to choose from, whose text ends in dots where it has too little room; the wheel as in
/// QuantityBox.
class ChoiceBox : public QComboBox
{
public:
  ChoiceBox(const char* name, const QStringList& choices);

  /// Without a signal.
  void show(int index);

protected:
  void paintEvent(QPaintEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
};

/// Rows of a label and a field, for a group of a panel. A grid, as a form keeps room for what is
/// hidden.
[[nodiscard]] QGridLayout* makeRows(QGroupBox& group);

void addRow(QGridLayout& rows, const QString& label, QWidget* field);

/// The same, with a row below that tells why a value is refused.
void addRow(QGridLayout& rows, const QString& label, QuantityBox* field);

/// A row that tells why the value of the field above is refused; see showReason.
[[nodiscard]] QLabel* addReason(QGridLayout& rows, const QWidget& field);

/// Marks a field whose value is refused.
void markRefused(QWidget& field, bool isRefused);

/// Marks a field as refused, with the reason in its row; with none it is marked no longer.
void showReason(QLabel& row, QWidget& field, const QString& why);

/// Names the field in its row and in what is said of it.
void setLabel(const QGridLayout& rows, QWidget* field, const QString& label);

/// Shows or hides a field with its label.
void setRowVisible(const QGridLayout& rows, QWidget* field, bool visible);

} // namespace palp
