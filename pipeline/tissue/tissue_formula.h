#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

class vtkFunctionParser;

namespace palp
{

/// Young's modulus by a formula in x, y, z and r, the distance from the z axis, in mm; its value in
/// kPa: `6+0.1*z`, `if(r<10, 40, 6)`. For one thread at a time.
class TissueFormula
{
public:
  /// @throws Error  BadValue: not a formula; tells where
  explicit TissueFormula(const std::string& text);

  /// @param position  [m]
  /// @return          [Pa]
  /// @throws Error    BadValue: not a number there, or not above 0
  [[nodiscard]] double operator()(const Eigen::Vector3d& position) const;

private:
  std::string text_;
  std::shared_ptr<vtkFunctionParser> parser_;
  std::vector<std::size_t> places_; // of its variables among the names
};

} // namespace palp
