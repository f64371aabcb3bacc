#include "app/panels/press_bar.h"

#include "app/input/quantity.h"
#include "app/panels/panel_boxes.h"
#include "haptics/error.h"
#include "haptics/units.h"

#include <QLabel>
#include <QLineEdit>
#include <QPushButton>

namespace palp
{
namespace
{

constexpr int kArrows = 28; // of a box [pixels]

} // namespace

PressBar::PressBar(QWidget* parent)
  : QToolBar(tr("Press at a place"), parent)
  , place_(new QLineEdit)
  , depth_(new QuantityBox("pressDepth", ShownUnit::millimeters()))
  , speed_(new QuantityBox("pressSpeed", ShownUnit::speed()))
{
  setObjectName("pressBar");
  place_->setObjectName("pressPlace");
  place_->setAccessibleName(tr("Place"));
  depth_->setAccessibleName(tr("Depth"));
  speed_->setAccessibleName(tr("Speed"));
  place_->setPlaceholderText(tr("x, y, z"));
  // narrow, as a window of 1024 columns has to show all of the bar
  place_->setFixedWidth(place_->fontMetrics().horizontalAdvance("-000.00, -00.00, 00.00"));
  depth_->setFixedWidth(depth_->fontMetrics().horizontalAdvance("00.00 mm") + kArrows);
  speed_->setFixedWidth(speed_->fontMetrics().horizontalAdvance("00.0 mm/s") + kArrows);
  addField(tr("Place [mm]"),
    tr("x, y, z [mm] in the frame of the surface (LPS for images), within 5 mm of it; a press of "
       "the mouse fills it in"),
    place_);
  addField(tr("Depth"), tr("d [mm] of the contact, up to half of the body's thickness"), depth_);
  addField("", tr("Speed [mm/s], down and up; at the depth the tool rests for 0.3 s"), speed_);
  const PlacedPresses usual;
  depth_->setSi(usual.depth);
  speed_->setSi(usual.speed);
  depth_->setCheck(
    [this] { (void)parsePressDepth(quantityText(depth_->si(), Quantity::Length), "Depth"); });
  speed_->setCheck(
    [this] { (void)parsePressSpeed(quantityText(speed_->si(), Quantity::Speed), "Speed"); });
  for (QuantityBox* field : { depth_, speed_ })
  {
    connect(field, &QuantityBox::refused, this, [this, field] { tellRefusal(*field); });
  }
  connect(place_, &QLineEdit::returnPressed, this, &PressBar::pressAsked);

  auto* press = new QPushButton(tr("Press"));
  press->setObjectName("pressButton");
  press->setToolTip(tr("Press there and come back, with the tool and the tissue in use"));
  connect(press, &QPushButton::clicked, this, &PressBar::pressAsked);
  addWidget(press);
}

void PressBar::addField(const QString& label, const QString& what, QWidget* field)
{
  addWidget(new QLabel(label.isEmpty() ? label : ' ' + label + ' '));
  addWidget(field);
  field->setToolTip(what);
}

// the newest one, or one that still stands
void PressBar::tellRefusal(QuantityBox& field)
{
  const QString newest = field.refusal();
  markRefused(field, !newest.isEmpty());
  Q_EMIT refused(newest.isEmpty() ? refusal() : newest);
}

QString PressBar::refusal() const
{
  return depth_->refusal().isEmpty() ? speed_->refusal() : depth_->refusal();
}

PlacedPresses PressBar::presses() const
{
  if (const QString reason = refusal(); !reason.isEmpty())
  {
    throw Error(ErrorCode::BadValue, reason.toStdString());
  }
  return { .places = { parsePlace(place_->text().toStdString(), "Place") },
    .depth = depth_->si(),
    .speed = speed_->si() };
}

void PressBar::showPlace(const Eigen::Vector3d& place)
{
  QStringList numbers;
  for (const double coordinate : place)
  {
    numbers << QString::number(units::toMillimeters(coordinate), 'f', 2);
  }
  place_->setText(numbers.join(", "));
}

void PressBar::showPress(const Contact& deepest)
{
  showPlace(deepest.center);
  depth_->setSi(deepest.depth);
  depth_->forget();
}

void PressBar::clearPlace()
{
  place_->clear();
}

} // namespace palp
