#pragma once

#include "app/input/tissue_presets.h"
#include "haptics/force/force_law.h"
#include "haptics/servo/scene.h"

#include <QWidget>

#include <vector>

class QGroupBox;

namespace palp
{

class ChoiceBox;
class LawPanel;
class QuantityBox;
class ToolPanel;

/// Tool, tissue and law with their units; says when any of them changed.
class TissuePanel : public QWidget
{
  Q_OBJECT

public:
  /// @param rated  as in LawOptions
  TissuePanel(const Scene& scene, bool rated, QWidget* parent = nullptr);

  /// As the fields say.
  /// @throws Error  as ToolPanel::tip, LawPanel::settings, ForceLaw
  [[nodiscard]] ForceLaw law() const;
  [[nodiscard]] ContactRule rule() const;
  [[nodiscard]] double damping() const; ///< b [N s/m]

  /// Shows what is in use, without a signal.
  void setScene(const Scene& scene);

  /// As LawPanel::setInside.
  void setInside(const QString& inside);

  /// As ToolPanel::askForProfile.
  void askForProfile(const QString& file);

Q_SIGNALS:
  void tissueChanged();

private:
  QGroupBox* makeTissue();
  void takePreset();
  void showPreset();
  void check() const;

  ToolPanel* tool_;
  LawPanel* law_;
  std::vector<TissuePreset> presets_;
  ChoiceBox* preset_; // in their order, then none of them
  QuantityBox* modulus_;
  QuantityBox* poisson_;
  QuantityBox* damping_;
  ChoiceBox* rule_;
};

} // namespace palp
