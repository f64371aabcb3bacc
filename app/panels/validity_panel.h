#pragma once

#include "haptics/force/validity.h"

#include <QLabel>

namespace palp
{

/// How far to rely on what is shown: the law's conditions at this place.
class ValidityPanel : public QLabel
{
  Q_OBJECT

public:
  explicit ValidityPanel(QWidget* parent = nullptr);

  /// Green, amber from 80 % of a limit, red where it is passed; the worst first.
  void showRules(const Rules& rules);
  void showNoContact();
};

} // namespace palp
