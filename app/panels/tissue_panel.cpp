#include "app/panels/tissue_panel.h"

#include "app/input/quantity.h"
#include "app/panels/law_panel.h"
#include "app/panels/panel_boxes.h"
#include "app/panels/tool_panel.h"

#include <QGridLayout>
#include <QGroupBox>
#include <QVBoxLayout>

#include <algorithm>

namespace palp
{

namespace
{

QStringList titlesOf(const std::vector<TissuePreset>& presets)
{
  QStringList titles;
  for (const TissuePreset& preset : presets)
  {
    titles << QString::fromStdString(preset.title);
  }
  return titles << TissuePanel::tr("Custom");
}

QString toolTipOf(const TissuePreset& preset)
{
  const QString note = QString::fromStdString(preset.note).toHtmlEscaped();
  return "<p>" + QString::fromStdString(describeTissue(preset)).toHtmlEscaped() +
    (note.isEmpty() ? "</p>" : "</p><p>" + note + "</p>");
}

} // namespace

TissuePanel::TissuePanel(const Scene& scene, bool rated, QWidget* parent)
  : QWidget(parent)
  , tool_(new ToolPanel(scene.law.tip()))
  , law_(new LawPanel(scene.law.settings(), rated))
  , presets_(shippedTissues())
  , preset_(new ChoiceBox("tissue", titlesOf(presets_)))
  , modulus_(new QuantityBox("young", ShownUnit::kilopascals()))
  , poisson_(new QuantityBox("poisson", ShownUnit::none()))
  , damping_(new QuantityBox("damping", ShownUnit::damping()))
  , rule_(new ChoiceBox("rule", { tr("Exact, on triangles"), tr("Paper, on mesh points") }))
{
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(6, 2, 6, 2);
  column->setSpacing(2);
  column->addWidget(tool_);
  column->addWidget(makeTissue());
  column->addWidget(law_);
  column->addStretch();
  setScene(scene);

  connect(tool_, &ToolPanel::toolChanged, this, &TissuePanel::tissueChanged);
  connect(law_, &LawPanel::lawChanged, this, &TissuePanel::tissueChanged);
  law_->setCheck([this] { (void)law(); });
  connect(preset_, qOverload<int>(&QComboBox::currentIndexChanged), this, &TissuePanel::takePreset);
  for (QuantityBox* box : { modulus_, poisson_ })
  {
    connect(box, &QuantityBox::changed, this, &TissuePanel::showPreset);
  }
  for (QuantityBox* box : { modulus_, poisson_, damping_ })
  {
    box->setCheck([this] { check(); });
    connect(box, &QuantityBox::changed, this, &TissuePanel::tissueChanged);
  }
  connect(
    rule_, qOverload<int>(&QComboBox::currentIndexChanged), this, &TissuePanel::tissueChanged);
}

QGroupBox* TissuePanel::makeTissue()
{
  for (std::size_t i = 0; i < presets_.size(); ++i)
  {
    preset_->setItemData(static_cast<int>(i), toolTipOf(presets_[i]), Qt::ToolTipRole);
  }
  modulus_->setToolTip(
    tr("E [kPa], more than 0: the force is proportional to it, Eqs. (2)-(5)\nThe paper's 50 kPa, "
       "which hold at the start, are a tumor's: 7.5 times those of healthy liver"));
  poisson_->setToolTip(
    tr("\u03bd [-], 0 to less than 0.5: the force goes with 1/(1 - \u03bd\u00b2), Eq. (2)"));
  damping_->setToolTip(
    tr("b [N·s/m], 0 or more: b times the speed is added to the force, against the motion"));
  rule_->setToolTip(
    tr("Where the tool is in the tissue\nExact: on the triangles, smoothed over the "
       "contact\nPaper: the nearest vertex, Sec. 3.2"));
  auto* group = new QGroupBox(tr("Tissue"));
  QGridLayout& rows = *makeRows(*group);
  addRow(rows, tr("Measured tissue"), preset_);
  addRow(rows, tr("Young's modulus E"), modulus_);
  addRow(rows, tr("Poisson's ratio ν"), poisson_);
  addRow(rows, tr("Damping"), damping_);
  addRow(rows, tr("Contact depth"), rule_);
  return group;
}

void TissuePanel::setScene(const Scene& scene)
{
  tool_->setTip(scene.law.tip());
  law_->setSettings(scene.law.settings());
  modulus_->setSi(scene.law.material().youngModulus);
  poisson_->setSi(scene.law.material().poissonRatio);
  showPreset();
  damping_->setSi(scene.damping);
  rule_->show(scene.rule == ContactRule::Paper ? 1 : 0);
}

void TissuePanel::setInside(const QString& inside)
{
  law_->setInside(inside);
}

void TissuePanel::askForProfile(const QString& file)
{
  tool_->askForProfile(file);
}

// none of them: E and nu stay
void TissuePanel::takePreset()
{
  const auto index = static_cast<std::size_t>(preset_->currentIndex());
  if (index < presets_.size())
  {
    modulus_->setSi(presets_[index].material.youngModulus);
    poisson_->setSi(presets_[index].material.poissonRatio);
    Q_EMIT tissueChanged();
  }
  showPreset();
}

// that whose E and nu are in use
void TissuePanel::showPreset()
{
  const auto inUse = [this](const TissuePreset& preset)
  {
    return preset.material.youngModulus == modulus_->si() &&
      preset.material.poissonRatio == poisson_->si();
  };
  const auto found = std::ranges::find_if(presets_, inUse);
  preset_->show(static_cast<int>(found - presets_.begin()));
  preset_->setToolTip(found == presets_.end()
      ? tr("E and \u03bd as below; the list holds measured ones, with their sources")
      : toolTipOf(*found));
}

void TissuePanel::check() const
{
  (void)makeMaterial(modulus_->si(), poisson_->si());
  (void)checkedDamping(damping_->si(), "damping");
}

ForceLaw TissuePanel::law() const
{
  return { tool_->tip(), makeMaterial(modulus_->si(), poisson_->si()), law_->settings() };
}

ContactRule TissuePanel::rule() const
{
  return rule_->currentIndex() == 1 ? ContactRule::Paper : ContactRule::Exact;
}

double TissuePanel::damping() const
{
  return damping_->si();
}

} // namespace palp
