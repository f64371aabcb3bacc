#pragma once

#include "calibration/tables/extent_table.h"
#include "data/shapes.h"
#include "haptics/servo/safety.h"
#include "haptics/servo/servo_step.h"
#include "haptics/units.h"
#include "pipeline/deform/dent.h"
#include "pipeline/deform/press_of.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

// what the benchmarks repeat: one tool path, one servo step, one visual update

namespace palp
{

constexpr double kBenchSide = units::fromMillimeters(100.0);
constexpr double kBenchDepth = units::fromMillimeters(5.0);

/// A tool that goes round and round at constant depth, 0.1 m/s.
[[nodiscard]] ToolPose benchPose(double time);

/// A tool at rest whose axis points down.
/// @param apex  [m]
[[nodiscard]] inline ToolPose straightDown(const Eigen::Vector3d& apex)
{
  return { .apex = apex, .axis = -Eigen::Vector3d::UnitZ(), .velocity = Eigen::Vector3d::Zero() };
}

[[nodiscard]] DeviceLimits benchDevice();

/// The corrected law with its tables, for a ball of the scene's own size and tissue.
[[nodiscard]] LawSettings benchSettings();

/// Tissue that relaxes by two terms and rubs, without a surface.
/// @param nodules  ten of them, along the tool's path
[[nodiscard]] Scene benchTissue(bool nodules);

/// All that a servo thread does between two exchanges with a device.
class ServoTick
{
public:
  explicit ServoTick(std::shared_ptr<const Surface> surface, Scene scene = {},
    const DeviceLimits& device = benchDevice());
  Sample operator()(const ToolPose& pose);

private:
  SafetyChain chain_;
  TissueMemory memory_;
  Scene scene_;
};

/// A surface in the arrays in which it is drawn, at rest.
struct DrawnSurface
{
  explicit DrawnSurface(const Mesh& mesh);
  DrawnSurface(const DrawnSurface&) = delete; // the dent refers to its points
  DrawnSurface& operator=(const DrawnSurface&) = delete;

  void press(const Press& with);

  std::vector<float> rest, points, normals, displacement;
  std::vector<unsigned char> zone;
  Dent dent;
};

/// Contact, law, deformed points and their normals on the paper's surface of n x n points.
class VisualUpdate
{
public:
  /// @param table   of data/tables, that of the tip
  /// @param fitted  its fitted surface in place of the paper's ring
  explicit VisualUpdate(int n, const Tip& tip = Scene{}.law.tip(),
    const std::string& table = "sphere_r10_h50", bool fitted = false);
  void operator()(const ToolPose& pose);

  [[nodiscard]] std::size_t vertices() const noexcept
  {
    return drawn_.zone.size();
  }

  /// Where a vertex is after the last update [m].
  [[nodiscard]] Eigen::Vector3d vertex(std::size_t i) const noexcept
  {
    return Eigen::Map<const Eigen::Vector3f>(drawn_.points.data() + 3 * i).cast<double>();
  }

private:
  Scene scene_;
  ExtentTable extents_;
  DentStyle style_;
  DrawnSurface drawn_;
};

} // namespace palp
