#include "haptics/contact/find_contact.h"
#include "haptics/units.h"
#include "tests/support/surfaces.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <random>
#include <vector>

namespace palp
{
namespace
{

using namespace units::literals;
using Eigen::Vector3d;

constexpr double kHalf = 30.0_mm; // of a sheet's side

const std::vector<Tip> kRound = { SphereTip{ 8.0_mm }, SphereTip{ 12.0_mm },
  ParaboloidTip{ 6.0_mm } };
const std::vector<std::function<double(double, double)>> kSheets = {
  [](double, double) { return 0.0; },
  [](double x, double y) { return -6.0 * x * x - 4.0 * y * y + 2.0 * x * y; },
  [](double x, double y) { return 5.0 * x * x + 3.0 * x * y; },
};

Contact pressed(const Surface& surface, const Tip& tip, const Vector3d& apex, const Vector3d& axis)
{
  return findContact(
    surface, tip, { .apex = apex, .axis = axis, .velocity = Vector3d::Zero() }, ContactRule::Exact);
}

TEST(Border, OfASheetPushesAsTheDepthChanges)
{
  std::mt19937 random(3);
  const auto within = [&](double low, double high)
  { return std::uniform_real_distribution<double>(low, high)(random); };
  for (const int cells : { 6, 30 })
  {
    for (const auto& height : kSheets)
    {
      const Surface sheet = test::makeSurface(test::sheet(2.0 * kHalf, cells, height));
      for (int i = 0; i < 900; ++i)
      {
        const Tip& tip = kRound[static_cast<std::size_t>(i) % kRound.size()];
        const double lean = within(0.0, 30.0_deg);
        const double turn = within(0.0, 6.3);
        const Vector3d axis(
          std::sin(lean) * std::cos(turn), std::sin(lean) * std::sin(turn), -std::cos(lean));
        const double x = within(20.0_mm, 38.0_mm); // past the border, and past its corner
        const double y = within(-36.0_mm, 36.0_mm);
        const Vector3d apex(x, y, height(x, y) - within(0.0, 0.5) * noseRadius(tip));
        const Contact contact = pressed(sheet, tip, apex, axis);
        // deeper, beside the sheet, its front and its back are one; at a corner that is all but
        // missed, the moment of the ball is that of no body
        if (contact.depth > 0.3_mm && contact.depth < 0.5 * noseRadius(tip))
        {
          constexpr double kStep = 1e-7;
          Vector3d slope;
          for (Eigen::Index k = 0; k < 3; ++k)
          {
            const Vector3d move = kStep * Vector3d::Unit(k);
            slope[k] = (pressed(sheet, tip, apex + move, axis).depth -
                         pressed(sheet, tip, apex - move, axis).depth) /
              (2.0 * kStep);
          }
          EXPECT_LT((slope + contact.slope * contact.normal).norm(), 2e-3)
            << contact.depth << " deep, tool " << tip.index() << " at " << 1e3 * apex.transpose()
            << " mm";
        }
      }
    }
  }
}

// pressed in, dragged out over the border or its corner, and lifted beside it
TEST(Border, OfASheetGivesNoEnergy)
{
  for (const auto& height : kSheets)
  {
    const Surface sheet = test::makeSurface(test::sheet(2.0 * kHalf, 30, height));
    for (const Tip& tip : kRound)
    {
      const auto forceAt = [&](const Vector3d& apex)
      {
        const Contact contact = pressed(sheet, tip, apex, -Vector3d::UnitZ());
        return Vector3d(contact.depth * contact.slope * contact.normal); // of a spring
      };
      for (const auto& [depth, y] :
        { std::pair(0.5_mm, 7.0_mm), { 1.5_mm, -20.0_mm }, { 3.0_mm, 0.0 }, { 2.0_mm, 44.0_mm } })
      {
        const auto over = [&](double x, double side, double up)
        { return Vector3d(x, side, height(x, side) + up); };
        const Vector3d ends[] = { over(22.0_mm, 3.0_mm, 5.0_mm), over(22.0_mm, 3.0_mm, -depth),
          over(33.0_mm, y, -depth), over(33.0_mm, y, 9.0_mm) };
        double work = 0.0;
        double most = 0.0;
        for (int leg = 0; leg < 3; ++leg)
        {
          constexpr int kSteps = 2000;
          const Vector3d move = (ends[leg + 1] - ends[leg]) / kSteps;
          for (int i = 0; i < kSteps; ++i)
          {
            work -= forceAt(ends[leg] + (i + 0.5) * move).dot(move);
            most = std::max(most, work);
          }
        }
        // 45 um of depth come and go at once, where the ball all but misses
        EXPECT_TRUE(forceAt(ends[0]).isZero(0.0) && forceAt(ends[3]).isZero(0.0));
        EXPECT_LT(std::abs(work), 2e-3 * most + 1e-9) << "tool " << tip.index() << ", " << depth;
      }
    }
  }
}

} // namespace
} // namespace palp
