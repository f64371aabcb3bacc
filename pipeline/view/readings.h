#pragma once

#include "pipeline/layout/before_render.h"
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

  /// What is drawn and wants its key.
  struct Keys
  {
    bool arrow = false;
    bool contactCircle = false;
    bool extentCircle = false;
    bool isoLines = false;
    std::string validity{}; ///< a line about the law's; empty for none
  };

  void setKeys(Keys keys);

private:
  static constexpr std::size_t kLines = 6;

  std::array<vtkNew<vtkTextActor>, kLines> lines_;
  Keys keys_;
  BeforeRender layOut_; // the lines, one over the other
};

} // namespace palp
