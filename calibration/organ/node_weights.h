#pragma once

#include <array>

namespace palp
{

/// A place in a cube as a linear combination of its nodes: of their displacements that of the
/// place, and a force there as forces on them.
struct NodeWeights
{
  std::array<int, 8> nodes;
  std::array<double, 8> values;
};

} // namespace palp
