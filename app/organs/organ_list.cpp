#include "app/organs/organ_list.h"

#include "app/panels/panel_boxes.h"
#include "haptics/units.h"

#include <QColorDialog>
#include <QEvent>
#include <QHeaderView>
#include <QPainter>
#include <QPainterPath>
#include <QSignalBlocker>
#include <QToolButton>
#include <QTreeWidget>
#include <QVBoxLayout>

#include <algorithm>

namespace palp
{
namespace
{

enum Column
{
  kEye,
  kColor,
  kName,
  kRole,
  kTissue,
  kColumns
};

constexpr int kIcon = 16; // [pixels]

// open, or closed
QIcon eyeIcon(const QPalette& palette, bool isOpen)
{
  QPixmap picture(kIcon, kIcon);
  picture.fill(Qt::transparent);
  QPainter painter(&picture);
  painter.setRenderHint(QPainter::Antialiasing);
  const QColor& ink = palette.color(QPalette::ButtonText);
  painter.setPen(QPen(ink, 1.4));
  QPainterPath lids(QPointF(1.0, 8.0));
  lids.quadTo(8.0, 15.0, 15.0, 8.0);
  if (isOpen)
  {
    lids.quadTo(8.0, 1.0, 1.0, 8.0);
    painter.drawPath(lids);
    painter.setBrush(ink);
    painter.drawEllipse(QPointF(8.0, 8.0), 2.0, 2.0);
  }
  else
  {
    painter.drawPath(lids);
  }
  return { picture };
}

QColor colorOf(const OrganPlan& organ)
{
  return { organ.color[0], organ.color[1], organ.color[2] };
}

QIcon colorIcon(const OrganPlan& organ)
{
  QPixmap picture(kIcon, kIcon);
  picture.fill(colorOf(organ));
  return { picture };
}

QStringList roleNames()
{
  return { OrganList::tr("Pressed"), OrganList::tr("Through"), OrganList::tr("Shown"),
    OrganList::tr("Hidden") };
}

// of a row, by the name that a part of it has in all of them
template <typename Widget>
Widget* partOf(QTreeWidget& rows, std::size_t place, Column column)
{
  return qobject_cast<Widget*>(rows.itemWidget(rows.topLevelItem(static_cast<int>(place)), column));
}

QToolButton* makeButton(const char* name, std::size_t place)
{
  auto* button = new QToolButton;
  button->setObjectName(name + QString::number(place));
  button->setAutoRaise(true);
  return button;
}

// at least so many letters wide; all of them are in its list
ChoiceBox* makeChoice(const char* name, std::size_t place, const QStringList& choices, int letters)
{
  auto* box = new ChoiceBox((name + std::to_string(place)).c_str(), choices);
  box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  box->setIconSize(QSize(0, 0)); // there is none, and the names of organs want the room
  box->setMinimumContentsLength(letters);
  return box;
}

} // namespace

OrganList::OrganList(QWidget* parent)
  : QWidget(parent)
  , presets_(shippedTissues())
  , rows_(new QTreeWidget)
{
  setObjectName("organs");
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(2, 2, 2, 2);
  column->addWidget(rows_);
  setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Maximum);
  rows_->setObjectName("organRows");
  rows_->setAccessibleName(tr("Organs"));
  rows_->setColumnCount(kColumns);
  rows_->setHeaderLabels({ {}, {}, tr("Organ"), tr("Role"), tr("Tissue") });
  rows_->setRootIsDecorated(false);
  constexpr int kLetters = 46; // of all columns together
  rows_->setMinimumWidth(kLetters * rows_->fontMetrics().averageCharWidth());
  rows_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  rows_->header()->setMinimumSectionSize(kIcon);
  rows_->header()->setSectionResizeMode(QHeaderView::ResizeToContents);
  rows_->header()->setStretchLastSection(false);
  rows_->header()->setSectionResizeMode(kName, QHeaderView::Stretch); // cut where it is long
  connect(rows_, &QTreeWidget::currentItemChanged, this, &OrganList::chosenChanged);
}

// in place where there are as many as before, since one of its fields may be in use
void OrganList::show(const std::vector<OrganPlan>& organs)
{
  const QSignalBlocker quiet(rows_);
  organs_ = organs;
  if (seen_.size() != organs.size())
  {
    rows_->clear();
    seen_.assign(organs.size(), OrganRole::Show);
    for (std::size_t i = 0; i < organs.size(); ++i)
    {
      addRow(i);
    }
    constexpr int kMost = 8; // rows that are seen at once
    int row = 0;
    for (const Column column : { kEye, kRole })
    {
      row =
        organs.empty() ? 0 : std::max(row, partOf<QWidget>(*rows_, 0, column)->sizeHint().height());
    }
    constexpr int kLeast = 3;
    const int around = rows_->header()->sizeHint().height() + 2 * rows_->frameWidth();
    rows_->setMinimumHeight(row * std::min(kLeast, rows_->topLevelItemCount()) + around);
    rows_->setMaximumHeight(row * std::min(kMost, rows_->topLevelItemCount()) + around);
    const std::vector<std::size_t> felt = feltOrgans(organs);
    rows_->setCurrentItem(rows_->topLevelItem(felt.empty() ? 0 : static_cast<int>(felt.front())));
  }
  for (std::size_t i = 0; i < organs.size(); ++i)
  {
    seen_[i] = organs[i].role == OrganRole::Hide ? seen_[i] : organs[i].role;
    showRow(i);
  }
}

// an eye is as light or dark as letters are
void OrganList::changeEvent(QEvent* event)
{
  QWidget::changeEvent(event);
  for (std::size_t i = 0; event->type() == QEvent::PaletteChange && i < organs_.size(); ++i)
  {
    showRow(i);
  }
}

