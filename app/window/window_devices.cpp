// Which device moves the tool.

#include "app/panels/device_panel.h"
#include "app/shell/hold_key.h"
#include "app/window/window.h"

#include <QAction>
#include <QDialog>
#include <QMenuBar>

namespace palp
{
namespace
{

constexpr const char* kScan = "Scan for devices…";

// the one in use first
QStringList deviceNames(const Session& session, const std::vector<std::string>& others)
{
  QStringList names{ QString::fromStdString(session.recording().device) };
  for (const std::string& name : others)
  {
    names << QString::fromStdString(name);
  }
  names.removeDuplicates();
  return names;
}

} // namespace

void Window::offerDevices()
{
  const std::vector<std::string> found = Session::devices();
  const QStringList names = deviceNames(session_, found);
  QStringList others = names;
  others.removeAll("mouse");
  others.removeAll("hand");
  devicePanel_->offer(names + QStringList(tr(kScan)), others);
  tellDevices();
  say(others.isEmpty() ? tr("No device found that can be used; palp devices tells why")
                       : tr("Devices: %1").arg(others.join(", ")));
}

void Window::tellDevices()
{
  const Recording& now = session_.recording();
  devicePanel_->choose(QString::fromStdString(now.device),
    QString::fromStdString(now.second ? now.second->device : ""));
}

void Window::applyDevice(const QString& name)
{
  const bool scans = name == tr(kScan) && isFree();
  scans ? offerDevices()
        : changeDevice([&] { session_.useDevice(parseDevice(name.toStdString())); });
}

void Window::changeDevice(const std::function<void()>& change)
{
  const auto names = [this]
  {
    const Recording& now = session_.recording();
    return std::pair(now.device, now.second ? now.second->device : "");
  };
  const auto before = names();
  const bool isUsed = isFree() && attempt(change);
  tellDevices();
  if (isUsed || names() != before)
  {
    applyTissue(); // what is stable depends on the devices
  }
}

void Window::makeDevicePanel()
{
  // nobody looks at the USB until the user wants a device from there
  devicePanel_ = new DevicePanel(deviceNames(session_, { "mouse", "hand" }) << tr(kScan));
  tellDevices();
  connect(devicePanel_, &DevicePanel::deviceChanged, this, &Window::applyDevice);
  connect(devicePanel_, &DevicePanel::secondChanged, this,
    [this](const QString& name)
    {
      changeDevice(
        [&]
        {
          const auto choice =
            name.isEmpty() ? std::nullopt : std::optional(parseDevice(name.toStdString()));
          session_.useSecond(choice);
        });
    });
  connect(devicePanel_, &DevicePanel::scaleChanged, this,
    [this](double scale) { changeDevice([&] { session_.scaleDevice(scale); }); });
  connect(devicePanel_, &DevicePanel::lagAsked, this,
    [this](bool lags)
    {
      isFree() ? void(attempt([&] { session_.lag(lags); })) : void();
      say(session_.lags()
          ? tr("The tool lags where the tissue is stiff: half as deep as asked on a "
               "thick body of this tissue, a quarter where it is twice as stiff")
          : tr("The tool goes as deep as it is asked"));
    });
  connect(devicePanel_, &DevicePanel::stopAsked, this, [this] { session_.stop(true); });
  connect(devicePanel_, &DevicePanel::armAsked, this,
    [this](bool armed)
    {
      session_.stop(false);
      session_.arm(armed);
    });
}

void Window::makeDeviceMenu()
{
  QMenu* device = menuBar()->addMenu(tr("&Device"));
  QAction* stop = device->addAction(
    tr("&Stop the force"), this,
    [this]
    {
      queued_.clear();
      letGo();
      session_.stop(true);
      endReview();
      for (auto* sheet : findChildren<QDialog*>()) // which this key closes, too
      {
        sheet->isVisible() ? sheet->reject() : void();
      }
    },
    QKeySequence(Qt::Key_Escape));
  stop->setShortcutContext(Qt::ApplicationShortcut); // wherever the focus is
  new HoldKey(Qt::Key_C, *this, [this](bool isHeld) { session_.holdTools(isHeld); });
  device->addAction(
    tr("S&can for devices"), this, [this] { offerDevices(); }, QKeySequence::Refresh);
  QAction* turn = device->addAction(tr("&Turn the device to the view"), this,
    [this]
    {
      const CameraPlace place = cameraPlace();
      Eigen::Matrix3d seen;
      seen.col(1) = (place.focus - place.position).normalized();
      seen.col(0) = seen.col(1).cross(place.up).normalized();
      seen.col(2) = seen.col(0).cross(seen.col(1));
      const bool turned = isFree() && session_.turnDevice(seen);
      say(turned ? tr("Right, up and away at the device are those of the picture; arm it anew")
                 : tr("This device follows the picture, or moves by itself"));
    });
  turn->setObjectName("turn-device");
  turn->setToolTip(tr("What is right, up and away in the picture is so at the device"));
  QAction* sound = device->addAction(tr("&Hear the force"));
  sound->setObjectName("sound");
  sound->setCheckable(true);
  sound->setToolTip(tr("A tone of 220 Hz at 0.1 N, an octave higher at four times the force"));
  device->setToolTipsVisible(true);
  connect(sound, &QAction::triggered, this,
    [this, sound](bool isOn)
    {
      sound->setChecked(isOn && sound_.start());
      sound->isChecked() ? void() : sound_.stop();
      const bool isMissing = isOn && !sound->isChecked();
      isMissing
        ? message_->warn(tr("No sound output is there; connect one, then turn this on again"))
        : say(isOn ? tr("The pitch tells the force: an octave is four times as much")
                   : tr("The force is not heard"));
    });
}

} // namespace palp
