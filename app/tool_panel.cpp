#include "app/tool_panel.h"

#include "app/panel_boxes.h"
#include "haptics/force/profile.h"
#include "haptics/units.h"

#include <QFileDialog>
#include <QFileInfo>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QSignalBlocker>
#include <QToolButton>

#include <cmath>

namespace palp
{
namespace
{

using namespace units::literals;

static_assert(ToolPanel::KindCount == std::variant_size_v<Tip>);

constexpr double kSmallest = 0.001; // of a flat or of a spherical tip [mm]

bool isConical(int kind)
{
  return kind == ToolPanel::Cone || kind == ToolPanel::TruncatedCone ||
    kind == ToolPanel::BluntCone;
}

QuantityBox* makeLength(const char* name, double lowMm)
{
  return new QuantityBox(name, ShownUnit::millimetres(), 3, lowMm, 1000.0);
}

} // namespace

ToolPanel::ToolPanel(const Tip& tip, QWidget* parent)
  : QGroupBox(tr("Tool"), parent)
  , rows_(makeRows(*this))
  , kind_(new ChoiceBox("kind",
      { tr("Sphere"), tr("Cone"), tr("Flat punch"), tr("Truncated cone"), tr("Blunt cone"),
        tr("Paraboloid"), tr("Profile from a file…") }))
  , radius_(makeLength("radius", 0.1))
  , halfAngle_(new QuantityBox("halfAngle", ShownUnit::degrees(), 2, 1.0, 89.0))
  , flatRadius_(makeLength("flatRadius", kSmallest))
  , tipRadius_(makeLength("tipRadius", kSmallest))
  , fileName_(new QLineEdit)
  , file_(makeFile())
{
  addFields();
  halfAngle_->setSi(45.0_deg);
  flatRadius_->setSi(2.0_mm);
  tipRadius_->setSi(0.3_mm);
  setTip(tip);

  connect(kind_, qOverload<int>(&QComboBox::currentIndexChanged), this, &ToolPanel::choose);
  for (QuantityBox* box : { radius_, halfAngle_, flatRadius_, tipRadius_ })
  {
    connect(box, qOverload<double>(&QDoubleSpinBox::valueChanged), this,
      [this]
      {
        fitRanges();
        Q_EMIT toolChanged();
      });
  }
}

void ToolPanel::addFields()
{
  halfAngle_->setToolTip(tr("Angle between the axis of the cone and its flank"));
  flatRadius_->setToolTip(tr("Of the flat that the cone is cut off to"));
  tipRadius_->setToolTip(tr("Of the spherical cap in which the cone ends"));

  addRow(*rows_, tr("Shape"), kind_);
  addRow(*rows_, tr("Radius"), radius_);
  addRow(*rows_, tr("Half-angle α"), halfAngle_);
  addRow(*rows_, tr("Flat radius"), flatRadius_);
  addRow(*rows_, tr("Tip radius"), tipRadius_);
  addRow(*rows_, tr("File"), file_);
}

QWidget* ToolPanel::makeFile()
{
  fileName_->setObjectName("profile");
  fileName_->setReadOnly(true);
  auto* open = new QToolButton;
  open->setText(tr("Open…"));
  open->setToolTip(tr("CSV with the columns radius_mm,height_mm from the apex to the base"));
  connect(open, &QToolButton::clicked, this, &ToolPanel::chooseFile);
  auto* file = new QWidget;
  auto* row = new QHBoxLayout(file);
  row->setContentsMargins(0, 0, 0, 0);
  row->addWidget(fileName_, 1);
  row->addWidget(open);
  return file;
}

Tip ToolPanel::tip() const
{
  switch (kind_->currentIndex())
  {
    case Sphere:
      return SphereTip{ .radius = radius_->si() };
    case Cone:
      return ConeTip{ .halfAngle = halfAngle_->si(), .baseRadius = radius_->si() };
    case Punch:
      return PunchTip{ .radius = radius_->si() };
    case TruncatedCone:
      return TruncatedConeTip{
        .halfAngle = halfAngle_->si(), .flatRadius = flatRadius_->si(), .baseRadius = radius_->si()
      };
    case BluntCone:
      return BluntConeTip{
        .halfAngle = halfAngle_->si(), .tipRadius = tipRadius_->si(), .baseRadius = radius_->si()
      };
    case Paraboloid:
      return ParaboloidTip{ .radius = radius_->si() };
    default:
      return ProfileTip{ asked_.isEmpty()
          ? profile_
          : std::make_shared<const Profile>(Profile::read(asked_.toStdString())) };
  }
}

void ToolPanel::setTip(const Tip& tip)
{
  inUse_ = tip;
  asked_.clear();
  if (const auto* fromFile = std::get_if<ProfileTip>(&tip))
  {
    profile_ = fromFile->profile;
  }
  kind_->show(static_cast<int>(tip.index()));
  radius_->setSi(baseRadius(tip));
  std::visit(
    [this](const auto& shape)
    {
      if constexpr (requires { shape.halfAngle; })
      {
        halfAngle_->setSi(shape.halfAngle);
      }
      fitRanges();
      if constexpr (requires { shape.flatRadius; })
      {
        flatRadius_->setSi(shape.flatRadius);
      }
      if constexpr (requires { shape.tipRadius; })
      {
        tipRadius_->setSi(shape.tipRadius);
      }
    },
    tip);
  showFields();
}

void ToolPanel::askForProfile(const QString& file)
{
  asked_ = file;
  kind_->show(FromFile);
  showFields();
  Q_EMIT toolChanged();
}

void ToolPanel::choose(int kind)
{
  if (kind == FromFile && profile_ == nullptr)
  {
    chooseFile();
    return;
  }
  fitRanges();
  showFields();
  Q_EMIT toolChanged();
}

void ToolPanel::chooseFile()
{
  const QString file = QFileDialog::getOpenFileName(
    this, tr("Open profile of a tool"), {}, tr("Profiles (*.csv);;All files (*)"));
  if (file.isEmpty())
  {
    setTip(inUse_);
    return;
  }
  askForProfile(file);
}

// so that what can be typed is a tool: a flat and a cap are narrower than the base. Only for the
// shape shown, so that the others keep what was typed.
void ToolPanel::fitRanges()
{
  constexpr double kNarrower = 0.999;
  const auto highest = [](double mm) { return std::floor(1e3 * mm) / 1e3; };
  const int kind = kind_->currentIndex();
  const QSignalBlocker quiet[]{ QSignalBlocker(flatRadius_), QSignalBlocker(tipRadius_) };
  if (kind == TruncatedCone)
  {
    flatRadius_->setMaximum(highest(kNarrower * radius_->value()));
  }
  else if (kind == BluntCone)
  {
    tipRadius_->setMaximum(highest(kNarrower * radius_->value() / std::cos(halfAngle_->si())));
  }
}

void ToolPanel::showFields()
{
  const int kind = kind_->currentIndex();
  setRowVisible(*rows_, radius_, kind != FromFile);
  setRowVisible(*rows_, halfAngle_, isConical(kind));
  setRowVisible(*rows_, flatRadius_, kind == TruncatedCone);
  setRowVisible(*rows_, tipRadius_, kind == BluntCone);
  setRowVisible(*rows_, file_, kind == FromFile);
  labelOf(*rows_, radius_)->setText(isConical(kind) ? tr("Base radius") : tr("Radius"));
  showProfile();
}

void ToolPanel::showProfile()
{
  const QString path = !asked_.isEmpty() ? asked_
    : profile_ != nullptr                ? QString::fromStdString(profile_->name())
                                         : QString();
  fileName_->setText(QFileInfo(path).fileName());
  fileName_->setToolTip(path);
  fileName_->setCursorPosition(0);
}

} // namespace palp
