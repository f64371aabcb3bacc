#include "app/panels/law_panel.h"

#include "app/input/coating_text.h"
#include "app/input/law_options.h"
#include "app/panels/panel_boxes.h"
#include "haptics/error.h"
#include "haptics/files/csv_text.h"

#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>

#include <algorithm>
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

// both are short, and the panel is high
QWidget* sideBySide(QWidget* first, QWidget* second)
{
  auto* pair = new QWidget;
  auto* row = new QHBoxLayout(pair);
  row->setContentsMargins(0, 0, 0, 0);
  row->addWidget(first);
  row->addWidget(second, 1);
  return pair;
}

void describe(
  QLineEdit& field, const char* id, const QString& name, const QString& example, const QString& tip)
{
  field.setObjectName(id);
  field.setAccessibleName(name);
  field.setPlaceholderText(example);
  field.setToolTip(tip);
}

double frictionIn(const std::string& text)
{
  return text.empty() ? 0.0 : parseFriction(text, LawPanel::tr("Friction").toStdString());
}

} // namespace

LawPanel::LawPanel(const LawSettings& inUse, bool rated, QWidget* parent)
  : QGroupBox(tr("Law"), parent)
  , rated_(rated)
  , mode_(new ChoiceBox("law", { tr("Paper"), tr("Exact half-space"), tr("Corrected") }))
  , base_(new ChoiceBox("base", { tr("Unset"), tr("Bonded"), tr("Slip") }))
  , constitution_(new ChoiceBox("material", { tr("Linear"), tr("Neo-Hookean") }))
  , texts_{ { { new QLineEdit,
                [](const LawSettings& law) { return describeCoatings(law.coatings); },
                [](const std::string& text)
                { (void)parseCoatings(text, tr("Coatings").toStdString()); } },
      { new QLineEdit, [](const LawSettings& law) { return describeRelaxation(law.relaxation); },
        [](const std::string& text)
        { (void)parseRelaxation(text, tr("Relaxation").toStdString()); } },
      { new QLineEdit,
        [](const LawSettings& law)
        { return law.friction == 0.0 ? std::string() : shortest(law.friction); },
        [](const std::string& text) { (void)frictionIn(text); } } } }
  , inside_(new QLabel)
{
  mode_->setToolTip(tr("Paper: Eqs. (2)-(5)\nExact half-space: the linear solution for every tool\n"
                       "Corrected: thickness, curvature, tilt and large strain, where they act"));
  base_->setAccessibleName(tr("Base"));
  constitution_->setAccessibleName(tr("Material"));
  base_->setToolTip(
    tr("What the body lies on; acts where it is thin. Unset is answered as bonded, and flagged "
       "where a free part of the body would bend"));
  constitution_->setToolTip(tr("Acts under large strain of spheres and cones"));
  QGridLayout& rows = *makeRows(*this);
  addRow(rows, tr("Force law"), mode_);
  addRow(rows, tr("Base, material"), sideBySide(base_, constitution_));
  addTexts(rows);
  inside_->setObjectName("inside");
  inside_->setWordWrap(true);
  inside_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred); // the panel keeps its width
  addRow(rows, tr("In the body"), inside_);
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
  for (Text& text : texts_)
  {
    connect(text.field, &QLineEdit::editingFinished, this, [this, &text] { take(text); });
  }
}

void LawPanel::addTexts(QGridLayout& rows)
{
  auto& [coatings, relaxation, friction] = texts_;
  describe(*coatings.field, "coatings", tr("Coatings"), tr("e.g. 2mm:200kPa:0.45"),
    tr("Skin, fat, a capsule from the surface down: thickness, Young's modulus "
       "and Poisson's ratio of each, with commas between; for the corrected law"));
  describe(*relaxation.field, "relaxation", tr("Relaxation"), tr("e.g. 0.3:50ms"),
    tr("Parts of the modulus that decay, and their times, with commas between, as in "
       "0.3:50ms,0.2:1s; E is the modulus of the first moment; for the corrected law"));
  describe(*friction.field, "friction", tr("Friction"), tr("\u03bc"),
    tr("Coefficient of friction \u03bc between tool and tissue, 0 to 5; no "
       "value of a liver is known; for the corrected law"));
  // as wide as others leave it: friction is short mostly, and the panel is narrow
  relaxation.field->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  friction.field->setFixedWidth(fontMetrics().horizontalAdvance("0.1234567"));
  addRow(rows, tr("Coatings"), coatings.field);
  coatings.reason = addReason(rows, *coatings.field);
  addRow(rows, tr("Friction, relaxation"), sideBySide(friction.field, relaxation.field));
  relaxation.reason = addReason(rows, *relaxation.field);
  friction.reason = addReason(rows, *friction.field);
}

// also comes when the field is left as it was
void LawPanel::take(Text& text)
{
  if (text.field->isModified())
  {
    text.field->setModified(false);
    const std::string before =
      std::exchange(text.taken, text.field->text().remove(' ').toStdString());
    try
    {
      text.check(text.taken);
      check_();
    }
    catch (const Error& error)
    {
      text.taken = before;
      showReason(*text.reason, *text.field, QString::fromStdString(error.what()));
      return;
    }
    showReason(*text.reason, *text.field, {});
    showWhatActs();
    Q_EMIT lawChanged();
  }
}

void LawPanel::setCheck(std::function<void()> check)
{
  check_ = std::move(check);
}

const std::string& LawPanel::textIn(const Text& text) const
{
  static const std::string none;
  return isCorrected() ? text.taken : none;
}

LawSettings LawPanel::settings() const
{
  const auto& [coatings, relaxation, friction] = texts_;
  const LawOptions options{ .mode = shownIn<LawMode>(*mode_),
    .base = shownIn<Base>(*base_),
    .constitution = shownIn<ConstitutiveModel>(*constitution_),
    .coatings = parseCoatings(textIn(coatings)),
    .relaxation = parseRelaxation(textIn(relaxation)),
    .friction = frictionIn(textIn(friction)),
    .rated = rated_ };
  const bool same = options.mode == inUse_.mode && options.base == inUse_.base &&
    options.constitution == inUse_.constitution &&
    std::ranges::all_of(
      texts_, [this](const Text& text) { return textIn(text) == text.inUse(inUse_); });
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
  for (Text& text : texts_)
  {
    const std::string used = text.inUse(inUse);
    // the other laws know none, and the text may be wanted again, as that which was refused
    if (inUse.mode == LawMode::Corrected && (used != text.taken || text.reason->text().isEmpty()))
    {
      text.taken = used;
      text.field->setText(QString::fromStdString(used));
      text.field->setCursorPosition(0); // the uppermost is seen first
      showReason(*text.reason, *text.field, {});
    }
  }
  showWhatActs();
}

void LawPanel::setInside(const QString& inside)
{
  insideBody_ = inside;
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
  for (const Text& text : texts_)
  {
    // kept for the corrected law, and to be taken out where that refuses them
    text.field->setEnabled(corrected || !text.field->text().isEmpty());
  }
  const bool isFelt = corrected && texts_[0].taken.empty();
  inside_->setText(
    isFelt ? insideBody_ : tr("%1: only Corrected without coatings feels it").arg(insideBody_));
  setRowVisible(static_cast<QGridLayout&>(*layout()), inside_, !insideBody_.isEmpty());
}

} // namespace palp
