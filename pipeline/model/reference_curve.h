#pragma once

#include <string>
#include <vector>

namespace palp
{

/// A curve somebody measured or computed, in SI.
struct ReferenceCurve
{
  std::string name;
  std::vector<double> x;
  std::vector<double> y;
};

} // namespace palp
