#pragma once

#include <QFileDialog>

#include <filesystem>

namespace palp
{

class QuantityBox;

/// Asks where a repaired surface is written to, and which holes are closed.
class RepairDialog : public QFileDialog
{
  Q_OBJECT

public:
  /// @param source  file of the surface, which is never written to
  explicit RepairDialog(const std::filesystem::path& source, QWidget* parent = nullptr);

  // Both once it is accepted.
  [[nodiscard]] std::filesystem::path file() const
  {
    return selectedFiles().value(0).toStdString();
  }
  [[nodiscard]] double largestHole() const; ///< length around it [m]; 0: none is closed

  void accept() override; ///< stays, with the reason, where what was typed is refused

private:
  std::filesystem::path source_;
  QuantityBox* hole_;
};

} // namespace palp
