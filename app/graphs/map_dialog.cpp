#include "app/graphs/map_dialog.h"

#include "app/input/press_places.h"
#include "app/panels/panel_boxes.h"

#include <QDialogButtonBox>
#include <QGridLayout>
#include <QGroupBox>
#include <QPushButton>
#include <QRadioButton>
#include <QVBoxLayout>

namespace palp
{
namespace
{

void limit(QuantityBox& box, const QString& name)
{
  box.setCheck(
    [&box, what = name.toStdString()]
    {
      (void)parseWithin(quantityText(box.si(), Quantity::Length), Quantity::Length,
        { kLeastSpacing, kMostSpacing, "0.5mm to 200mm" }, what);
    });
}

} // namespace

MapDialog::MapDialog(
  const MapRequest& usual, const std::optional<Eigen::Vector3d>& last, QWidget* parent)
  : QDialog(parent)
  , last_(last)
  , depth_(new QuantityBox("mapDepth", ShownUnit::millimeters()))
  , spacing_(new QuantityBox("mapSpacing", ShownUnit::millimeters()))
  , radius_(new QuantityBox("mapRadius", ShownUnit::millimeters()))
  , isRegion_(new QRadioButton(tr("Around the last press")))
{
  setObjectName("mapDialog");
  setWindowTitle(tr("Stiffness map"));
  auto* how = new QGroupBox(tr("Press"));
  QGridLayout& rows = *makeRows(*how);
  addRow(rows, tr("Depth"), depth_);
  addRow(rows, tr("Spacing"), spacing_);
  depth_->setToolTip(tr("δ [mm] of each contact, more than 0, up to half of the body's thickness, "
                        "along the inward normal; the stiffness dF/dδ is taken there"));
  spacing_->setToolTip(tr("s [mm], 0.5 to 200: from each place to the next, at least; half of it "
                          "takes four times as many presses"));
  depth_->setCheck(
    [this] { (void)parsePressDepth(quantityText(depth_->si(), Quantity::Length), "Depth"); });
  limit(*spacing_, tr("Spacing"));

  auto* where = new QGroupBox(tr("Where"));
  QGridLayout& places = *makeRows(*where);
  auto* all = new QRadioButton(tr("Whole surface"));
  all->setChecked(true);
  all->setToolTip(tr("Places on every side of the body"));
  isRegion_->setObjectName("mapRegion");
  isRegion_->setEnabled(last.has_value());
  isRegion_->setToolTip(
    last ? tr("Only places near the last press") : tr("There is no press so far; press once"));
  places.addWidget(all, 0, 0, 1, 2);
  places.addWidget(isRegion_, 1, 0, 1, 2);
  addRow(places, tr("Radius"), radius_);
  radius_->setToolTip(tr("r [mm], 0.5 to 200: of the region around the last press"));
  radius_->setEnabled(false);
  limit(*radius_, tr("Radius"));
  connect(isRegion_, &QRadioButton::toggled, radius_, &QWidget::setEnabled);

  depth_->setSi(usual.depth);
  spacing_->setSi(usual.spacing);
  radius_->setSi(usual.region.value_or(MapRegion{}).radius);

  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel);
  buttons->button(QDialogButtonBox::Ok)->setText(tr("Press"));
  connect(buttons, &QDialogButtonBox::accepted, this, &MapDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &MapDialog::reject);
  auto* layout = new QVBoxLayout(this);
  layout->addWidget(how);
  layout->addWidget(where);
  layout->addWidget(buttons);
}

MapRequest MapDialog::request() const
{
  MapRequest request{ .depth = depth_->si(), .spacing = spacing_->si(), .region = {} };
  if (last_ && isRegion_->isChecked())
  {
    request.region = MapRegion{ *last_, radius_->si() };
  }
  return request;
}

// what is refused says so below its field
void MapDialog::accept()
{
  const bool isRefused = !depth_->refusal().isEmpty() || !spacing_->refusal().isEmpty() ||
    (radius_->isEnabled() && !radius_->refusal().isEmpty());
  if (!isRefused)
  {
    QDialog::accept();
  }
}

} // namespace palp
