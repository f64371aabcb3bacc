#pragma once

#include "app/map/stiffness_map.h"
#include "pipeline/model/surface_map.h"

#include <atomic>
#include <future>
#include <optional>

class vtkPolyData;

namespace palp
{

/// A map that is made on a thread of its own. Main thread only.
class MapWork
{
public:
  struct Made
  {
    StiffnessMap map;
    std::vector<SurfacePoint> points; ///< of the surface that is looked at
    SurfaceMap colors;                ///< of these
    bool isKept = false;              ///< on the disk, or nobody wants it
  };

  /// Begins.
  /// @param shown  the surface that is looked at; used here only
  MapWork(const Scene& scene, const MapRequest& request, vtkPolyData& shown);

  /// Ends the work within the time of one place.
  ~MapWork();
  MapWork(const MapWork&) = delete;
  MapWork& operator=(const MapWork&) = delete;

  /// Percent of the places.
  [[nodiscard]] int percent() const noexcept;

  [[nodiscard]] bool isDone() const;

  /// What was made; call it once it is done.
  /// @throws Error  as pressMap
  [[nodiscard]] Made take();

private:
  std::atomic<std::size_t> done_ = 0;
  std::atomic<std::size_t> all_ = 0;
  std::atomic<bool> goesOn_ = true;
  std::future<Made> made_; // last: it uses the others
};

} // namespace palp
