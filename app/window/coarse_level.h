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

  /// On the thread of the caller, any; null where a surface has kMost triangles or fewer.
  [[nodiscard]] static vtkSmartPointer<vtkPolyData> levelOf(vtkPolyData& fine);

  /// Takes what was made of a surface before that is first drawn; another one is forgotten.
  void take(vtkPolyData& fine, vtkSmartPointer<vtkPolyData> coarse);

  /// Begins to make it of a surface that nobody took any of, after what it makes of another.
  void follow(vtkPolyData& fine);

  /// Whether it was made or taken since the last call.
  bool becomesReady();

  /// What to draw in the place of a surface; null: itself.
  [[nodiscard]] vtkPolyData* of(const vtkPolyData& fine) const noexcept;

private:
  vtkSmartPointer<vtkPolyData> fine_;
  vtkSmartPointer<vtkPolyData> coarse_; // null: there is none
  bool isNew_ = false;
  vtkSmartPointer<vtkPolyData> worked_; // of which it is made just now
  std::future<vtkSmartPointer<vtkPolyData>> work_;
};

} // namespace palp