void OrganList::addRow(std::size_t place)
{
  constexpr int kRoleLetters = 6; // of the widest
  constexpr int kTissueLetters = 7;
  auto* row = new QTreeWidgetItem(rows_);
  auto* eye = makeButton("organEye", place);
  auto* color = makeButton("organColor", place);
  color->setToolTip(tr("Color"));
  color->setAccessibleName(color->toolTip());
  ChoiceBox* role = makeChoice("organRole", place, roleNames(), kRoleLetters);
  role->setToolTip(tr("Pressed: felt and opaque\nThrough and Shown: seen, and no obstacle to the "
                      "tool"));
  QStringList tissues;
  for (const TissuePreset& preset : presets_)
  {
    tissues << QString::fromStdString(preset.title);
  }
  ChoiceBox* tissue = makeChoice("organTissue", place, tissues << tr("Custom"), kTissueLetters);
  rows_->setItemWidget(row, kEye, eye);
  rows_->setItemWidget(row, kColor, color);
  rows_->setItemWidget(row, kRole, role);
  rows_->setItemWidget(row, kTissue, tissue);
  connect(eye, &QToolButton::clicked, this, [this, place] { toggleEye(place); });
  connect(color, &QToolButton::clicked, this, [this, place] { askColor(place); });
  connect(role, qOverload<int>(&QComboBox::currentIndexChanged), this,
    [this, place](int index)
    {
      OrganPlan organ = organs_[place];
      organ.role = static_cast<OrganRole>(index);
      ask(place, organ);
    });
  connect(tissue, qOverload<int>(&QComboBox::currentIndexChanged), this,
    [this, place](int index) { takeTissue(place, index); });
}

void OrganList::showRow(std::size_t place)
{
  const OrganPlan& organ = organs_[place];
  const QString name = QString::fromStdString(organ.name);
  rows_->topLevelItem(static_cast<int>(place))->setText(kName, name);
  rows_->topLevelItem(static_cast<int>(place))->setToolTip(kName, name);
  const bool isSeen = organ.role != OrganRole::Hide;
  auto* eye = partOf<QToolButton>(*rows_, place, kEye);
  eye->setIcon(eyeIcon(palette(), isSeen));
  eye->setToolTip(isSeen ? tr("Hide %1").arg(name) : tr("Show %1").arg(name));
  eye->setAccessibleName(eye->toolTip());
  partOf<QToolButton>(*rows_, place, kColor)->setIcon(colorIcon(organ));
  const auto choice = [&](Column column)
  {
    return static_cast<ChoiceBox*>(
      rows_->itemWidget(rows_->topLevelItem(static_cast<int>(place)), column));
  };
  choice(kRole)->setAccessibleName(tr("Role of %1").arg(name));
  choice(kTissue)->setAccessibleName(tr("Tissue of %1").arg(name));
  choice(kRole)->show(static_cast<int>(organ.role));
  choice(kTissue)->show(presetOf(organ));
  const double young = units::toKilopascals(organ.press.tissue.young);
  choice(kTissue)->setToolTip(tr("%1: E = %2 kPa, \u03bd = %3")
                                .arg(choice(kTissue)->currentText())
                                .arg(young, 0, 'g', 4)
                                .arg(organ.press.tissue.poisson, 0, 'g', 3));
}

// what is refused is shown again by whoever refuses
void OrganList::ask(std::size_t place, const OrganPlan& organ)
{
  rows_->setCurrentItem(rows_->topLevelItem(static_cast<int>(place)));
  std::vector<OrganPlan> organs = organs_;
  organs[place] = organ;
  Q_EMIT changed(organs);
}

void OrganList::toggleEye(std::size_t place)
{
  OrganPlan organ = organs_[place];
  organ.role = organ.role == OrganRole::Hide ? seen_[place] : OrganRole::Hide;
  ask(place, organ);
}

void OrganList::askColor(std::size_t place)
{
  OrganPlan organ = organs_[place];
  const QColor color =
    QColorDialog::getColor(colorOf(organ), this, tr("Color of %1").arg(organ.name.c_str()));
  if (color.isValid())
  {
    const auto part = [](int value) { return static_cast<std::uint8_t>(value); };
    organ.color = { part(color.red()), part(color.green()), part(color.blue()) };
    ask(place, organ);
  }
}

// none of them: E and nu stay
void OrganList::takeTissue(std::size_t place, int preset)
{
  OrganPlan organ = organs_[place];
  if (const auto index = static_cast<std::size_t>(preset); index < presets_.size())
  {
    organ.press.tissue.young = presets_[index].material.youngModulus;
    organ.press.tissue.poisson = presets_[index].material.poissonRatio;
  }
  ask(place, organ);
}

// that whose E and nu it has
int OrganList::presetOf(const OrganPlan& organ) const
{
  const auto isSame = [&organ](const TissuePreset& preset)
  {
    return preset.material.youngModulus == organ.press.tissue.young &&
      preset.material.poissonRatio == organ.press.tissue.poisson;
  };
  return static_cast<int>(std::ranges::find_if(presets_, isSame) - presets_.begin());
}

std::size_t OrganList::chosen() const
{
  return static_cast<std::size_t>(std::max(0, rows_->indexOfTopLevelItem(rows_->currentItem())));
}

void OrganList::choose(const std::string& name)
{
  const auto found = std::ranges::find(organs_, name, &OrganPlan::name);
  if (found != organs_.end())
  {
    const QSignalBlocker quiet(rows_);
    rows_->setCurrentItem(rows_->topLevelItem(static_cast<int>(found - organs_.begin())));
  }
}

} // namespace palp
