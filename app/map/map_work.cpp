#include "app/map/map_work.h"

#include "app/map/map_files.h"

#include <chrono>
#include <utility>

namespace palp
{

MapWork::MapWork(const Scene& scene, const MapRequest& request, vtkPolyData& shown)
  : made_(std::async(std::launch::async,
      [this, scene, request, points = surfacePoints(shown)]() mutable
      {
        StiffnessMap map = pressMap(scene, request,
          [this](std::size_t done, std::size_t all)
          {
            done_ = done;
            all_ = all;
            return goesOn_.load();
          });
        SurfaceMap colors = colorsOf(map, points);
        return Made{ std::move(map), std::move(points), std::move(colors) };
      }))
{
}

MapWork::~MapWork()
{
  goesOn_ = false; // the future waits for its thread
}

int MapWork::percent() const noexcept
{
  const std::size_t all = all_;
  return all == 0 ? 0 : static_cast<int>(100 * done_ / all);
}

bool MapWork::isDone() const
{
  return made_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

MapWork::Made MapWork::take()
{
  return made_.get();
}

} // namespace palp
