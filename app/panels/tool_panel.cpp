#include "app/panels/tool_panel.h"

#include "app/panels/panel_boxes.h"
#include "haptics/error.h"
#include "haptics/tip/profile.h"
#include "haptics/units.h"

#include <QFileDialog>
#include <QFileInfo>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QSignalBlocker>
#include <QToolButton>

#include <utility>

namespace palp
{
namespace
{

using namespace units::literals;

static_assert(ToolPanel::KindCount == std::variant_size_v<Tip>);

bool isConical(int kind)
{
  return kind == ToolPanel::Cone || kind == ToolPanel::TruncatedCone ||
    kind == ToolPanel::BluntCone;
}

QuantityBox* makeLength(const char* name)
{
  return new QuantityBox(name, ShownUnit::millimeters());
}

} // namespace

ToolPanel::ToolPanel(const Tip& tip, QWidget* parent)
  : QGroupBox(tr("Tool"), parent)
  , rows_(makeRows(*this))
  , kind_(new ChoiceBox("kind",
      { tr("Sphere"), tr("Cone"), tr("Flat punch"), tr("Truncated cone"), tr("Blunt cone"),
        tr("Paraboloid"), tr("Profile from a file…") }))
  , radius_(makeLength("radius"))
  , halfAngle_(new QuantityBox("halfAngle", ShownUnit::degrees()))
  , flatRadius_(makeLength("flatRadius"))
  , tipRadius_(makeLength("tipRadius"))
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
    box->setCheck([this] { (void)checkedTip(this->tip()); });
    connect(box, &QuantityBox::changed, this, &ToolPanel::toolChanged);
  }
}

void ToolPanel::addFields()
{
  kind_->setToolTip(
    tr("What touches the tissue; each has its own force law F(\u03b4): Eqs. (2)-(4) of the "
       "sphere, Eq. (5) of the cone"));
  radius_->setToolTip(tr("R [mm], more than 0: of the sphere, F = 4/3 E/(1 - \u03bd\u00b2) \u221aR "
                         "\u03b4^1.5, Eq. (2), or "
                         "of the base of the others"));
  fileName_->setToolTip(tr("Profile of the tool, a CSV file"));
  fileName_->setAccessibleName(tr("Profile of the tool"));
  halfAngle_->setToolTip(tr("\u03b1 [\u00b0], 0 to 90: between the axis of the cone and its flank; "
                            "F = 2/\u03c0 E/(1 - \u03bd\u00b2) tan \u03b1 \u03b4\u00b2, Eq. (5)"));
  flatRadius_->setToolTip(tr("b [mm], 0 to less than R: of the flat that the cone is cut off to"));
  tipRadius_->setToolTip(
    tr("R_t [mm], 0 to less than R: of the spherical cap in which the cone ends"));

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
  showFields();
  fitTip();
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

// a flat or a cap that was meant for a wider base would refuse the shape as a whole
void ToolPanel::fitTip()
{
  constexpr double kFraction = 0.5;
  const int kind = kind_->currentIndex();
  if (kind != TruncatedCone && kind != BluntCone)
  {
    return;
  }
  try
  {
    (void)checkedTip(tip());
  }
  catch (const Error&)
  {
    QuantityBox* end = kind == TruncatedCone ? flatRadius_ : tipRadius_;
    end->setSi(kFraction * radius_->si());
    Q_EMIT end->refused(tr("Wider than the base before; half of the base is taken."));
  }
}

void ToolPanel::showFields()
{
  const int kind = kind_->currentIndex();
  for (const auto& [box, shown] :
    { std::pair(radius_, kind != FromFile), { halfAngle_, isConical(kind) },
      { flatRadius_, kind == TruncatedCone }, { tipRadius_, kind == BluntCone } })
  {
    setRowVisible(*rows_, box, shown);
    if (!shown)
    {
      box->forget();
    }
  }
  setRowVisible(*rows_, file_, kind == FromFile);
  setLabel(*rows_, radius_, isConical(kind) ? tr("Base radius") : tr("Radius"));
  showProfile();
}

void ToolPanel::showProfile()
{
  const QString path = !asked_.isEmpty() ? asked_
    : profile_ != nullptr                ? QString::fromStdString(profile_->name())
                                         : QString();
  fileName_->setText(QFileInfo(path).fileName());
  if (!path.isEmpty())
  {
    fileName_->setToolTip(path);
  }
  fileName_->setCursorPosition(0);
}

} // namespace palp
