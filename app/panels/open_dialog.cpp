#include "app/panels/open_dialog.h"

#include "app/input/quantity.h"
#include "haptics/error.h"
#include "haptics/files/csv_text.h"
#include "haptics/units.h"
#include "pipeline/surface_io/surface_io.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QDir>
#include <QFileInfo>
#include <QFormLayout>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>

#include <algorithm>
#include <cmath>
#include <utility>

namespace palp
{

const char* const kImageFiles = "*.mha *.mhd *.nii *.nii.gz *.nrrd *.nhdr *.vti *.dcm";

bool isImageFile(const QString& file)
{
  return QFileInfo(file).isDir() ||
    QDir::match(QString(kImageFiles).split(' '), QFileInfo(file).fileName());
}

OpenDialog::OpenDialog(const QString& file, QWidget* parent)
  : QDialog(parent)
  , file_(file.toStdString())
  , why_(new QLabel)
  , series_(QFileInfo(file).isDir() ? new QLineEdit : nullptr)
  , level_(isImageFile(file) ? new QLineEdit : nullptr)
  , band_(isImageFile(file) ? new QLineEdit : nullptr)
  , label_(isImageFile(file) ? new QLineEdit : nullptr)
  , unit_(new QComboBox)
{
  setWindowTitle(tr("Open %1").arg(QFileInfo(file).fileName()));
  auto* rows = new QFormLayout(this);
  why_->setObjectName("why");
  why_->setWordWrap(true);
  why_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  why_->setMinimumWidth(why_->fontMetrics().averageCharWidth() * 60);
  rows->addRow(why_);
  if (series_ != nullptr)
  {
    series_->setObjectName("series");
    series_->setPlaceholderText(tr("of several in the folder, e.g. 2"));
    series_->setToolTip(tr("Its place in the list of them, or its UID"));
    rows->addRow(tr("Series of DICOM images"), series_);
  }
  if (level_ != nullptr)
  {
    level_->setObjectName("level");
    level_->setPlaceholderText(tr("e.g. 0.5 for a mask of 0 and 1"));
    level_->setToolTip(tr("Value of the image at the surface, between those outside and inside"));
    rows->addRow(tr("Level of the surface"), level_);
    band_->setObjectName("values");
    band_->setPlaceholderText(tr("of a CT, e.g. 200:3071 for bone"));
    band_->setToolTip(tr("Lowest and highest value of what is the body"));
    rows->addRow(tr("or range of its values"), band_);
    label_->setObjectName("label");
    label_->setPlaceholderText(tr("of a label map, e.g. 5, or 1,2 for both"));
    label_->setToolTip(tr("Values of the label map that are opened, with commas between"));
    rows->addRow(tr("or label of the body"), label_);
  }
  unit_->setObjectName("unit");
  unit_->addItems({ "auto", "mm", "cm", "m" });
  unit_->setToolTip(tr("Length that a coordinate of 1 stands for; auto: as the file or the size of "
                       "the body tells"));
  rows->addRow(tr("Unit of the coordinates"), unit_);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Open | QDialogButtonBox::Cancel);
  connect(buttons, &QDialogButtonBox::accepted, this, &OpenDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &OpenDialog::reject);
  rows->addRow(buttons);
}

