#include "app/graphs/figure_dialog.h"

#include <QCheckBox>
#include <QComboBox>
#include <QFileInfo>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QMessageBox>

namespace palp
{

FigureDialog::FigureDialog(const QString& title, const QString& suggested, const QString& kinds,
  ImageSize usual, QWidget* parent)
  : QFileDialog(parent, title)
  , sizes_(new QComboBox)
  , size_(usual)
{
  setOption(DontUseNativeDialog); // for the row of our own
  setAcceptMode(AcceptSave);
  setNameFilter(kinds);
  selectFile(suggested);
  setDefaultSuffix(QFileInfo(suggested).suffix());
  sizes_->setObjectName("size");
  sizes_->setEditable(true);
  sizes_->addItem(QString("%1x%2").arg(usual.width).arg(usual.height));
  sizes_->addItems({ "1280x960", "1920x1080", "2400x1500", "3840x2160", "7680x4320" });
  sizes_->setToolTip(tr("Width x height in pixels, each 64 to 8192"));
  auto* grid = qobject_cast<QGridLayout*>(layout());
  const int line = grid->rowCount();
  auto* label = new QLabel(tr("Size:"));
  label->setBuddy(sizes_);
  grid->addWidget(label, line, 0);
  grid->addWidget(sizes_, line, 1);
}

void FigureDialog::offerParts(const FigureLook& usual)
{
  usual_ = usual;
  auto* row = new QHBoxLayout;
  const auto add = [&](const QString& name, const char* id, bool checked, const QString& what)
  {
    auto* box = new QCheckBox(name);
    box->setObjectName(id);
    box->setToolTip(what);
    box->setChecked(checked);
    row->addWidget(box);
    return box;
  };
  overlays_ = add(tr("Overlays"), "overlays", !usual.overlays.empty(),
    tr("Arrow, circles, lines and readings that the window shows"));
  parts_ = { { add(tr("Color bar"), "colorBar", usual.hasColorBar,
                 tr("What the colors of the surface stand for")),
               &FigureLook::hasColorBar },
    { add(tr("Scale bar"), "scaleBar", usual.hasScaleBar, tr("A length, true at the contact")),
      &FigureLook::hasScaleBar },
    { add(tr("Axes"), "figureAxes", usual.hasAxes,
        tr("Directions, by the sides of a patient where they are known")),
      &FigureLook::hasAxes },
    { add(tr("Caption"), "caption", usual.hasCaption, tr("Tool, tissue, law, depth and force")),
      &FigureLook::hasCaption },
    { add(tr("Realistic"), "realistic", usual.isRealistic,
        tr("Wet surface, darker where little light comes; takes a second")),
      &FigureLook::isRealistic },
    { add(tr("Transparent"), "transparent", usual.isTransparent, tr("No background")),
      &FigureLook::isTransparent } };
  row->addStretch(1);
  auto* grid = qobject_cast<QGridLayout*>(layout());
  const int line = grid->rowCount();
  grid->addWidget(new QLabel(tr("With:")), line, 0);
  grid->addLayout(row, line, 1);
}

FigureLook FigureDialog::look() const
{
  FigureLook look = usual_;
  for (const auto& [box, part] : parts_)
  {
    look.*part = box->isChecked();
  }
  if (overlays_ != nullptr && !overlays_->isChecked())
  {
    std::erase_if(look.overlays, [](Overlay overlay) { return !isColoring(overlay); });
  }
  return look;
}

void FigureDialog::accept()
{
  try
  {
    size_ = parseSize(sizes_->currentText().trimmed().toStdString(), "size");
  }
  catch (const std::exception& error)
  {
    QMessageBox::warning(this, tr("Palp"), QString::fromStdString(error.what()));
    return;
  }
  QFileDialog::accept();
}

} // namespace palp
