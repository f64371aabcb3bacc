#include "app/plots/kept_presses.h"

#include <gtest/gtest.h>
#include <set>
#include <tuple>

namespace palp
{
namespace
{

TEST(KeptPresses, SixteenInARowAreToldApart)
{
  constexpr int kApart = 16;
  for (const int first : { 1, 2, 9, 490 })
  {
    std::set<std::tuple<double, double, double, int>> pens;
    for (int id = first; id < first + kApart; ++id)
    {
      const KeptPress press{ .id = id, .law = { SphereTip{ 0.01 }, makeMaterial(5e4, 0.45), {} } };
      const auto [color, style] = penOf(press);
      pens.emplace(color[0], color[1], color[2], static_cast<int>(style));
    }
    EXPECT_EQ(pens.size(), kApart) << first;
  }
}

} // namespace
} // namespace palp
