#include "app/panels/press_bar.h"

#include "app/input/quantity.h"
#include "app/panels/panel_boxes.h"
#include "haptics/error.h"
#include "haptics/files/fixed_text.h"
#include "haptics/units.h"

#include <QAbstractItemView>
#include <QCompleter>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QStandardItemModel>
#include <QStyle>

#include <algorithm>
#include <cmath>

namespace palp
{
namespace
{

constexpr int kArrows = 28;            // of a box [pixels]
constexpr int kPlace = Qt::UserRole;   // as text, of what is offered
constexpr int kPlaceName = kPlace + 1; // likewise
constexpr double kDepthStep = 0.1;     // [mm]

QString textOf(const Eigen::Vector3d& place)
{
  QStringList numbers;
  for (const double coordinate : place)
  {
    numbers << QString::fromStdString(fixed(units::toMillimeters(coordinate), 2));
  }
  return numbers.join(", ");
}

} // namespace

double depthToType(const Contact& deepest)
{
  constexpr double kStep = 1e-6; // [m], to which a tool comes as deep as it is asked
  return kStep * std::round(deepest.depth / kStep);
}

PressBar::PressBar(QWidget* parent)
  : QToolBar(tr("Press at a place"), parent)
  , place_(new QLineEdit)
  , offered_(new QStandardItemModel(this))
  , choose_(nullptr)
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
       "the mouse fills it in, a list of places offers them (Down); a depth may follow, as in "
       "-50, -20, 60, 5 mm"),
    place_);
  addField(tr("Depth"),
    tr("\u03b4 [mm] of the contact, more than 0, up to half of the body's thickness; arrow keys: "
       "0.1 mm"),
    depth_);
  addField(
    "", tr("v [mm/s], more than 0: down and up; at the depth the tool rests for 0.3 s"), speed_);
  makeOffer();
  depth_->setStep(kDepthStep);
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
  connect(place_, &QLineEdit::returnPressed, this,
    [this]
    {
      const bool isChoosing = place_->completer()->popup()->isVisible();
      isChoosing ? void() : Q_EMIT pressAsked();
    });

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

// a list below the field, by its key or its button
void PressBar::makeOffer()
{
  auto* list = new QCompleter(offered_, this);
  list->setCompletionMode(QCompleter::UnfilteredPopupCompletion);
  list->setCompletionRole(kPlace);
  place_->setCompleter(list);
  choose_ =
    place_->addAction(style()->standardIcon(QStyle::SP_ArrowDown), QLineEdit::TrailingPosition);
  choose_->setToolTip(tr("Choose a place of the list"));
  choose_->setVisible(false);
  connect(choose_, &QAction::triggered, list,
    [this, list]
    {
      place_->setFocus(); // else it takes no choice
      list->complete();
    });
}

void PressBar::offer(const PlacedPresses& presses)
{
  offered_->clear();
  for (const PressPlace& place : presses.places)
  {
    const QString text = textOf(place.position);
    const QString name = QString::fromStdString(place.name);
    auto* item = new QStandardItem(name.isEmpty() ? text : name + ": " + text);
    item->setData(text, kPlace);
    item->setData(name, kPlaceName);
    offered_->appendRow(item);
  }
  choose_->setVisible(offered_->rowCount() > 0);
  presses.places.empty() ? clearPlace() : showPlace(presses.places.front().position);
  depth_->setSi(presses.depth);
  speed_->setSi(presses.speed);
}

PlacedPresses PressBar::values() const
{
  if (const QString reason = refusal(); !reason.isEmpty())
  {
    throw Error(ErrorCode::BadValue, reason.toStdString());
  }
  return { .depth = depth_->si(), .speed = speed_->si() };
}

PlacedPresses PressBar::presses()
{
  const QString text = place_->text();
  const int last = text.lastIndexOf(',');
  constexpr int kFour = 3; // commas between x,y,z and a depth
  if (text.count(',') > kFour)
  {
    throw Error(ErrorCode::BadValue,
      "Place: '" + text.section(',', kFour + 1).trimmed().toStdString() +
        "' stands behind the depth; give x, y, z and a depth, as in -50, -20, 60, 5 mm");
  }
  if (text.count(',') == kFour && !text.contains(';'))
  {
    const QString behind = text.mid(last + 1).trimmed();
    depth_->setSi(parsePressDepth(behind.toStdString(), "Depth"));
    depth_->forget();
    place_->setText(text.left(last));
  }
  PlacedPresses presses = values();
  presses.places = { parsePlace(place_->text().toStdString(), "Place") };
  presses.places.front().name = offeredName(place_->text());
  return presses;
}

// empty: none of the list
std::string PressBar::offeredName(const QString& place) const
{
  for (int row = 0; row < offered_->rowCount(); ++row)
  {
    if (const QStandardItem& item = *offered_->item(row); item.data(kPlace) == place)
    {
      return item.data(kPlaceName).toString().toStdString();
    }
  }
  return {};
}

void PressBar::showPlace(const Eigen::Vector3d& place)
{
  place_->setText(textOf(place));
}

void PressBar::showPress(const Contact& deepest)
{
  showPlace(deepest.center);
  depth_->setSi(depthToType(deepest));
  depth_->forget();
}

void PressBar::clearPlace()
{
  place_->clear();
  offered_->clear();
  choose_->setVisible(false);
}

} // namespace palp
