#pragma once

#include "calibration/figures/table.h"

#include <QWidget>

#include <optional>

class QLabel;
class QPushButton;
class QTableWidget;

namespace palp
{

/// What is wrong with a surface: a sentence, its measures, a row a fault. Changes nothing by
/// itself.
class CheckPanel : public QWidget
{
  Q_OBJECT

public:
  explicit CheckPanel(QWidget* parent = nullptr);

  /// @param verdict   one sentence on what was found
  /// @param measures  lines
  /// @param faults    as faultTable(); a row whose last cell is not empty gets a sign
  void show(const QString& verdict, const QString& measures, const figures::Table& faults);

  /// Legend of the marks in the picture.
  /// @param what  that is marked; empty: nothing is
  void showLegend(const QString& what);

  /// The row that is chosen; none: all are meant.
  [[nodiscard]] std::optional<std::size_t> chosen() const;

Q_SIGNALS:
  void chosenChanged();
  void lookAsked(); ///< at the one that is chosen, else at the first
  void repairAsked();

protected:
  bool eventFilter(QObject* rows, QEvent* event) override;

private:
  void fit();

  QLabel* verdict_;
  QLabel* measures_;
  QTableWidget* rows_;
  QLabel* legend_;
  QPushButton* look_;
  QPushButton* all_;
  QPushButton* repair_;
};

} // namespace palp
