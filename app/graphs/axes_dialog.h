#pragma once

#include <QDialog>

#include <span>
#include <vector>

class QCheckBox;
class QLineEdit;
class vtkPalpChart;

namespace palp
{

/// Asks which axes of charts are held at a range, and at which; the others follow the data.
class AxesDialog : public QDialog
{
  Q_OBJECT

public:
  /// @param charts  outlive the dialog
  explicit AxesDialog(std::span<vtkPalpChart* const> charts, QWidget* parent = nullptr);

  /// Takes the ranges over, where each is one.
  void accept() override;

private:
  struct Row
  {
    vtkPalpChart* chart;
    int side;
    QCheckBox* isHeld;
    QLineEdit* from;
    QLineEdit* to;
  };

  std::vector<Row> rows_;
};

} // namespace palp