// ticking one writes what asks for it into the field of labels
void OpenDialog::setLabels(FileOrgans found)
{
  listed_ = std::move(found.organs);
  if (listed_.empty())
  {
    return;
  }
  auto* list = new QListWidget;
  list->setObjectName("labels");
  list->setAccessibleName(tr("Labels"));
  list->setToolTip(tr("A tick opens the label"));
  const UnitChoice unit = unitNamed(found.unit);
  for (const FileOrgan& organ : listed_)
  {
    QString text =
      QString::fromStdString(organ.label + "  " + organ.name) + tr("  %1 voxels").arg(organ.voxels);
    if (unit)
    {
      const double volume = std::pow(unitLength(*unit), 3) * organ.voxelVolume;
      const double milliliters = units::toMilliliters(volume);
      text += milliliters < 1000.0 ? tr("  %1 ml").arg(milliliters, 0, 'g', 4)
                                   : tr("  %1 ml").arg(milliliters, 0, 'f', 0);
    }
    auto* item = new QListWidgetItem(text, list);
    item->setData(Qt::UserRole, QString::fromStdString(csvField(askedFor(organ))));
    item->setCheckState(Qt::Unchecked);
  }
  connect(list, &QListWidget::itemChanged, this,
    [this, list]
    {
      QStringList ticked;
      for (int i = 0; i < list->count(); ++i)
      {
        if (list->item(i)->checkState() == Qt::Checked)
        {
          ticked << list->item(i)->data(Qt::UserRole).toString();
        }
      }
      label_->setText(ticked.join(','));
    });
  auto* rows = static_cast<QFormLayout*>(layout());
  int row = 0;
  QFormLayout::ItemRole role{};
  rows->getWidgetPosition(label_, &row, &role);
  rows->insertRow(row + 1, tr("Labels in it"), list);
  label_->setFocus(); // what is asked for most
  if (listed_.size() > 1)
  {
    areOrgans_ = new QCheckBox(tr("Each an organ of its own; else all are one body"));
    areOrgans_->setObjectName("areOrgans");
    areOrgans_->setToolTip(tr("Organs have a tissue, a color and a role each"));
    areOrgans_->setChecked(true);
    rows->insertRow(row + 2, {}, areOrgans_);
  }
}

// its value, but where layers use that twice its name
std::string OpenDialog::askedFor(const FileOrgan& organ) const
{
  const bool isTold = std::ranges::count(listed_, organ.label, &FileOrgan::label) == 1;
  return isTold || organ.name.empty() ? organ.label : organ.name;
}

std::vector<FileOrgan> OpenDialog::organs() const
{
  std::vector<FileOrgan> organs;
  const std::vector<std::string> labels = source().part.labels;
  for (const std::string& label : labels)
  {
    const auto found =
      std::ranges::find(listed_, label, [this](const FileOrgan& organ) { return askedFor(organ); });
    organs.push_back({ .label = label,
      .name = found != listed_.end() ? found->name : std::string(),
      .surface = {},
      .from = {} });
  }
  const bool areSeveral = areOrgans_ != nullptr && areOrgans_->isChecked() && labels.size() > 1;
  return areSeveral ? organs : std::vector<FileOrgan>();
}

void OpenDialog::setReason(const QString& why)
{
  why_->setText(why);
}

MeshSource OpenDialog::source() const
{
  MeshSource source{ .file = file_, .unit = parseUnit(unit_->currentText().toStdString()) };
  const auto typed = [](const QLineEdit* field)
  { return field != nullptr ? field->text().trimmed().toStdString() : std::string(); };
  const std::string level = typed(level_);
  const std::string band = typed(band_);
  const std::string labels = typed(label_);
  if ((level.empty() ? 0 : 1) + (band.empty() ? 0 : 1) + (labels.empty() ? 0 : 1) > 1)
  {
    throw Error(ErrorCode::BadValue, "Level, range and label: more than one is given; give one");
  }
  ImagePart& part = source.part;
  part.series = typed(series_);
  part.level = level.empty() ? std::nullopt : std::optional(parseNumber(level, "Level"));
  part.band = band.empty() ? std::nullopt : std::optional(parseBand(band, "Range"));
  part.labels = labels.empty() ? std::vector<std::string>() : parseLabels(labels, "Label");
  return source;
}

void OpenDialog::accept()
{
  try
  {
    (void)source();
    QDialog::accept();
  }
  catch (const std::exception& error)
  {
    setReason(QString::fromStdString(error.what()));
  }
}

} // namespace palp
