#include "app/panels/device_panel.h"

#include "app/session/device_words.h"
#include "haptics/units.h"
#include "pipeline/view/appearance.h"

#include <QCheckBox>
#include <QColor>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QEvent>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QSignalBlocker>

#include <cmath>
#include <utility>

namespace palp
{
namespace
{

QLabel* addLabel(QFormLayout* form, const QString& title, const char* name)
{
  auto* label = new QLabel;
  label->setObjectName(name);
  label->setWordWrap(true);
  label->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred); // the panel keeps its width
  label->setTextFormat(Qt::RichText);
  form->addRow(title, label);
  return label;
}

QString colored(const appearance::Color& color, const QString& text)
{
  return QStringLiteral("<span style='color:%1'>%2</span>")
    .arg(QColor::fromRgbF(color[0], color[1], color[2]).name(), text);
}

// with a name that it may not have had
void select(QComboBox& list, const QString& name)
{
  const QSignalBlocker quiet(&list);
  if (list.findText(name) < 0)
  {
    list.addItem(name);
  }
  list.setCurrentText(name);
}

// of a row that can be away with its title
void showRow(QWidget& field, bool shown)
{
  auto* form = qobject_cast<QFormLayout*>(field.parentWidget()->layout());
  form->labelForField(&field)->setVisible(shown);
  field.setVisible(shown);
}

// a dot as in traffic: may a hand feel something?
QString stateText(const Sample& sample)
{
  constexpr appearance::Color kOff{ 0.5, 0.5, 0.5 };
  const bool off = sample.state == DeviceState::Ready || sample.state == DeviceState::Opening;
  const appearance::Color& color = isFault(sample.state, sample.flags) ? appearance::kBad
    : sample.state == DeviceState::Active                              ? appearance::kGood
    : off                                                              ? kOff
                                                                       : appearance::kDoubtful;
  QString text = colored(color, QStringLiteral("●")) + " <b>" + describe(sample.state) + "</b>";
  if (isFault(sample.state, sample.flags))
  {
    text += "<br>" + QString::fromStdString(describeFlags(sample.flags));
  }
  const QString advice = advise(sample.state, sample.flags);
  return advice.isEmpty() ? text : text + "<br>" + advice;
}

QString handText(bool renders, const Sample& sample)
{
  return renders ? stateText(sample) : DevicePanel::tr("Display only: no force feedback");
}

QString forceText(bool renders, const Sample& sample)
{
  const QString model = DevicePanel::tr("model %1 N").arg(sample.response.force, 0, 'f', 2);
  return renders ? DevicePanel::tr("%1, sent %2 N").arg(model).arg(sample.force.norm(), 0, 'f', 2)
                 : model;
}

// of each hand, where there are two
template <typename Text>
QString ofHands(const Session& session, const Sample& first, const Sample* second, Text text,
  const char* lineBreak)
{
  const QString one = text(session.rendersForce(0), first);
  return second == nullptr
    ? one
    : "1: " + one + lineBreak + "2: " + text(session.rendersForce(1), *second);
}

} // namespace

DevicePanel::DevicePanel(const QStringList& devices, QWidget* parent)
  : QWidget(parent)
  , device_(new QComboBox)
  , second_(new QComboBox)
  , scale_(new QDoubleSpinBox)
  , lag_(new QCheckBox(tr("Tool lags where it is stiff")))
  , arm_(new QPushButton(tr("Turn force on")))
  , stop_(new QPushButton(tr("STOP (Esc)")))
{
  auto* form = new QFormLayout(this);
  form->setContentsMargins(8, 2, 8, 2);
  form->setVerticalSpacing(2);
  device_->setObjectName("device");
  device_->addItems(devices);
  for (QComboBox* list : { device_, second_ }) // of which the path of a file would widen the panel
  {
    list->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  }
  form->addRow(tr("Input device"), device_);
  addPlaces(*form);

  lag_->setObjectName("lag");
  lag_->setToolTip(tr(
    "Stiffness for the eye: the tool goes half as deep as asked on a thick body "
    "of the tissue in use when this is switched on, a quarter as deep where it is twice as stiff, "
    "and all the way where it is half as stiff or softer"));
  form->addRow(lag_);
  lag_->hide(); // it takes the place of the buttons where there is no force

  arm_->setObjectName("arm");
  arm_->setCheckable(true);
  arm_->setToolTip(tr("Off until you turn it on"));
  device_->setToolTip(tr("What moves the tool; a haptic device also pushes back"));
  device_->setAccessibleName(tr("Input device"));
  stop_->setObjectName("stop");
  stop_->setToolTip(tr("Stops the force at once; turn it on again to continue"));
  stop_->setStyleSheet("QPushButton:enabled { background: #b3261e; color: white; "
                       "font-weight: bold; padding: 4px }");
  auto* buttons = new QHBoxLayout;
  buttons->addWidget(arm_, 1);
  buttons->addWidget(stop_);
  form->addRow(buttons);

  state_ = addLabel(form, tr("State"), "state");
  force_ = addLabel(form, tr("Force"), "rendered");
  force_->setTextFormat(Qt::PlainText); // each picture has another: laid out in a tenth of the time
  limits_ = addLabel(form, tr("Limits"), "limits");
  connect(lag_, &QCheckBox::clicked, this, &DevicePanel::lagAsked);
  connect(arm_, &QPushButton::clicked, this, &DevicePanel::armAsked);
  connect(stop_, &QPushButton::clicked, this, &DevicePanel::stopAsked);
  connect(device_, &QComboBox::currentTextChanged, this, &DevicePanel::deviceChanged);
}

