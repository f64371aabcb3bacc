#pragma once

#include "haptics/servo/sample.h"
#include "pipeline/deform/vtkPalpDeformFilter.h"
#include "pipeline/view/dent_colors.h"
#include "pipeline/view/press_view.h"
#include "pipeline/view/tool_props.h"

#include <memory>
#include <optional>
#include <vtkNew.h>

namespace palp
{

/// Another hand's tool and dent in a view: each point of the surface goes where the deeper of both
/// dents has it. Nothing is made for it before there is one.
class OtherHand
{
public:
  /// @param view  of the first hand, in the same renderer; outlives this object
  OtherHand(vtkRenderer& renderer, PressView& view)
    : renderer_(renderer)
    , view_(view)
  {
  }

  /// Shows the sample of the first hand in the view, and that of the other beside it.
  ///
  /// Dents that meet are drawn with the triangles of the surface, in its color.
  /// @param other  null: there is none; of another organ: its tool alone is seen
  void show(const Sample& first, const Sample* other);

  /// What is shown of the other; null: none.
  [[nodiscard]] const Sample* shown() const noexcept
  {
    return shown_ ? &*shown_ : nullptr;
  }

private:
  struct Props
  {
    Props(vtkRenderer& renderer, vtkProperty& surface);

    vtkNew<vtkPalpDeformFilter> press;
    DentColors dent;
    ToolProps tool;
    Sample left{};    // the last that touched, whose dent may still come back
    int version = -1; // of the view, whose tip and color they have
  };

  void press(const Sample& first, const Sample* other);
  void placeDent(const Sample& first, const Sample* other);

  vtkRenderer& renderer_;
  PressView& view_;
  std::unique_ptr<Props> props_; // null: there has been none
  std::optional<Sample> shown_;
};

} // namespace palp
