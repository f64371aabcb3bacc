#include "app/panels/press_list.h"

#include "app/input/law_options.h"
#include "app/input/tip_text.h"
#include "app/plots/kept_presses.h"
#include "haptics/files/fixed_text.h"
#include "haptics/units.h"

#include <QAction>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QMenu>
#include <QPainter>
#include <QSignalBlocker>
#include <QStyledItemDelegate>
#include <QToolButton>
#include <QTreeWidget>
#include <QVBoxLayout>

#include <algorithm>
#include <limits>

namespace palp
{
namespace
{

using units::toMillimeters;

constexpr int kName = 0;
constexpr int kOrgan = 10;        // the last
constexpr int kId = Qt::UserRole; // data of a name

class NeverEdited : public QStyledItemDelegate
{
public:
  using QStyledItemDelegate::QStyledItemDelegate;
  QWidget* createEditor(QWidget*, const QStyleOptionViewItem&, const QModelIndex&) const override
  {
    return nullptr;
  }
};

QString number(double value, int decimals)
{
  return QString::fromStdString(fixed(value, decimals));
}

// a line as the curve's
QIcon iconOf(const KeptPress& press)
{
  constexpr int kWidth = 22; // [pixels]
  constexpr int kHeight = 12;
  QPixmap picture(kWidth, kHeight);
  picture.fill(Qt::transparent);
  const auto [color, style] = penOf(press);
  QPainter painter(&picture);
  painter.setPen(QPen(QColor::fromRgbF(color[0], color[1], color[2]), 3.0,
    static_cast<Qt::PenStyle>(static_cast<int>(style))));
  painter.drawLine(0, kHeight / 2, kWidth, kHeight / 2);
  return { picture };
}

QStringList cellsOf(const KeptPress& press)
{
  const PressSummary& all = press.summary;
  const Eigen::Vector3d place = toMillimeters(1.0) * all.deepest.center;
  return { QString::fromStdString(all.name), number(all.force, 2),
    number(toMillimeters(all.deepest.depth), 2),
    QString::fromStdString(describeTip(press.law.tip())),
    QString::fromStdString(describeLaw(press.law.settings())),
    number(units::toKilopascals(press.law.material().youngModulus), 1),
    all.stiffness ? number(units::toNewtonsPerMillimeter(*all.stiffness), 3) : QObject::tr("–"),
    number(1e3 * all.energy, 2),
    QString("%1, %2, %3").arg(number(place.x(), 1), number(place.y(), 1), number(place.z(), 1)),
    press.outside.empty() ? QObject::tr("within limits") : QString::fromStdString(press.outside),
    QString::fromStdString(press.organ) };
}

} // namespace

PressList::PressList(const PressLog& log, QWidget* parent)
  : QWidget(parent)
  , log_(log)
  , rows_(new QTreeWidget)
  , buttons_(new QHBoxLayout)
{
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(2, 2, 2, 2);
  column->setSpacing(2);
  column->addLayout(buttons_);
  column->addWidget(rows_);
  makeRows();
  makeActions();
  enable();
}

void PressList::makeRows()
{
  rows_->setObjectName("pressRows");
  rows_->setAccessibleName(tr("Presses"));
  struct Column
  {
    QString title;
    QString what;
  };
  const QVector<Column> columns{
    { tr("Press"),
      tr("A tick: compared with the others. Selected: they differ from it. F2 or a "
         "double click: rename") },
    { tr("F max [N]"), tr("The largest force of the law") },
    { tr("δ max [mm]"), tr("The largest depth of the contact") },
    { tr("Tool"), tr("As --tip takes it") }, { tr("Law"), tr("As --law and its options take it") },
    { tr("E [kPa]"), tr("Young's modulus") },
    { tr("K at 1 N [N/mm]"),
      tr("dF/dδ of the law at once where the force first reaches 1 N; – where it does not") },
    { tr("Energy [mJ]"), tr("Work of the law's force on the way to the largest depth") },
    { tr("Place [mm]"), tr("Of the deepest contact, in the frame of the surface") },
    { tr("Validity"), tr("Limits of the law that the deepest contact is beyond") },
    { tr("Organ"), tr("That was pressed") }
  };
  rows_->setColumnCount(columns.size());
  for (int i = 0; i < columns.size(); ++i)
  {
    rows_->headerItem()->setText(i, columns[i].title);
    rows_->headerItem()->setToolTip(i, columns[i].what);
  }
  rows_->setRootIsDecorated(false);
  rows_->setUniformRowHeights(true);
  rows_->setSelectionMode(QAbstractItemView::ExtendedSelection);
  rows_->setEditTriggers(QAbstractItemView::EditKeyPressed | QAbstractItemView::DoubleClicked);
  rows_->setContextMenuPolicy(Qt::ActionsContextMenu);
  rows_->header()->setSectionResizeMode(QHeaderView::ResizeToContents);
  rows_->setItemDelegate(new NeverEdited(rows_));
  rows_->setItemDelegateForColumn(kName, new QStyledItemDelegate(rows_));
  connect(rows_, &QTreeWidget::itemSelectionChanged, this, &PressList::enable);
  connect(rows_, &QTreeWidget::itemSelectionChanged, this, &PressList::comparedChanged);
  connect(rows_, &QTreeWidget::itemChanged, this, [this](QTreeWidgetItem* row) { takeEdit(*row); });
}

QAction* PressList::addAction(
  const QString& text, const QString& what, const std::function<void()>& act)
{
  auto* action = new QAction(text, this);
  action->setToolTip(what);
  connect(action, &QAction::triggered, this, act);
  QWidget::addAction(action);
  rows_->addAction(action);
  auto* button = new QToolButton;
  button->setDefaultAction(action);
  button->setAutoRaise(true);
  buttons_->addWidget(button);
  return action;
}

void PressList::makeActions()
{
  makeAgain();
  compare_ = addAction(tr("Compare"),
    tr("Forces of the ticked presses over depth, and their differences from the selected one, or "
       "from the first"),
    [this] { Q_EMIT compareAsked(); });
  ofOne_.push_back(addAction(tr("Fit E"), tr("Young's modulus that this curve alone tells of"),
    [this] { Q_EMIT fitAsked(current()); }));
  delete_ = addAction(tr("Delete presses"),
    tr("Take the presses off the list; Edit > Undo brings them back"),
    [this] { Q_EMIT deleteAsked(selected()); });
  delete_->setIconText(tr("Delete")); // on its button, beside the list
  delete_->setShortcut(QKeySequence::Delete);
  delete_->setShortcutContext(Qt::WidgetWithChildrenShortcut);
  buttons_->addStretch();
}

void PressList::makeAgain()
{
  QAction* again = addAction(tr("Press again"),
    tr("Press at the same place, as deep, by the tool and the law in use"),
    [this] { Q_EMIT againAsked(current(), Again::AsNow); });
  auto* menu = new QMenu(this);
  const auto add = [&](const QString& text, Again how)
  { menu->addAction(text, this, [this, how] { Q_EMIT againAsked(current(), how); }); };
  add(tr("By its own tool and law"), Again::AsThen);
  menu->addSection(tr("in its own tissue"));
  add(tr("By the paper's law"), Again::Paper);
  add(tr("By the exact law"), Again::Exact);
  add(tr("By the corrected law"), Again::Corrected);
  menu->addSeparator();
  for (const char* tool : { "sphere:5mm", "sphere:10mm", "cone:45deg:10mm", "punch:5mm" })
  {
    menu->addAction(
      tr("With %1").arg(tool), this, [this, tool] { Q_EMIT againWithAsked(current(), tool); });
  }
  auto* button = qobject_cast<QToolButton*>(buttons_->itemAt(0)->widget());
  button->setObjectName("pressAgain");
  button->setMenu(menu);
  button->setPopupMode(QToolButton::MenuButtonPopup);
  ofOne_.push_back(again);
}

// in place, as a row may be chosen, or its name be edited
bool PressList::refresh()
{
  if (version_ == log_.version())
  {
    return false;
  }
  version_ = log_.version();
  const QSignalBlocker quiet(rows_);
  std::ranges::for_each(log_.presses(), [this](const KeptPress& press) { tickNew(press.id); });
  int at = 0;
  for (const KeptPress& press : log_.presses())
  {
    while (idAt(at) < press.id)
    {
      delete rows_->takeTopLevelItem(at);
    }
    if (idAt(at) > press.id)
    {
      rows_->insertTopLevelItem(at, new QTreeWidgetItem);
    }
    showRow(*rows_->topLevelItem(at++), press);
  }
  while (rows_->topLevelItemCount() > at)
  {
    delete rows_->takeTopLevelItem(at);
  }
  rows_->setColumnHidden(
    kOrgan, std::ranges::all_of(log_.presses(), &std::string::empty, &KeptPress::organ));
  enable();
  return true;
}

// beyond the last row, more than any
int PressList::idAt(int row) const
{
  const QTreeWidgetItem* item = rows_->topLevelItem(row);
  return item == nullptr ? std::numeric_limits<int>::max() : item->data(kName, kId).toInt();
}

void PressList::showRow(QTreeWidgetItem& row, const KeptPress& press)
{
  const QStringList cells = cellsOf(press);
  for (int i = 0; i < cells.size(); ++i)
  {
    row.setText(i, cells[i]);
    row.setToolTip(i, cells[i]);
  }
  row.setData(kName, kId, press.id);
  row.setIcon(kName, iconOf(press));
  row.setFlags(row.flags() | Qt::ItemIsEditable | Qt::ItemIsUserCheckable);
  row.setCheckState(kName, ticked_.contains(press.id) ? Qt::Checked : Qt::Unchecked);
}

void PressList::tickNew(int id)
{
  if (id <= newest_)
  {
    return;
  }
  newest_ = id;
  ticked_.insert(id);
  const auto oldest =
    std::ranges::find_if(ticked_, [this](int each) { return !byHand_.contains(each); });
  if (ticked_.size() > kTicked && oldest != ticked_.end())
  {
    ticked_.erase(oldest);
  }
}

void PressList::takeEdit(const QTreeWidgetItem& row)
{
  const int id = row.data(kName, kId).toInt();
  const bool isTicked = row.checkState(kName) == Qt::Checked;
  if (isTicked == ticked_.contains(id))
  {
    Q_EMIT renamed(id, row.text(kName).simplified());
    return;
  }
  isTicked ? void(ticked_.insert(id)) : void(ticked_.erase(id));
  isTicked ? void(byHand_.insert(id)) : void(byHand_.erase(id));
  enable();
  Q_EMIT tickedChanged();
}

std::vector<const KeptPress*> PressList::ticked() const
{
  std::vector<const KeptPress*> presses;
  for (const KeptPress& press : log_.presses())
  {
    if (ticked_.contains(press.id))
    {
      presses.push_back(&press);
    }
  }
  return presses;
}

std::vector<const KeptPress*> PressList::compared() const
{
  std::vector<const KeptPress*> presses = ticked();
  std::ranges::stable_partition(presses,
    [chosen = selected()](const KeptPress* press)
    { return std::ranges::find(chosen, press->id) != chosen.end(); });
  return presses;
}

std::vector<int> PressList::selected() const
{
  std::vector<int> ids;
  for (const QTreeWidgetItem* row : rows_->selectedItems())
  {
    ids.push_back(row->data(kName, kId).toInt());
  }
  return ids;
}

// the one that is chosen, or the newest
int PressList::current() const
{
  const std::vector<int> ids = selected();
  return !ids.empty() ? ids.front() : log_.presses().empty() ? 0 : log_.presses().back().id;
}

void PressList::enable()
{
  for (QAction* action : ofOne_)
  {
    action->setEnabled(selected().size() < 2 && current() != 0);
  }
  compare_->setEnabled(ticked().size() > 1);
  delete_->setEnabled(!selected().empty());
}

} // namespace palp
