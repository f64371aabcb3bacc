#pragma once

#include "haptics/servo/timing.h"

#include <QLabel>

#include <string>

namespace palp
{

/// For those who look after the machine: how punctual the servo is, and how long its steps take.
class DiagnosticsPanel : public QLabel
{
  Q_OBJECT

public:
  explicit DiagnosticsPanel(QWidget* parent = nullptr);

  /// @param schedule  of the servo's thread, in words
  void show(const Timing& timing, const std::string& schedule);
};

} // namespace palp
