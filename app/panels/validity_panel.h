#pragma once

#include "haptics/force/validity.h"
#include "haptics/servo/timing.h"

#include <QWidget>

class QLabel;

namespace palp
{

/// How far to rely on what is shown: the law's conditions at this place, the servo's punctuality.
class ValidityPanel : public QWidget
{
  Q_OBJECT

public:
  explicit ValidityPanel(QWidget* parent = nullptr);

  /// Green, amber from 80 % of a limit, red where it is passed; the worst first.
  void showRules(const Rules& rules);
  void showNoContact();
  void showTiming(const Timing& timing, const std::string& schedule);

private:
  QLabel* rules_;
  QLabel* timing_;
};

} // namespace palp
