#pragma once

#include "haptics/tip/tip.h"

#include <QGroupBox>

class QGridLayout;
class QLineEdit;

namespace palp
{

class ChoiceBox;
class QuantityBox;

/// The tool: its shape and the dimensions that this shape has; says when any of them changed.
class ToolPanel : public QGroupBox
{
  Q_OBJECT

public:
  enum Kind ///< shapes in the order of the list and of Tip
  {
    Sphere,
    Cone,
    Punch,
    TruncatedCone,
    BluntCone,
    Paraboloid,
    FromFile,
    KindCount
  };

  explicit ToolPanel(const Tip& tip, QWidget* parent = nullptr);

  /// As the fields say.
  /// @throws Error  as Profile::read, of a file that was asked for
  [[nodiscard]] Tip tip() const;

  /// Shows the tool in use, without a signal.
  void setTip(const Tip& tip);

public Q_SLOTS:
  /// Asks for the profile in a file, which tip() then reads.
  void askForProfile(const QString& file);

Q_SIGNALS:
  void toolChanged();

private:
  void addFields();
  [[nodiscard]] QWidget* makeFile();
  void choose(int kind);
  void chooseFile();
  void showFields();
  void fitTip();
  void showProfile();

  Tip inUse_;
  std::shared_ptr<const Profile> profile_; // the last in use; null: none yet
  QString asked_;                          // a file that may become the profile; empty: none

  QGridLayout* rows_;
  ChoiceBox* kind_;
  QuantityBox* radius_; // of the base, whatever the shape calls it
  QuantityBox* halfAngle_;
  QuantityBox* flatRadius_;
  QuantityBox* tipRadius_;
  QLineEdit* fileName_;
  QWidget* file_; // its name with a button
};

} // namespace palp
