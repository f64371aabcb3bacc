#pragma once

#include "calibration/organ/organ_model.h"
#include "calibration/tables/organ_table.h"
#include "haptics/servo/scene.h"
#include "haptics/surface/surface_point.h"

#include <memory>
#include <span>
#include <string>

namespace palp
{

/// What is pressed at single places: the same as an organ file has it there, solved for around them
/// only, and felt as by palp run.
class OrganPlace
{
public:
  /// @param model     of the scene's surface
  /// @param supports  of the model
  /// @param scene     with surface and law
  /// @param point     that is pressed
  /// @throws Error    BadValue: too little of the surface is around it, or the body hangs over it
  OrganPlace(const OrganModel& model, std::span<const Support> supports, const Scene& scene,
    const SurfacePoint& point);

  /// What a tool is answered there, and what is not to be believed of it.
  struct Answer
  {
    BodyCompliance body;  ///< below it
    double force = 0.0;   ///< [N]
    double local = 0.0;   ///< depth of the contact by itself [m]
    std::string remark{}; ///< empty: none
  };

  [[nodiscard]] Answer at(const ToolPose& pose) const;

  /// With what is told of the body around the place.
  [[nodiscard]] const Scene& scene() const noexcept
  {
    return scene_;
  }

private:
  [[nodiscard]] const char* remarkOf(const ToolPose& pose, const SeriesResponse& answer) const;

  SurfacePoint point_;
  double cell_;
  bool isHeld_;
  double thickness_;
  bool isTooThin_;
  double edge_;
  Scene scene_;
};

} // namespace palp
