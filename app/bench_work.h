#pragma once

#include "calibration/extent_table.h"
#include "data/shapes.h"
#include "haptics/servo/safety.h"
#include "haptics/servo/servo_step.h"
#include "haptics/units.h"
#include "pipeline/dent.h"

#include <memory>
#include <vector>

// what the benchmarks repeat: one tool path, one servo step, one visual update

namespace palp
{

constexpr double kBenchSide = units::fromMillimetres(100.0);
constexpr double kBenchDepth = units::fromMillimetres(5.0);

/// A tool that goes round and round at constant depth, 0.1 m/s.
[[nodiscard]] ToolPose benchPose(double time);

[[nodiscard]] DeviceLimits benchDevice();

/// All that a servo thread does between two exchanges with a device.
class ServoTick
{
public:
  explicit ServoTick(std::shared_ptr<const Surface> surface);
  Sample operator()(const ToolPose& pose);

private:
  SafetyChain chain_;
  Scene scene_;
};

/// Contact, law, deformed points and their normals on the paper's surface of n x n points.
class VisualUpdate
{
public:
  explicit VisualUpdate(int n);
  void operator()(const ToolPose& pose);

private:
  [[nodiscard]] DentArrays arrays();

  Mesh mesh_;
  std::vector<float> rest_;
  Dent dent_;
  Scene scene_;
  ExtentTable extents_;
  std::vector<float> points_;
  std::vector<float> normals_;
  std::vector<float> displacement_;
  std::vector<unsigned char> zone_;
};

} // namespace palp
