#pragma once

#include <future>
#include <vtkSmartPointer.h>

class vtkPolyData;

namespace palp
{

/// A surface of fewer triangles to draw in the place of one that this machine draws too slowly,
/// made on another thread. Main thread only; its end waits for that.
class CoarseLevel
{
public:
  static constexpr int kMost = 400'000; ///< triangles that are drawn as they are
  static constexpr int kDrawn = 60'000; ///< of the coarse level, about

  /// Begins to make it, where a surface has more than kMost triangles; another one is forgotten.
  void follow(vtkPolyData& fine);

  /// Whether it was done since the last call.
  bool becomesReady();

  /// What to draw in the place of a surface; null: itself.
  [[nodiscard]] vtkPolyData* of(const vtkPolyData& fine) const noexcept;

private:
  vtkSmartPointer<vtkPolyData> fine_; // null: there is none
  vtkSmartPointer<vtkPolyData> coarse_;
  std::future<vtkSmartPointer<vtkPolyData>> work_;
};

} // namespace palp
