#include "app/window/coarse_level.h"

#include "pipeline/model/coarse_mesh.h"

#include <chrono>
#include <utility>
#include <vtkPolyData.h>

namespace palp
{

vtkSmartPointer<vtkPolyData> CoarseLevel::levelOf(vtkPolyData& fine)
{
  return fine.GetNumberOfCells() > kMost ? coarseMesh(fine, kDrawn) : nullptr;
}

void CoarseLevel::take(vtkPolyData& fine, vtkSmartPointer<vtkPolyData> coarse)
{
  fine_ = &fine;
  coarse_ = std::move(coarse);
  isNew_ = coarse_ != nullptr;
}

void CoarseLevel::follow(vtkPolyData& fine)
{
  if (&fine == fine_ || work_.valid())
  {
    return;
  }
  take(fine, nullptr);
  if (fine.GetNumberOfCells() > kMost)
  {
    worked_ = fine_;
    const auto copy = vtkSmartPointer<vtkPolyData>::New(); // of its own, to be asked by that thread
    copy->ShallowCopy(fine_);
    work_ = std::async(std::launch::async, [copy] { return levelOf(*copy); });
  }
}

bool CoarseLevel::becomesReady()
{
  using std::chrono_literals::operator""s;
  if (work_.valid() && work_.wait_for(0s) == std::future_status::ready)
  {
    vtkSmartPointer<vtkPolyData> made = work_.get();
    worked_ == fine_ ? take(*worked_, std::move(made)) : void();
    worked_ = nullptr;
  }
  return std::exchange(isNew_, false);
}

vtkPolyData* CoarseLevel::of(const vtkPolyData& fine) const noexcept
{
  return &fine == fine_ ? coarse_.Get() : nullptr;
}

} // namespace palp
