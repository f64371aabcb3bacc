#include "app/panels/folder_dialog.h"

#include <QDir>
#include <QLineEdit>

namespace palp
{

FolderDialog::FolderDialog(const QString& title, const QString& suggested, QWidget* parent)
  : QFileDialog(parent, title)
{
  setOption(DontUseNativeDialog);
  setAcceptMode(AcceptSave);
  setFilter(QDir::AllDirs | QDir::NoDotAndDotDot);
  setLabelText(FileName, tr("Folder"));
  setLabelText(Accept, tr("Export"));
  selectFile(suggested);
  typed_ = findChild<QLineEdit*>();
  for (const char* name : { "fileTypeLabel", "fileTypeCombo" }) // folders are of no type
  {
    findChild<QWidget*>(name)->hide();
  }
}

void FolderDialog::accept()
{
  QString typed = typed_->text().trimmed();
  if (typed == "~" || typed.startsWith("~/"))
  {
    typed.replace(0, 1, QDir::homePath());
  }
  if (typed.isEmpty())
  {
    return;
  }
  folder_ = QDir::cleanPath(directory().absoluteFilePath(typed));
  done(Accepted);
}

} // namespace palp
