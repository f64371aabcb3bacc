#pragma once

#include "app/input/scene_plan.h"

#include <QDialog>

#include <functional>

class QComboBox;
class QFormLayout;
class QLabel;
class QLineEdit;
class QListWidget;

namespace palp
{

/// Asks for what a file does not tell: the unit of its coordinates and, of an image, the level of
/// the surface or the labels of the body, which are listed to be ticked. Stays, with the reason,
/// until the file is opened or given up.
class OpenDialog : public QDialog
{
  Q_OBJECT

public:
  /// @param file  a surface or an image
  /// @param why   it was not opened as it is
  /// @param open  opens it; throws Error
  OpenDialog(const QString& file, const QString& why, std::function<void(const MeshSource&)> open,
    QWidget* parent = nullptr);

  void accept() override;

private:
  [[nodiscard]] MeshSource source() const;
  void addLabels(QFormLayout& rows);

  std::filesystem::path file_;
  std::function<void(const MeshSource&)> open_;
  QLabel* why_;
  QLineEdit* series_; // null: of a folder alone
  QLineEdit* level_;  // null: a surface has none
  QLineEdit* label_;  // likewise
  QComboBox* unit_;
};

/// The endings of files that hold an image, as in `*.mha *.nii.gz`.
extern const char* const kImageFiles;

[[nodiscard]] bool isImageFile(const QString& file);

} // namespace palp
