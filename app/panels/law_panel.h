#pragma once

#include "haptics/force/force_law.h"

#include <QGroupBox>

#include <functional>
#include <string>

class QLabel;
class QLineEdit;

namespace palp
{

class ChoiceBox;

/// The law and what its corrections take into account; says when any of it changed.
class LawPanel : public QGroupBox
{
  Q_OBJECT

public:
  /// @param inUse  settings of the law
  /// @param rated  as in LawOptions
  LawPanel(const LawSettings& inUse, bool rated, QWidget* parent = nullptr);

  /// What coatings have to pass before they are in use; throws Error.
  void setCheck(std::function<void()> check);

  /// As the fields say.
  /// @throws Error  as LawOptions::settings
  [[nodiscard]] LawSettings settings() const;

  /// Shows the law in use, without a signal.
  void setSettings(const LawSettings& inUse);

Q_SIGNALS:
  void lawChanged();

private:
  [[nodiscard]] QWidget* makePair();
  [[nodiscard]] bool isCorrected() const;
  void showWhatActs();
  void takeCoatings();

  LawSettings inUse_;
  bool rated_;
  ChoiceBox* mode_;
  ChoiceBox* base_;
  ChoiceBox* constitution_;
  QLineEdit* coatings_;
  QLabel* reason_;      // why coatings are refused
  std::string coating_; // last taken
  std::function<void()> check_;
};

} // namespace palp
