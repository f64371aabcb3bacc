#pragma once

#include <QFileDialog>

class QLineEdit;

namespace palp
{

/// Asks for a folder to write into, which need not be there yet.
///
/// The toolkit's own dialog takes no new one, and, for a path that is typed, the folder above it.
class FolderDialog : public QFileDialog
{
  Q_OBJECT

public:
  /// @param suggested  name of a new folder
  FolderDialog(const QString& title, const QString& suggested, QWidget* parent = nullptr);

  /// The whole path; once it is accepted.
  [[nodiscard]] const QString& folder() const
  {
    return folder_;
  }

  void accept() override;

private:
  QLineEdit* typed_;
  QString folder_;
};

} // namespace palp
