#pragma once

#include "app/input/organ_plan.h"
#include "app/input/tissue_presets.h"

#include <QWidget>

#include <string>
#include <vector>

class QTreeWidget;
class QTreeWidgetItem;

namespace palp
{

/// The organs of a scene, one row each: whether and how it is seen and felt, its color, its tissue.
/// Changes nothing by itself.
class OrganList : public QWidget
{
  Q_OBJECT

public:
  explicit OrganList(QWidget* parent = nullptr);

  /// As they are in use, without a signal.
  void show(const std::vector<OrganPlan>& organs);

  /// The row that is chosen, whose tissue other panels show.
  [[nodiscard]] std::size_t chosen() const;

  /// Without a signal; nothing where there is none of the name.
  void choose(const std::string& name);

protected:
  void changeEvent(QEvent* event) override;

Q_SIGNALS:
  void changed(const std::vector<palp::OrganPlan>& organs); ///< as asked for
  void chosenChanged();

private:
  void addRow(std::size_t place);
  void showRow(std::size_t place);
  void ask(std::size_t place, const OrganPlan& organ);
  void toggleEye(std::size_t place);
  void askColor(std::size_t place);
  void takeTissue(std::size_t place, int preset);
  [[nodiscard]] int presetOf(const OrganPlan& organ) const;

  std::vector<TissuePreset> presets_;
  std::vector<OrganPlan> organs_;
  std::vector<OrganRole> seen_; // role that each has when it is not hidden
  QTreeWidget* rows_;
};

} // namespace palp
