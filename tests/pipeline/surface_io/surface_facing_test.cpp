#include "pipeline/surface_io/surface_facing.h"

#include "haptics/units.h"
#include "tests/support/surfaces.h"

#include <gtest/gtest.h>
#include <numbers>
#include <utility>

namespace palp::test
{
namespace
{

using namespace units::literals;

void add(Mesh& all, Mesh mesh, bool inward, const Eigen::Vector3d& center = Eigen::Vector3d::Zero())
{
  const auto first = static_cast<int>(all.first.size());
  for (const Eigen::Vector3d& point : mesh.first)
  {
    all.first.push_back(center + point);
  }
  for (Triangle t : mesh.second)
  {
    inward ? std::swap(t[0], t[2]) : void();
    all.second.push_back({ first + t[0], first + t[1], first + t[2] });
  }
}

// [m^3], by the divergence theorem, in units of that of a sphere of the radius
double ballsIn(const Mesh& mesh, const Facing& facing, double radius)
{
  double volume = 0.0;
  for (std::size_t i = 0; i < mesh.second.size(); ++i)
  {
    const auto [a, b, c] = mesh.second[i];
    volume += (facing.within[i]    ? 0.0
                  : facing.turn[i] ? -1.0
                                   : 1.0) /
      6.0 * mesh.first[at(a)].dot(mesh.first[at(b)].cross(mesh.first[at(c)]));
  }
  return volume / (4.0 / 3.0 * std::numbers::pi * radius * radius * radius);
}

Facing facingOf(const Mesh& mesh)
{
  return palp::facingOf(mesh.first, mesh.second, edgesOf(mesh.first.size(), mesh.second));
}

// a wall of a tenth of the radius: whichever of both comes first, and faces which way
TEST(Facing, OfAPieceWithinAnotherThatFacesTheOtherWayIsTowardTheHollow)
{
  for (const bool outerFirst : { true, false })
  {
    for (const bool inward : { true, false })
    {
      Mesh mesh;
      add(mesh, ball(outerFirst ? 40.0_mm : 36.0_mm, 12), outerFirst == inward);
      add(mesh, ball(outerFirst ? 36.0_mm : 40.0_mm, 12), outerFirst != inward);
      const Facing facing = facingOf(mesh);
      EXPECT_EQ(facing.cavities, 1U);
      EXPECT_NEAR(ballsIn(mesh, facing, 40.0_mm), 1.0 - 0.9 * 0.9 * 0.9, 0.02);
    }
  }
}

TEST(Facing, TellsThatOneSideGoesOverIntoTheOther)
{
  for (const int halfTurns : { 0, 1, 2, 3 })
  {
    Mesh strip;
    constexpr int kAround = 40;
    for (int i = 0; i <= kAround; ++i)
    {
      const double along = 2.0 * std::numbers::pi * i / kAround;
      const double turn = 0.5 * halfTurns * along;
      for (const double aside : { -5.0_mm, 5.0_mm })
      {
        const double far = 30.0_mm + aside * std::cos(turn);
        strip.first.emplace_back(
          far * std::cos(along), far * std::sin(along), aside * std::sin(turn));
      }
    }
    for (int i = 0; i < kAround; ++i)
    {
      const auto point = [&](int across, int far)
      {
        const bool isEnd = i + far == kAround; // which is the beginning, from below perhaps
        return isEnd ? (halfTurns % 2 == 0 ? across : 1 - across) : 2 * (i + far) + across;
      };
      strip.second.push_back({ point(0, 0), point(1, 0), point(0, 1) });
      strip.second.push_back({ point(1, 0), point(1, 1), point(0, 1) });
    }
    EXPECT_EQ(facingOf(strip).twisted, halfTurns % 2 == 1) << halfTurns;
  }
}

// what lies in the body and faces alike bounds nothing
TEST(Facing, OfPiecesThatFaceAlikeIsOutward)
{
  for (const bool inward : { true, false })
  {
    Mesh within;
    add(within, ball(40.0_mm, 12), inward);
    add(within, ball(20.0_mm, 12), inward);
    EXPECT_EQ(facingOf(within).cavities, 0U);
    EXPECT_EQ(facingOf(within).inner, 1U);
    EXPECT_NEAR(ballsIn(within, facingOf(within), 40.0_mm), 1.0, 0.04);
    add(within, ball(30.0_mm, 12), inward, { 25.0_mm, 0.0, 0.0 }); // reaches out of the first
    EXPECT_EQ(facingOf(within).inner, 1U);
    Mesh beside;
    add(beside, ball(40.0_mm, 12), inward);
    add(beside, ball(40.0_mm, 12), !inward, { 90.0_mm, 0.0, 0.0 });
    EXPECT_EQ(facingOf(beside).cavities, 0U);
    EXPECT_NEAR(ballsIn(beside, facingOf(beside), 40.0_mm), 2.0, 0.06);
  }
}

// a stone in the hollow of a shell, and two hollows in one body
TEST(Facing, OfSeveralIsThatOfTheirDepth)
{
  Mesh stone;
  add(stone, ball(10.0_mm, 8), false);
  add(stone, ball(36.0_mm, 12), true);
  add(stone, ball(40.0_mm, 12), false);
  EXPECT_EQ(facingOf(stone).cavities, 1U);
  EXPECT_EQ(facingOf(stone).inner, 0U);
  EXPECT_NEAR(ballsIn(stone, facingOf(stone), 40.0_mm), 1.0 - 0.729 + 1.0 / 64.0, 0.03);
  Mesh holes;
  add(holes, ball(40.0_mm, 12), false);
  add(holes, ball(10.0_mm, 8), true, { 15.0_mm, 0.0, 0.0 });
  add(holes, ball(10.0_mm, 8), true, { -15.0_mm, 0.0, 0.0 });
  EXPECT_EQ(facingOf(holes).cavities, 2U);
  EXPECT_NEAR(ballsIn(holes, facingOf(holes), 40.0_mm), 1.0 - 2.0 / 64.0, 0.03);
}

} // namespace
} // namespace palp::test
