#include "app/tissue_panel.h"

#include "app/tip_spec.h"
#include "haptics/units.h"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QGroupBox>
#include <QVBoxLayout>

namespace palp
{
namespace
{

enum Kind
{
  Sphere,
  Cone,
  Other
};

QDoubleSpinBox* makeBox(
  const char* name, double low, double high, double value, int decimals, const QString& unit)
{
  auto* box = new QDoubleSpinBox;
  box->setObjectName(name);
  box->setDecimals(decimals);
  box->setRange(low, high);
  box->setValue(value);
  box->setSuffix(unit.isEmpty() ? unit : " " + unit);
  box->setKeyboardTracking(false);
  return box;
}

QFormLayout* addGroup(QVBoxLayout* column, const QString& title)
{
  auto* group = new QGroupBox(title);
  auto* form = new QFormLayout(group);
  column->addWidget(group);
  return form;
}

} // namespace

TissuePanel::TissuePanel(const Scene& scene, QWidget* parent)
  : QWidget(parent)
  , settings_(scene.law.settings())
  , other_(scene.law.tip())
{
  const ForceLaw& law = scene.law;
  const auto* cone = std::get_if<ConeTip>(&law.tip());
  const bool sphere = std::holds_alternative<SphereTip>(law.tip());

  auto* column = new QVBoxLayout(this);
  QFormLayout* tool = addGroup(column, tr("Tool"));
  kind_ = new QComboBox;
  kind_->setObjectName("kind");
  kind_->addItems({ tr("Sphere"), tr("Cone") });
  if (!sphere && !cone)
  {
    kind_->addItem(QString::fromStdString(describeTip(law.tip())));
  }
  kind_->setCurrentIndex(sphere ? Sphere : cone ? Cone : Other);
  radiusMm_ =
    makeBox("radius", 0.1, 1000.0, units::toMillimetres(baseRadius(law.tip())), 2, tr("mm"));
  halfAngleDeg_ =
    makeBox("halfAngle", 1.0, 89.0, cone ? units::toDegrees(cone->halfAngle) : 45.0, 1, tr("°"));
  halfAngleDeg_->setToolTip(tr("Angle between the axis of the cone and its flank"));
  tool->addRow(tr("Shape"), kind_);
  tool->addRow(tr("Radius"), radiusMm_);
  tool->addRow(tr("Half-angle α"), halfAngleDeg_);

  QFormLayout* tissue = addGroup(column, tr("Tissue"));
  modulusKpa_ =
    makeBox("young", 0.001, 1e7, units::toKilopascals(law.material().youngModulus), 3, tr("kPa"));
  poisson_ = makeBox("poisson", 0.0, 0.5, law.material().poissonRatio, 3, {});
  damping_ = makeBox("damping", 0.0, 50.0, scene.damping, 2, tr("N·s/m"));
  rule_ = new QComboBox;
  rule_->setObjectName("rule");
  rule_->addItems({ tr("Exact, on triangles"), tr("Paper, on mesh points") });
  rule_->setCurrentIndex(scene.rule == ContactRule::Paper ? 1 : 0);
  tissue->addRow(tr("Young's modulus E"), modulusKpa_);
  tissue->addRow(tr("Poisson's ratio ν"), poisson_);
  tissue->addRow(tr("Damping"), damping_);
  tissue->addRow(tr("Contact depth"), rule_);

  column->addStretch();

  for (QDoubleSpinBox* box : { radiusMm_, halfAngleDeg_, modulusKpa_, poisson_, damping_ })
  {
    connect(
      box, qOverload<double>(&QDoubleSpinBox::valueChanged), this, &TissuePanel::tissueChanged);
  }
  for (QComboBox* list : { kind_, rule_ })
  {
    connect(
      list, qOverload<int>(&QComboBox::currentIndexChanged), this, &TissuePanel::tissueChanged);
  }
  connect(kind_, qOverload<int>(&QComboBox::currentIndexChanged), this,
    &TissuePanel::showAngleForConesOnly);
  showAngleForConesOnly();
}

void TissuePanel::showAngleForConesOnly()
{
  halfAngleDeg_->setEnabled(kind_->currentIndex() == Cone);
  radiusMm_->setEnabled(kind_->currentIndex() != Other);
}

ForceLaw TissuePanel::law() const
{
  const double radius = units::fromMillimetres(radiusMm_->value());
  Tip tip = other_;
  if (kind_->currentIndex() == Sphere)
  {
    tip = SphereTip{ .radius = radius };
  }
  else if (kind_->currentIndex() == Cone)
  {
    tip = ConeTip{ .halfAngle = units::fromDegrees(halfAngleDeg_->value()), .baseRadius = radius };
  }
  return ForceLaw(
    tip, makeMaterial(units::fromKilopascals(modulusKpa_->value()), poisson_->value()), settings_);
}

ContactRule TissuePanel::rule() const
{
  return rule_->currentIndex() == 1 ? ContactRule::Paper : ContactRule::Exact;
}

double TissuePanel::damping() const
{
  return damping_->value();
}

} // namespace palp
