#include "app/window/coarse_level.h"

#include "pipeline/model/coarse_mesh.h"

#include <chrono>
#include <vtkPolyData.h>

namespace palp
{

void CoarseLevel::follow(vtkPolyData& fine)
{
  if (&fine == fine_)
  {
    return;
  }
  fine_ = nullptr;
  coarse_ = nullptr;
  if (fine.GetNumberOfCells() > kMost)
  {
    fine_ = &fine;
    const auto copy = vtkSmartPointer<vtkPolyData>::New(); // of its own, to be asked by that thread
    copy->ShallowCopy(fine_);
    work_ = std::async(std::launch::async, [copy] { return coarseMesh(*copy, kDrawn); });
  }
}

bool CoarseLevel::becomesReady()
{
  using std::chrono_literals::operator""s;
  if (!work_.valid() || work_.wait_for(0s) != std::future_status::ready)
  {
    return false;
  }
  coarse_ = work_.get();
  return true;
}

vtkPolyData* CoarseLevel::of(const vtkPolyData& fine) const noexcept
{
  return &fine == fine_ ? coarse_.Get() : nullptr;
}

} // namespace palp
