#pragma once

#include "app/press/press_log.h"

#include <QWidget>

#include <functional>
#include <set>
#include <vector>

class QAction;
class QHBoxLayout;
class QTreeWidget;
class QTreeWidgetItem;

namespace palp
{

/// All presses of the session, one row each, and what can be done with them. Changes nothing by
/// itself; its actions are for a menu, too.
class PressList : public QWidget
{
  Q_OBJECT

public:
  /// @param log  outlives the list
  explicit PressList(const PressLog& log, QWidget* parent = nullptr);

  /// Brings the rows up to the log.
  /// @return  whether it had changed
  bool refresh();

  static constexpr std::size_t kTicked = 6;

  /// Those to be compared, in their order. A press is ticked when it is new; as long as more than
  /// kTicked are, the oldest that was not ticked by hand no longer is.
  [[nodiscard]] std::vector<const KeptPress*> ticked() const;

  /// The same, but first the one that the others are compared with: what is selected, if any is.
  [[nodiscard]] std::vector<const KeptPress*> compared() const;

  /// How a press is repeated.
  enum class Again
  {
    AsNow,  ///< by the tool and the law in use
    AsThen, ///< by its own
    Paper,  ///< by this law, all else its own
    Exact,
    Corrected,
  };

Q_SIGNALS:
  void againAsked(int id, palp::PressList::Again how);
  void againWithAsked(int id, const QString& tool); ///< as parseTip, all else its own
  void compareAsked();
  void tickedChanged();
  void comparedChanged(); ///< which press the others are compared with
  void fitAsked(int id);
  void renamed(int id, const QString& name);
  void deleteAsked(const std::vector<int>& ids);

private:
  void makeRows();
  void makeActions();
  void makeAgain();
  QAction* addAction(const QString& text, const QString& what, const std::function<void()>& act);
  void showRow(QTreeWidgetItem& row, const KeptPress& press);
  void tickNew(int id);
  void takeEdit(const QTreeWidgetItem& row);
  [[nodiscard]] int idAt(int row) const;
  [[nodiscard]] std::vector<int> selected() const;
  [[nodiscard]] int current() const;
  void enable();

  const PressLog& log_;
  int version_ = -1;
  int newest_ = 0; // id that is known
  std::set<int> ticked_;
  std::set<int> byHand_; // of these
  QTreeWidget* rows_;
  QHBoxLayout* buttons_;
  std::vector<QAction*> ofOne_; // that act on one press
  QAction* compare_ = nullptr;
  QAction* delete_ = nullptr;
};

} // namespace palp
