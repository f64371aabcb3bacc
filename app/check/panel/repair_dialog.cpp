#include "app/check/panel/repair_dialog.h"

#include "app/check/checked_surface.h"
#include "app/panels/panel_boxes.h"
#include "app/program/output.h"

#include <QDir>
#include <QFileInfo>
#include <QGridLayout>
#include <QMessageBox>

namespace palp
{
namespace
{

// beside the source, where something can be written there
QString suggestedFor(const std::filesystem::path& source)
{
  const QFileInfo folder(QString::fromStdString(source.parent_path().string()));
  const QString name = QFileInfo(QString::fromStdString(source.string())).baseName();
  return QDir(folder.isWritable() ? folder.filePath() : QDir::currentPath())
    .absoluteFilePath(name + "_repaired.vtp");
}

} // namespace

RepairDialog::RepairDialog(const std::filesystem::path& source, QWidget* parent)
  : QFileDialog(parent, tr("Repair into"))
  , source_(source)
  , hole_(new QuantityBox("largestHole", ShownUnit::millimeters()))
{
  setObjectName("repairDialog");
  setOption(DontUseNativeDialog); // for the row of our own
  setAcceptMode(AcceptSave);
  setNameFilter(tr("Surfaces (*.vtp *.stl *.ply *.obj)"));
  setDefaultSuffix("vtp");
  const QFileInfo suggested(suggestedFor(source));
  setDirectory(suggested.path());
  selectFile(suggested.fileName());
  hole_->setToolTip(
    tr("l [mm], 0 to 10000: length around the largest hole that is closed; 0: none"));
  hole_->setCheck(
    [this]
    {
      (void)parseLargestHole(
        quantityText(hole_->si(), Quantity::Length), hole_->accessibleName().toStdString());
    });
  hole_->setSi(0.0);
  addRow(*qobject_cast<QGridLayout*>(layout()), tr("Close holes up to"), hole_);
}

double RepairDialog::largestHole() const
{
  return hole_->si();
}

void RepairDialog::accept()
{
  if (!hole_->refusal().isEmpty())
  {
    return;
  }
  try
  {
    checkRepairName(file());
    keepInputs(file().parent_path(), { file().filename() }, filesBehind(source_));
  }
  catch (const std::exception& error)
  {
    QMessageBox::warning(this, tr("Palp"), QString::fromStdString(error.what()));
    return;
  }
  QFileDialog::accept();
}

} // namespace palp
