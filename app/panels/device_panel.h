#pragma once

#include "app/session/session.h"

#include <QWidget>

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QFormLayout;
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
  /// @param second  of another hand; null: there is one
  /// @param acting  flags of all samples since the last call
  void show(
    const Session& session, const Sample& sample, const Sample* second, std::uint32_t acting);

  /// Offers other devices, and to a second hand; those that hold a tool stay selected.
  void offer(const QStringList& devices, const QStringList& second);

  /// Names the one that holds the tool, and that of a second hand, empty where there is one;
  /// nothing is asked for.
  void choose(const QString& device, const QString& second);

Q_SIGNALS:
  void armAsked(bool armed);
  void stopAsked();
  void lagAsked(bool lags);
  void deviceChanged(const QString& name);
  void secondChanged(const QString& name); ///< empty: none
  void scaleChanged(double scale);

protected:
  void changeEvent(QEvent* event) override;

private:
  void addPlaces(QFormLayout& form);

  QComboBox* device_;
  QComboBox* second_;
  QDoubleSpinBox* scale_;
  QCheckBox* lag_;
  QPushButton* arm_;
  QPushButton* stop_;
  QLabel* state_;
  QLabel* force_;
  QLabel* limits_;
};

} // namespace palp
