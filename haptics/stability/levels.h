#pragma once

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <random>
#include <utility>
#include <vector>

namespace palp
{

/// The levels of one quantity of a Latin hypercube: each equally often, in an order of its own that
/// is the same everywhere.
class Levels
{
public:
  /// @param count  of the cases
  Levels(std::initializer_list<double> values, int count, std::mt19937& random)
  {
    for (int i = 0; i < count; ++i)
    {
      drawn_.push_back(values.begin()[static_cast<std::size_t>(i) % values.size()]);
    }
    for (std::size_t i = drawn_.size(); i > 1; --i) // as no library does it alike everywhere
    {
      std::swap(drawn_[i - 1], drawn_[random() % i]);
    }
  }

  /// The level of a case.
  double operator[](int i) const
  {
    return drawn_[static_cast<std::size_t>(i)];
  }

private:
  std::vector<double> drawn_;
};

} // namespace palp
