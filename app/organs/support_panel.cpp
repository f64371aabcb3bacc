#include "app/organs/support_panel.h"

#include "app/input/option_values.h"
#include "app/panels/panel_boxes.h"
#include "haptics/units.h"

#include <QColor>
#include <QGridLayout>
#include <QGroupBox>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QVBoxLayout>

namespace palp
{
namespace
{

using namespace units::literals;

QPushButton* button(const QString& text, const char* name, const QString& what)
{
  auto* button = new QPushButton(text);
  button->setObjectName(name);
  button->setToolTip(what);
  button->setFocusPolicy(Qt::TabFocus); // the keys of the picture stay with it
  return button;
}

QuantityBox* length(const char* name, double usual, const QString& what)
{
  auto* box = new QuantityBox(name, ShownUnit::millimeters());
  box->setToolTip(what);
  box->setCheck(
    [box]
    {
      (void)parseWithin(quantityText(box->si(), Quantity::Length), Quantity::Length,
        { 0.1_mm, 0.1, "0.1mm to 100mm" }, box->accessibleName().toStdString());
    });
  box->setSi(usual);
  return box;
}

} // namespace

SupportPanel::SupportPanel(QWidget* parent)
  : QWidget(parent)
  , brush_(new ChoiceBox("supportBrush", { tr("Bonded"), tr("Sliding"), tr("Erase") }))
  , radius_(length("brushRadius", 8.0_mm, tr("r [mm], 0.1 to 100: of the brush")))
  , others_(new QLineEdit)
  , cell_(length("supportCell", 6.0_mm,
      tr("h [mm], 0.1 to 100: side of the cubes; half of it takes ten times as long")))
  , paint_(button(tr("Paint"), "paintSupports",
      tr("Drag in the picture, or Page Down at the tool, paints where the body rests")))
  , clear_(button(tr("Clear"), "clearSupports", tr("Take away all that is painted")))
  , solve_(button(tr("Solve…"), "solveOrgan",
      tr("Find what the whole body gives way on these supports, as an organ file")))
  , legend_(new QLabel)
{
  brush_->setToolTip(tr("Bonded: cannot move; sliding: cannot move across the surface"));
  others_->setObjectName("otherSupports");
  others_->setPlaceholderText("posterior sliding:hilum");
  others_->setToolTip(tr("Supports as text, as palp organ --support takes them, blanks between"));
  paint_->setCheckable(true);
  legend_->setObjectName("supportLegend");
  legend_->setTextFormat(Qt::RichText);
  legend_->setWordWrap(true);
  auto* group = new QGroupBox(tr("Where it rests"));
  QGridLayout& rows = *makeRows(*group);
  addRow(rows, tr("Brush"), brush_);
  addRow(rows, tr("Radius"), radius_);
  addRow(rows, tr("Also"), others_);
  addRow(rows, tr("Cell size"), cell_);
  auto* buttons = new QGridLayout;
  buttons->addWidget(paint_, 0, 0);
  buttons->addWidget(clear_, 0, 1);
  buttons->addWidget(solve_, 1, 0, 1, 2);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 2, 0, 2); // the picture wants the room
  layout->addWidget(group);
  layout->addLayout(buttons);
  layout->addWidget(legend_);
  layout->addStretch();
  connect(paint_, &QPushButton::toggled, this, &SupportPanel::paintToggled);
  connect(clear_, &QPushButton::clicked, this, &SupportPanel::clearAsked);
  connect(solve_, &QPushButton::clicked, this, &SupportPanel::solveAsked);
  connect(others_, &QLineEdit::editingFinished, this,
    [this]
    {
      const bool isNew = others_->isModified(); // the end comes twice, by Return and as it is left
      others_->setModified(false);
      isNew ? Q_EMIT othersChanged(others_->text()) : void();
    });
  showAreas({});
}

SupportPanel::Brush SupportPanel::brush() const
{
  return static_cast<Brush>(brush_->currentIndex());
}

double SupportPanel::radius() const
{
  return radius_->si();
}

double SupportPanel::cell() const
{
  return cell_->si();
}

bool SupportPanel::paints() const
{
  return paint_->isChecked();
}

void SupportPanel::endPainting()
{
  paint_->setChecked(false);
}

void SupportPanel::showOthers(const QString& supports)
{
  others_->setText(supports);
}

void SupportPanel::showAreas(const std::array<double, 2>& areas)
{
  QString text;
  for (std::size_t i = 0; i < areas.size(); ++i)
  {
    const auto& [red, green, blue] = kSupportColors.at(i);
    constexpr double kPerSquareCentimeter = 1e4;
    text += QStringLiteral("<span style=\"color:%1\">■</span> %2 %3 cm²%4")
              .arg(QColor::fromRgbF(red, green, blue).name(), i == 0 ? tr("bonded") : tr("sliding"))
              .arg(kPerSquareCentimeter * areas.at(i), 0, 'f', 1)
              .arg(i == 0 ? QStringLiteral(" &nbsp; ") : QString());
  }
  legend_->setText(text);
}

} // namespace palp
