#pragma once

#include "pipeline/view/before_render.h"
#include "pipeline/view/overlay_props.h"

#include <array>
#include <string>
#include <vtkNew.h>
#include <vtkTextActor.h>

namespace palp
{

/// Lines of text in the corner: force and depth, and the keys of what is drawn.
class Readings : public OverlayProps
{
public:
  explicit Readings(vtkRenderer& renderer);
  void show(const OverlayState& state) override;
  void hide() override;

  /// Which keys are wanted, and a line about the law's validity; empty for none.
  void setKeys(bool contactCircle, bool extentCircle, std::string validity);

private:
  static constexpr std::size_t kLines = 4;

  std::array<vtkNew<vtkTextActor>, kLines> lines_;
  bool contactCircle_ = false;
  bool extentCircle_ = false;
  std::string validity_;
  BeforeRender layOut_; // the lines, one over the other
};

} // namespace palp
