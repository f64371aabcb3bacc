#pragma once

#include "haptics/servo/sample.h"
#include "pipeline/deform/vtkPalpDeformFilter.h"

class vtkRenderer;

namespace palp
{

/// What an overlay shows.
struct OverlayState
{
  const Sample& sample;
  const Tip& tip;
  double extentRadius;        ///< R_d of the table [m]
  vtkPalpDeformFilter& press; ///< up to date, with its patch
};

/// One thing drawn over the surface.
class OverlayProps
{
public:
  virtual ~OverlayProps() = default;
  OverlayProps() = default;
  OverlayProps(const OverlayProps&) = delete;
  OverlayProps& operator=(const OverlayProps&) = delete;

  /// Takes up a state of contact.
  virtual void show(const OverlayState& state) = 0;

  /// Draws nothing and computes nothing until the next show().
  virtual void hide() = 0;
};

} // namespace palp
