#pragma once

#include "app/input/scene_plan.h"

#include <QDialog>

class QComboBox;
class QLabel;
class QLineEdit;

namespace palp
{

struct FileOrgans;

/// Asks for what a file does not tell: the unit of its coordinates and, of an image, the level of
/// the surface or the labels of the body, which are listed to be ticked.
class OpenDialog : public QDialog
{
  Q_OBJECT

public:
  /// @param file  a surface or an image
  explicit OpenDialog(const QString& file, QWidget* parent = nullptr);

  /// Why the file was not opened as it was asked for.
  void setReason(const QString& why);

  /// Lists what can be ticked, below the field of labels.
  /// @param found  in that image; nothing is listed where there is none
  void setLabels(const FileOrgans& found);

  /// The file with what was typed.
  /// @throws Error  BadValue
  [[nodiscard]] MeshSource source() const;

  void accept() override; ///< stays, with the reason, where what was typed is refused

private:
  std::filesystem::path file_;
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