// what is there only with a device that is held in a hand
void DevicePanel::addPlaces(QFormLayout& form)
{
  second_->setObjectName("second-device");
  second_->setAccessibleName(tr("Second hand"));
  second_->setToolTip(tr("What another hand moves a tool of its own with, in the same body"));
  form.addRow(tr("Second hand"), second_);
  scale_->setObjectName("scale");
  scale_->setAccessibleName(tr("Scale"));
  scale_->setToolTip(tr("s [-], more than 0, 0.2 to 5: motion of the tool by that of the hand; a "
                        "newton stays one. While C is held the tool stays and the hand goes on"));
  scale_->setRange(1.0 / DevicePlacement::kLargestScale, DevicePlacement::kLargestScale);
  scale_->setSingleStep(0.1);
  scale_->setKeyboardTracking(false);
  form.addRow(tr("Scale"), scale_);
  showRow(*second_, false);
  showRow(*scale_, false);
  second_->addItem(tr("none"));
  connect(second_, &QComboBox::currentTextChanged, this,
    [this](const QString& name) { Q_EMIT secondChanged(name == tr("none") ? QString() : name); });
  connect(
    scale_, qOverload<double>(&QDoubleSpinBox::valueChanged), this, &DevicePanel::scaleChanged);
}

void DevicePanel::changeEvent(QEvent* event)
{
  QWidget::changeEvent(event);
  if (event->type() == QEvent::PaletteChange)
  {
    const QString sheet = stop_->styleSheet(); // which keeps the colors that it was made with
    stop_->setStyleSheet({});
    stop_->setPalette({});
    stop_->setStyleSheet(sheet);
  }
}

void DevicePanel::offer(const QStringList& devices, const QStringList& second)
{
  for (const auto& [list, names] : { std::pair(device_, devices), std::pair(second_, second) })
  {
    const QSignalBlocker quiet(list);
    const QString current = list->currentText();
    list->clear();
    list->addItems(names);
    select(*list, current);
  }
}

void DevicePanel::choose(const QString& device, const QString& second)
{
  select(*device_, device);
  select(*second_, second.isEmpty() ? tr("none") : second);
  showRow(*second_, second_->count() > 1);
}

void DevicePanel::show(
  const Session& session, const Sample& sample, const Sample* second, std::uint32_t acting)
{
  const bool renders = session.rendersForce();
  const QSignalBlocker quiet(scale_);
  showRow(*scale_, session.isPlaced());
  scale_->hasFocus() ? void() : scale_->setValue(session.scale());
  lag_->setEnabled(!renders && session.scripted() == nullptr);
  arm_->setVisible(renders); // what the device cannot do takes no room
  stop_->setVisible(renders);
  lag_->setVisible(!renders);
  lag_->setChecked(session.lags());
  arm_->setEnabled(renders);
  arm_->setChecked(renders && session.armed());
  arm_->setText(renders && session.armed() ? tr("Turn force off") : tr("Turn force on"));
  stop_->setEnabled(renders);
  state_->setText(ofHands(session, sample, second, handText, "<br>"));
  force_->setText(ofHands(session, sample, second, forceText, "\n"));

  QString text = tr("%1 N").arg(session.largestForce(), 0, 'g', 3);
  if (renders)
  {
    const double stiffest = units::toNewtonsPerMillimeter(session.stableStiffness());
    text += tr(" and %1 N/mm").arg(stiffest, 0, 'g', 3);
  }
  const bool isSecondFaulty = second != nullptr && isFault(second->state, second->flags);
  if (!isFault(sample.state, sample.flags) && !isSecondFaulty)
  {
    const std::string names = describeFlags(acting);
    text += names.empty() ? QString()
                          : "<br>" + colored(appearance::kDoubtful, QString::fromStdString(names));
  }
  limits_->setText(text);
}

} // namespace palp
