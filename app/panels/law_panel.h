#pragma once

#include "haptics/force/force_law.h"

#include <QGroupBox>

#include <array>
#include <functional>
#include <string>

class QGridLayout;
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

  /// What coatings, relaxation and friction have to pass before they are in use; throws Error.
  void setCheck(std::function<void()> check);

  /// As the fields say.
  /// @throws Error  as LawOptions::settings
  [[nodiscard]] LawSettings settings() const;

  /// Shows the law in use, without a signal.
  void setSettings(const LawSettings& inUse);

  /// Tells of what the body has inside which only the corrected law feels.
  /// @param inside  as in "2 nodules"; empty: nothing
  void setInside(const QString& inside);

Q_SIGNALS:
  void lawChanged();

private:
  // what the corrected law takes as it is typed
  struct Text
  {
    QLineEdit* field;
    std::string (*inUse)(const LawSettings&);
    void (*check)(const std::string&); // throws Error
    QLabel* reason = nullptr;          // why it is refused
    std::string taken{};               // last
  };

  void addTexts(QGridLayout& rows);
  [[nodiscard]] bool isCorrected() const;
  [[nodiscard]] const std::string& textIn(const Text& text) const;
  void showWhatActs();
  void take(Text& text);

  LawSettings inUse_;
  bool rated_;
  ChoiceBox* mode_;
  ChoiceBox* base_;
  ChoiceBox* constitution_;
  std::array<Text, 3> texts_; // coatings, relaxation, friction
  QLabel* inside_;
  QString insideBody_;
  std::function<void()> check_;
};

} // namespace palp
