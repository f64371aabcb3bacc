#include "app/panels/law_panel.h"

#include "app/input/coating_text.h"
#include "app/input/law_options.h"
#include "app/panels/panel_boxes.h"
#include "haptics/error.h"

#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>

#include <utility>

namespace palp
{
namespace
{

// what a box shows, whose entries are in the order of the enumeration
template <typename Enum>
Enum shownIn(const ChoiceBox& box)
{
  return static_cast<Enum>(box.currentIndex());
}

} // namespace

LawPanel::LawPanel(const LawSettings& inUse, bool rated, QWidget* parent)
  : QGroupBox(tr("Law"), parent)
  , rated_(rated)
  , mode_(new ChoiceBox("law", { tr("Paper"), tr("Exact half-space"), tr("Corrected") }))
  , base_(new ChoiceBox("base", { tr("Unset"), tr("Bonded"), tr("Slip") }))
  , constitution_(new ChoiceBox("material", { tr("Linear"), tr("Neo-Hookean") }))
  , coatings_(new QLineEdit)
{
  mode_->setToolTip(tr("Paper: Eqs. (2)-(5)\nExact half-space: the linear solution for every tool\n"
                       "Corrected: thickness, curvature, tilt and large strain, where they act"));
  base_->setAccessibleName(tr("Base"));
  constitution_->setAccessibleName(tr("Material"));
  base_->setToolTip(
    tr("What the body lies on; acts where it is thin. Unset is answered as bonded, and flagged "
       "where a free part of the body would bend"));
  constitution_->setToolTip(tr("Acts under large strain of spheres and cones"));
  coatings_->setObjectName("coatings");
  coatings_->setPlaceholderText(tr("e.g. 2mm:200kPa:0.45"));
  coatings_->setToolTip(
    tr("Skin, fat, a capsule from the surface down: thickness, Young's modulus "
       "and Poisson's ratio of each, with commas between; for the corrected law"));
  QGridLayout& rows = *makeRows(*this);
  addRow(rows, tr("Force law"), mode_);
  addRow(rows, tr("Base, material"), makePair());
  addRow(rows, tr("Coatings"), coatings_);
  reason_ = addReason(rows, *coatings_);
  setSettings(inUse);

  for (ChoiceBox* box : { mode_, base_, constitution_ })
  {
    connect(box, qOverload<int>(&QComboBox::currentIndexChanged), this,
      [this]
      {
        showWhatActs();
        Q_EMIT lawChanged();
      });
  }
  connect(coatings_, &QLineEdit::editingFinished, this, &LawPanel::takeCoatings);
}

// also comes when the field is left as it was
void LawPanel::takeCoatings()
{
  if (coatings_->isModified())
  {
    coatings_->setModified(false);
    const std::string before = std::exchange(coating_, coatings_->text().remove(' ').toStdString());
    try
    {
      (void)parseCoatings(coating_, tr("Coatings").toStdString());
      check_();
    }
    catch (const Error& error)
    {
      coating_ = before;
      showReason(*reason_, *coatings_, QString::fromStdString(error.what()));
      return;
    }
    showReason(*reason_, *coatings_, {});
    showWhatActs();
    Q_EMIT lawChanged();
  }
}

void LawPanel::setCheck(std::function<void()> check)
{
  check_ = std::move(check);
}

// both are short, and the panel is high
QWidget* LawPanel::makePair()
{
  auto* pair = new QWidget;
  auto* row = new QHBoxLayout(pair);
  row->setContentsMargins(0, 0, 0, 0);
  row->addWidget(base_);
  row->addWidget(constitution_, 1);
  return pair;
}

LawSettings LawPanel::settings() const
{
  const std::string coating = isCorrected() ? coating_ : "";
  LawOptions options{ .mode = shownIn<LawMode>(*mode_),
    .base = shownIn<Base>(*base_),
    .constitution = shownIn<ConstitutiveModel>(*constitution_),
    .coatings = parseCoatings(coating),
    .relaxation = isCorrected() ? inUse_.relaxation : PronySeries{},
    .friction = isCorrected() ? inUse_.friction : 0.0,
    .rated = rated_ };
  const bool same = options.mode == inUse_.mode && coating == describeCoatings(inUse_.coatings) &&
    options.base == inUse_.base && options.constitution == inUse_.constitution;
  if (same)
  {
    return inUse_; // reads no table again
  }
  return options.settings();
}

void LawPanel::setSettings(const LawSettings& inUse)
{
  inUse_ = inUse;
  mode_->show(static_cast<int>(inUse.mode));
  base_->show(static_cast<int>(inUse.base));
  constitution_->show(static_cast<int>(inUse.constitution));
  const std::string coating = describeCoatings(inUse.coatings);
  // the other laws know none, and the text may be wanted again, as that which was refused
  if (inUse.mode == LawMode::Corrected && (coating != coating_ || reason_->text().isEmpty()))
  {
    coating_ = coating;
    coatings_->setText(QString::fromStdString(coating));
    coatings_->setCursorPosition(0); // the uppermost is seen first
    showReason(*reason_, *coatings_, {});
  }
  showWhatActs();
}

bool LawPanel::isCorrected() const
{
  return shownIn<LawMode>(*mode_) == LawMode::Corrected;
}

void LawPanel::showWhatActs()
{
  const bool corrected = isCorrected();
  base_->setEnabled(corrected);
  constitution_->setEnabled(corrected);
  // kept for the corrected law, and to be taken out where that refuses them
  coatings_->setEnabled(corrected || !coatings_->text().isEmpty());
}

} // namespace palp
