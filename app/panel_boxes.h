#pragma once

#include <QComboBox>
#include <QDoubleSpinBox>

class QGridLayout;
class QGroupBox;
class QLabel;

namespace palp
{

/// How people read and write a quantity that is SI inside.
struct ShownUnit
{
  QString suffix; ///< behind the number; empty for one without unit
  double (*fromSi)(double);
  double (*toSi)(double);

  [[nodiscard]] static ShownUnit millimetres();
  [[nodiscard]] static ShownUnit degrees();
  [[nodiscard]] static ShownUnit kilopascals();
  [[nodiscard]] static ShownUnit si(const QString& suffix = {});
};

/// A quantity to type, with its unit.
///
/// A value that nobody changes stays exact, whatever digits are shown. The wheel scrolls the panel
/// and changes nothing, unless the box was clicked.
class QuantityBox : public QDoubleSpinBox
{
public:
  /// @param low, high  in the unit shown, as setMaximum
  QuantityBox(const char* name, const ShownUnit& unit, int decimals, double low, double high);

  void setSi(double value);
  [[nodiscard]] double si() const;

protected:
  [[nodiscard]] QString textFromValue(double value) const override;
  void wheelEvent(QWheelEvent* event) override;

private:
  ShownUnit unit_;
  double exact_ = 0.0;    // as last set [SI]
  double exactAs_ = -1.0; // and how the box shows it
};

/// A list to choose from; the wheel as in QuantityBox.
class ChoiceBox : public QComboBox
{
public:
  ChoiceBox(const char* name, const QStringList& choices);

  /// Without a signal.
  void show(int index);

protected:
  void wheelEvent(QWheelEvent* event) override;
};

/// Rows of a label and a field, for a group of a panel. A grid, as a form keeps room for what is
/// hidden.
[[nodiscard]] QGridLayout* makeRows(QGroupBox& group);

void addRow(QGridLayout& rows, const QString& label, QWidget* field);

/// Of a field that was added.
[[nodiscard]] QLabel* labelOf(const QGridLayout& rows, const QWidget* field);

/// Shows or hides a field with its label.
void setRowVisible(const QGridLayout& rows, QWidget* field, bool visible);

} // namespace palp
