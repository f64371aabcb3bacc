#pragma once

#include "app/session/session.h"

#include <QWidget>

class QCheckBox;
class QComboBox;
class QLabel;
class QPushButton;

namespace palp
{

/// Who holds the tool, whether a hand may feel the force, what it feels and what limits it.
class DevicePanel : public QWidget
{
  Q_OBJECT

public:
  /// @param devices  names for the device list; the first is selected
  explicit DevicePanel(const QStringList& devices, QWidget* parent = nullptr);

  /// @param sample  the newest
  /// @param acting  flags of all samples since the last call
  void show(const Session& session, const Sample& sample, std::uint32_t acting);

  /// Offers other devices; the one that holds the tool stays selected.
  void offer(const QStringList& devices);

  /// Names the one that holds the tool; nothing is asked for.
  void choose(const QString& device);

Q_SIGNALS:
  void armAsked(bool armed);
  void stopAsked();
  void lagAsked(bool lags);
  void deviceChanged(const QString& name);

protected:
  void changeEvent(QEvent* event) override;

private:
  QComboBox* device_;
  QCheckBox* lag_;
  QPushButton* arm_;
  QPushButton* stop_;
  QLabel* state_;
  QLabel* force_;
  QLabel* limits_;
};

} // namespace palp
