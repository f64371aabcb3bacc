#pragma once

#include "app/input/scene_plan.h"
#include "pipeline/process/file_organs.h"

#include <QDialog>

#include <vector>

class QCheckBox;
class QComboBox;
class QLabel;
class QLineEdit;
class QListWidget;

namespace palp
{

/// Asks for what a file does not tell: the unit of its coordinates and, of an image, the level of
/// the surface, the range of the body's values, or its labels, which are listed to be ticked.
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
  void setLabels(FileOrgans found);

  /// Calls them as a table does, with its colors: those whose value the image has once.
  /// @throws Error  as readLabelNames
  void setNames(const std::filesystem::path& table);

  /// The labels that are to be an organ each, with name; none: source() is one body.
  [[nodiscard]] std::vector<FileOrgan> organs() const;

  /// The file with what was typed.
  /// @throws Error  BadValue
  [[nodiscard]] MeshSource source() const;

  void accept() override; ///< stays, with the reason, where what was typed is refused

private:
  [[nodiscard]] bool isOnce(const FileOrgan& organ) const;
  [[nodiscard]] std::string askedFor(const FileOrgan& organ) const;
  [[nodiscard]] QString lineOf(const FileOrgan& organ) const;
  [[nodiscard]] QStringList ticked() const;
  void tickAll();
  void chooseNames();

  std::filesystem::path file_;
  QLabel* why_;
  QLineEdit* series_; // null: of a folder alone
  QLineEdit* level_;  // null: a surface has none
  QLineEdit* band_;   // likewise
  QLineEdit* label_;  // likewise
  QComboBox* unit_;
  QCheckBox* areOrgans_ = nullptr; // null: there are not several labels
  QListWidget* list_ = nullptr;    // likewise
  std::vector<FileOrgan> listed_;
  UnitChoice listedIn_; // their unit
};

/// The endings of files that hold an image, as in `*.mha *.nii.gz`.
extern const char* const kImageFiles;

[[nodiscard]] bool isImageFile(const QString& file);

} // namespace palp
