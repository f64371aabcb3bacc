#include "app/panels/open_dialog.h"

#include "app/input/quantity.h"
#include "haptics/error.h"
#include "haptics/files/csv_text.h"
#include "haptics/units.h"
#include "pipeline/process/dicom_mark.h"
#include "pipeline/surface_io/label_names.h"
#include "pipeline/surface_io/surface_io.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QPushButton>
#include <QSignalBlocker>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

namespace palp
{

namespace
{

bool hasSurface(const FileOrgan& organ)
{
  return organ.voxels >= kFewestVoxels;
}

} // namespace

const char* const kImageFiles = "*.mha *.mhd *.nii *.nii.gz *.nrrd *.nhdr *.vti *.dcm";

bool isImageFile(const QString& file)
{
  return QFileInfo(file).isDir() ||
    QDir::match(QString(kImageFiles).split(' '), QFileInfo(file).fileName()) ||
    hasDicomMark(file.toStdString());
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
  list_ = new QListWidget;
  list_->setObjectName("labels");
  list_->setAccessibleName(tr("Labels"));
  list_->setToolTip(tr("A tick opens the label"));
  listedIn_ = unitNamed(found.unit);
  for (const FileOrgan& organ : listed_)
  {
    auto* item = new QListWidgetItem(lineOf(organ), list_);
    item->setData(Qt::UserRole, QString::fromStdString(csvField(askedFor(organ))));
    item->setCheckState(Qt::Unchecked);
  }
  connect(list_, &QListWidget::itemChanged, this, [this] { label_->setText(ticked().join(',')); });
  auto* names = new QPushButton(tr("Names from a table..."));
  names->setObjectName("names");
  names->setAutoDefault(false);
  names->setToolTip(tr("Of 3D Slicer, ITK-SNAP, or JSON as of TotalSegmentator"));
  connect(names, &QPushButton::clicked, this, &OpenDialog::chooseNames);
  auto* all = new QPushButton(tr("All"));
  all->setObjectName("allLabels");
  all->setAutoDefault(false);
  all->setToolTip(tr("Ticks all labels of eight voxels or more, or where all are ticked, none"));
  connect(all, &QPushButton::clicked, this, &OpenDialog::tickAll);
  auto* under = new QHBoxLayout;
  under->addWidget(all);
  under->addWidget(names, 1);
  auto* rows = static_cast<QFormLayout*>(layout());
  int row = 0;
  QFormLayout::ItemRole role{};
  rows->getWidgetPosition(label_, &row, &role);
  rows->insertRow(row + 1, tr("Labels in it"), list_);
  rows->insertRow(row + 2, {}, under);
  label_->setFocus(); // what is asked for most
  if (listed_.size() > 1)
  {
    areOrgans_ = new QCheckBox(tr("Each an organ of its own; else all are one body"));
    areOrgans_->setObjectName("areOrgans");
    areOrgans_->setToolTip(tr("Organs have a tissue, a color and a role each"));
    areOrgans_->setChecked(true);
    rows->insertRow(row + 3, {}, areOrgans_);
  }
}

QStringList OpenDialog::ticked() const
{
  QStringList ticked;
  for (int i = 0; i < list_->count(); ++i)
  {
    if (list_->item(i)->checkState() == Qt::Checked)
    {
      ticked << list_->item(i)->data(Qt::UserRole).toString();
    }
  }
  return ticked;
}

// those that have a surface
void OpenDialog::tickAll()
{
  const auto all = std::ranges::count_if(listed_, hasSurface);
  const Qt::CheckState state = ticked().size() < all ? Qt::Checked : Qt::Unchecked;
  {
    const QSignalBlocker quiet(list_); // one change, not one for each
    for (int i = 0; i < list_->count(); ++i)
    {
      const bool isMeant =
        state == Qt::Unchecked || hasSurface(listed_[static_cast<std::size_t>(i)]);
      list_->item(i)->setCheckState(isMeant ? state : Qt::Unchecked);
    }
  }
  list_->viewport()->update();
  label_->setText(ticked().join(','));
}

void OpenDialog::setNames(const std::filesystem::path& table)
{
  const std::vector<LabelName> names = readLabelNames(table);
  const std::map<double, std::string> colors = readLabelColors(table);
  const QSignalBlocker quiet(list_); // no tick changes
  for (std::size_t i = 0; i < listed_.size(); ++i)
  {
    FileOrgan& organ = listed_[i];
    const std::optional<double> value = csvNumber(organ.label);
    if (!value || !isOnce(organ))
    {
      continue;
    }
    const auto name = std::ranges::find(names, *value, &LabelName::value);
    const auto color = colors.find(*value);
    organ.name = name != names.end() ? name->name : organ.name;
    organ.color = color != colors.end() ? color->second : organ.color;
    list_->item(static_cast<int>(i))->setText(lineOf(organ));
  }
}

void OpenDialog::chooseNames()
{
  const QString table = QFileDialog::getOpenFileName(this, tr("Open table of names"), {},
    tr("Tables (*.ctbl *.csv *.txt *.label *.json);;All files (*)"));
  try
  {
    table.isEmpty() ? void() : setNames(table.toStdString());
  }
  catch (const Error& error)
  {
    setReason(QString::fromStdString(error.what()));
  }
}

QString OpenDialog::lineOf(const FileOrgan& organ) const
{
  QString text =
    QString::fromStdString(organ.label + "  " + organ.name) + tr("  %1 voxels").arg(organ.voxels);
  if (listedIn_)
  {
    const double volume = std::pow(unitLength(*listedIn_), 3) * organ.voxelVolume;
    const double milliliters = units::toMilliliters(volume);
    text += milliliters < 1000.0 ? tr("  %1 ml").arg(milliliters, 0, 'g', 4)
                                 : tr("  %1 ml").arg(milliliters, 0, 'f', 0);
  }
  return text;
}

bool OpenDialog::isOnce(const FileOrgan& organ) const
{
  return std::ranges::count(listed_, organ.label, &FileOrgan::label) == 1;
}

// its value, but where layers use that twice its name
std::string OpenDialog::askedFor(const FileOrgan& organ) const
{
  return isOnce(organ) || organ.name.empty() ? organ.label : organ.name;
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
      .color = found != listed_.end() ? found->color : std::string(),
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
  if (labels == "all" && !listed_.empty()) // as of palp import
  {
    part.labels.clear();
    for (const FileOrgan& organ : listed_)
    {
      hasSurface(organ) ? part.labels.push_back(askedFor(organ)) : void();
    }
  }
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
