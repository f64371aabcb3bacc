#pragma once

#include "app/input/press_places.h"
#include "haptics/contact/contact.h"

#include <QToolBar>

#include <string>

class QAction;
class QLineEdit;
class QStandardItemModel;

namespace palp
{

class QuantityBox;

/// A depth that may be asked for again, to a micrometer [m].
[[nodiscard]] double depthToType(const Contact& deepest);

/// Where to press, how deep and how fast, to be typed; the place of the last press stands there.
class PressBar : public QToolBar
{
  Q_OBJECT

public:
  explicit PressBar(QWidget* parent = nullptr);

  /// One place, with its name where it is of the list that is offered; a depth that is typed behind
  /// it, as in 0, 0, 50, 5 mm, goes into its own field.
  /// @throws Error  BadValue: what is typed is no place, or a field holds what was refused
  [[nodiscard]] PlacedPresses presses();

  /// How deep and how fast, without a place.
  /// @throws Error  BadValue: a field holds what was refused
  [[nodiscard]] PlacedPresses values() const;

  /// Places to choose from below the field, the first of them in it, and how they are pressed.
  void offer(const PlacedPresses& presses);

  /// @param place  on the surface [m]
  void showPlace(const Eigen::Vector3d& place);

  /// Of a press: its place, and how deep it is.
  void showPress(const Contact& deepest);

  /// For another body, which has other places.
  void clearPlace();

Q_SIGNALS:
  void pressAsked();
  void refused(const QString& why); ///< while a depth or a speed is; empty: none is, any longer

private:
  void makeOffer();
  [[nodiscard]] std::string offeredName(const QString& place) const;
  void tellRefusal(QuantityBox& field);
  [[nodiscard]] QString refusal() const; // that stands; empty: none
  void addField(const QString& label, const QString& what, QWidget* field);

  QLineEdit* place_;
  QStandardItemModel* offered_;
  QAction* choose_; // shows them
  QuantityBox* depth_;
  QuantityBox* speed_;
};

} // namespace palp
