#pragma once

#include "haptics/force/validity.h"

#include <QLabel>

#include <span>

namespace palp
{

/// How far to rely on what is shown: the law's conditions at this place.
class ValidityPanel : public QLabel
{
  Q_OBJECT

public:
  explicit ValidityPanel(QWidget* parent = nullptr);

  /// Green, amber from 80 % of a limit, red where it is passed; the worst first.
  /// @param contrasts  of each nodule with the tissue, as NoduleField::contrasts; they come first
  void showRules(std::span<const Rule> rules, std::span<const double> contrasts = {});
  void showNoContact();
};

} // namespace palp
