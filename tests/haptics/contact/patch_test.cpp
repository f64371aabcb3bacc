#include "haptics/contact/ball/patch.h"

#include "haptics/contact/ball/disc_integral.h"
#include "haptics/contact/ball/lens.h"
#include "tests/support/surfaces.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <random>

namespace palp
{
namespace
{

Facet facetOf(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c)
{
  return { .corners = { a, b, c }, .normal = (b - a).cross(c - a).normalized() };
}

// of one triangle in a ball
struct Part
{
  double area = 0.0;
  double weight = 0.0;
  double rim = 0.0;
  double solidAngle = 0.0;
};

Part partOf(const Facet& facet, const Eigen::Vector3d& center, double squaredRadius)
{
  RimAngle rim(std::sqrt(squaredRadius));
  const DiscIntegral within = integrate(facet, center, squaredRadius, rim);
  return { within.area, within.weight, within.rim, solidAngleOf(facet, center, squaredRadius) };
}

// the same integrals by halving the triangle again and again
Part subdivided(const Facet& facet, const Eigen::Vector3d& center, double squaredRadius, int levels)
{
  const auto& [a, b, c] = facet.corners;
  if (levels == 0)
  {
    const double area = 0.5 * (b - a).cross(c - a).norm();
    const Eigen::Vector3d middle = (a + b + c) / 3.0 - center;
    const double inside = std::max(0.0, squaredRadius - middle.squaredNorm());
    const double reached = inside > 0.0 ? area : 0.0;
    return { .area = reached,
      .weight = area * inside,
      .solidAngle = reached * std::abs(middle.dot(facet.normal)) / std::pow(middle.norm(), 3) };
  }
  const Eigen::Vector3d ab = 0.5 * (a + b);
  const Eigen::Vector3d bc = 0.5 * (b + c);
  const Eigen::Vector3d ca = 0.5 * (c + a);
  Part sum;
  for (const Facet& part :
    { Facet{ { a, ab, ca }, facet.normal }, Facet{ { ab, b, bc }, facet.normal },
      Facet{ { ca, bc, c }, facet.normal }, Facet{ { ab, bc, ca }, facet.normal } })
  {
    const Part value = subdivided(part, center, squaredRadius, levels - 1);
    sum.weight += value.weight;
    sum.area += value.area;
    sum.solidAngle += value.solidAngle;
  }
  return sum;
}

TEST(Patch, TriangleAndBallAgreeWithSubdivision)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> position(-1.0, 1.0);
  const auto point = [&]
  { return Eigen::Vector3d(position(random), position(random), position(random)); };
  for (int i = 0; i < 200; ++i)
  {
    const Facet facet = facetOf(point(), point(), point());
    const Eigen::Vector3d center = point();
    const double squaredRadius = 0.05 + std::abs(position(random));
    const Part exact = partOf(facet, center, squaredRadius);
    const Part sum = subdivided(facet, center, squaredRadius, 7);
    EXPECT_NEAR(exact.weight, sum.weight, 5e-4);
    EXPECT_NEAR(exact.area, sum.area, 5e-3);
    EXPECT_NEAR(exact.solidAngle, sum.solidAngle, 0.02 * sum.solidAngle + 2e-3);
  }
}

// a tool a thousand times as large as the triangles: sums over its disc would be all rounding
TEST(Patch, ATriangleAndAFarLargerBallAgreeWithSubdivision)
{
  const Facet facet = facetOf({ 0.0, 0.0, 0.0 }, { 1e-3, 0.0, 2e-4 }, { 3e-4, 1e-3, 0.0 });
  const Eigen::Vector3d center(0.2, -0.1, 1.0);
  const double nearest = (facet.corners[1] - center).norm();
  for (const double reach : { 1e-5, 5e-5, 1e-4, 1.5e-4, 2e-4, 1e-3 })
  {
    const double squaredRadius = (nearest + reach) * (nearest + reach);
    const Part exact = partOf(facet, center, squaredRadius);
    const Part sum = subdivided(facet, center, squaredRadius, 9);
    EXPECT_NEAR(exact.weight, sum.weight, 3e-3 * sum.weight);
    EXPECT_NEAR(exact.area, sum.area, 2e-2 * sum.area);
    EXPECT_NEAR(exact.solidAngle, sum.solidAngle, 2e-2 * sum.solidAngle);
  }
}

TEST(Patch, WholeDiscInsideATriangle)
{
  const Facet facet = facetOf({ -9.0, -9.0, 0.0 }, { 9.0, -9.0, 0.0 }, { 0.0, 9.0, 0.0 });
  const Part disc = partOf(facet, { 0.1, 0.2, 0.6 }, 1.0);
  EXPECT_NEAR(disc.weight, std::numbers::pi * std::pow(0.64, 2) / 2.0, 1e-14);
  EXPECT_NEAR(disc.area, std::numbers::pi * 0.64, 1e-14);
  EXPECT_NEAR(disc.rim, std::numbers::pi, 1e-14);
  EXPECT_NEAR(disc.solidAngle, 2.0 * std::numbers::pi * (1.0 - 0.6), 1e-14); // of a cone
}

// however a plane is cut into triangles, the parts add up to the disc
TEST(Patch, TrianglesOfAPlaneAddUpToTheDisc)
{
  for (const int n : { 2, 7, 40, 173 })
  {
    const Surface plane = test::makeSurface(test::sheet(8.0, n));
    for (const Eigen::Vector3d& center : { Eigen::Vector3d(0.0, 0.0, 0.5),
           Eigen::Vector3d(0.37, -1.1, 0.9), Eigen::Vector3d(1.0, 1.0, -0.2) })
    {
      const double disc = 1.21 - center.z() * center.z();
      const bool isInside = center.z() < 0.0;
      const Patch patch = patchWithin(plane, { center, 1.1, isInside ? -1.0 : 1.0 }, isInside);
      const Lens half = lensOf(1.21, center.z(), 0.0);
      EXPECT_NEAR(patch.weight, std::numbers::pi * disc * disc / 2.0, 1e-12);
      EXPECT_NEAR(patch.area.z(), std::numbers::pi * disc, 1e-12);
      EXPECT_NEAR(patch.moment, half.moment, 1e-6 * half.moment);
      EXPECT_NEAR(patch.volume, half.volume, 1e-6 * half.volume);
      EXPECT_NEAR(patch.solidAngle, half.solidAngle, 1e-6);
      EXPECT_NEAR(patch.normal.z(), patch.weight, 1e-12);
    }
  }
}

// a quarter of all directions point into a block from its edge, and a half from its face, also from
// so near that rounding says on which side of a triangle the center is
TEST(Patch, ASideOfTrianglesIsNoPlaceWhereTheBodyFillsTheBall)
{
  const Surface block = test::makeSurface(test::block({ 0.1, 0.1, 0.05 }, 8));
  for (const double beside : { -1e-8, -1e-10, 0.0, 1e-10, 1e-8 })
  {
    for (const double over : { 8e-10, 1.8e-9 })
    {
      const Patch patch =
        patchWithin(block, { { -0.0208333, -0.05 - beside, over }, 2.5e-4, 1.0 / 2.5e-4 }, false);
      EXPECT_NEAR(patch.solidAngle, std::numbers::pi, 1e-3) << beside << " " << over;
    }
  }
  const Surface large = test::makeSurface(test::block({ 10.0, 10.0, 10.0 }, 4));
  for (const double radius : { 1e-4, 1e-3, 1e-2 })
  {
    const Patch patch = patchWithin(
      large, { { 0.123468038670012, -5.0 - 1e-11, -7.5 }, radius, 1.0 / radius }, false);
    EXPECT_NEAR(patch.solidAngle, 2.0 * std::numbers::pi, 1e-3) << radius;
  }
}

// The claim the depth rests on: the moment of a body within a ball changes by the normal's sum as
// the ball moves, and by the volume as it grows.
TEST(Patch, TheMomentChangesByTheNormalAndTheVolume)
{
  const Surface body = test::makeSurface(test::block({ 2.0, 1.5, 1.0 }, 5));
  std::mt19937 random(4);
  std::uniform_real_distribution<double> position(-1.0, 1.0);
  constexpr double step = 1e-5;
  for (int i = 0; i < 100; ++i)
  {
    const Eigen::Vector3d center(position(random), 0.75 * position(random), 0.3);
    const double radius = 0.4 + 0.2 * position(random);
    const auto at = [&](const Eigen::Vector3d& place, double squaredRadius) {
      return patchWithin(body, { place, std::sqrt(squaredRadius), 0.0 }, place.z() < 0.0);
    };
    const double squaredRadius = radius * radius;
    const Patch patch = at(center, squaredRadius);
    for (int k = 0; k < 3; ++k)
    {
      const Eigen::Vector3d move = step * Eigen::Vector3d::Unit(k);
      const double change =
        at(center + move, squaredRadius).moment - at(center - move, squaredRadius).moment;
      EXPECT_NEAR(change / (2.0 * step), -patch.normal[k], 1e-8);
    }
    const Patch larger = at(center, squaredRadius + step);
    const Patch smaller = at(center, squaredRadius - step);
    EXPECT_NEAR((larger.moment - smaller.moment) / (2.0 * step), patch.volume, 1e-8);
    EXPECT_NEAR(
      (larger.volume - smaller.volume) / (2.0 * step), 0.5 * radius * patch.solidAngle, 1e-6);
  }
}

// The same where triangles count in part: the sides of those no longer cancel with their
// neighbors'.
TEST(Patch, WhatFadesChangesTheMomentAndTheVolumeAsWell)
{
  const Surface body = test::makeSurface(test::block({ 2.0, 1.5, 1.0 }, 5));
  std::mt19937 random(6);
  std::uniform_real_distribution<double> position(-1.0, 1.0);
  constexpr double step = 1e-5;
  double faded = 0.0;
  for (int i = 0; i < 100; ++i)
  {
    const Eigen::Vector3d center(position(random), 0.75 * position(random), 0.2);
    const auto ballAt = [](const Eigen::Vector3d& place) {
      return PatchBall{ place, 0.6, 1.0 / 0.3 };
    };
    const Patch patch = patchWithin(body, ballAt(center), false);
    faded += patch.fading.norm();
    const auto turned = [&](double by) {
      return patchWithin(body, { center, 0.6, 1.0 / 0.3 + by }, false);
    };
    const Patch more = turned(step);
    const Patch less = turned(-step);
    const auto overTurning = [&](auto of) { return (of(more) - of(less)) / (2.0 * step); };
    EXPECT_NEAR(overTurning([](const Patch& p) { return p.moment; }), patch.turns.moment, 1e-9);
    EXPECT_NEAR(overTurning([](const Patch& p) { return p.volume; }), patch.turns.volume, 1e-9);
    EXPECT_NEAR(overTurning([](const Patch& p) { return p.weight; }), patch.turns.weight, 1e-9);
    EXPECT_NEAR(
      overTurning([](const Patch& p) { return p.normal.z(); }), patch.turns.normal.z(), 1e-9);
    for (int k = 0; k < 3; ++k)
    {
      const Eigen::Vector3d move = step * Eigen::Vector3d::Unit(k);
      const Patch after = patchWithin(body, ballAt(center + move), false);
      const Patch before = patchWithin(body, ballAt(center - move), false);
      const auto slope = [&](auto of) { return ((of(after) - of(before)) / (2.0 * step)); };
      EXPECT_NEAR(
        slope([](const Patch& p) { return p.moment; }), -patch.normal[k] - patch.fading[k], 1e-6);
      EXPECT_NEAR(slope([](const Patch& p) { return p.volume; }),
        -patch.area[k] - patch.volumeFading[k], 1e-4);
      EXPECT_NEAR(
        slope([](const Patch& p) { return p.normal.x(); }), patch.slopes.normal(0, k), 1e-6);
      EXPECT_NEAR(slope([](const Patch& p) { return p.weight; }), patch.slopes.weight[k], 1e-6);
    }
  }
  EXPECT_GT(faded, 0.1);
}

// on a fine mesh of a ball it is that of two balls
TEST(Patch, TheMomentOfABallIsThatOfItsLens)
{
  for (const double bodyRadius : { 2.0, 20.0 })
  {
    const Surface body = test::makeSurface(test::ball(bodyRadius, 300));
    for (const double height : { 0.3, -0.2 })
    {
      const Eigen::Vector3d center =
        (bodyRadius + height) * Eigen::Vector3d(1.0, 2.0, 3.0).normalized();
      const Patch patch = patchWithin(body, { center, 0.6, 0.0 }, height < 0.0);
      const Lens lens = lensOf(0.36, height, 1.0 / bodyRadius);
      EXPECT_NEAR(patch.moment, lens.moment, 4e-3 * lens.moment);
      EXPECT_NEAR(patch.volume, lens.volume, 4e-3 * lens.volume);
    }
  }
}

// by spheres about the ball's center, each held by the body as far as the law of cosines says
TEST(Lens, IsTheSumOfItsSpheres)
{
  for (const double curvature : { 0.0, 0.3, -0.4 })
  {
    for (const double height : { 0.6, -0.4 })
    {
      double moment = 0.0;
      double volume = 0.0;
      constexpr int count = 20000;
      for (int i = 0; i < count; ++i)
      {
        const double r = (i + 0.5) / count;
        // of a ball of radius 1/k about a place height + 1/k away, times 2 k
        const double cosine = (curvature * (r * r + height * height) + 2.0 * height) /
          (2.0 * r * (1.0 + curvature * height));
        const double held = 2.0 * std::numbers::pi * (1.0 - std::clamp(cosine, -1.0, 1.0));
        volume += held * r * r / count;
        moment += held * r * r * (1.0 - r * r) / count;
      }
      const Lens lens = lensOf(1.0, height, curvature);
      EXPECT_NEAR(lens.moment, moment, 1e-7);
      EXPECT_NEAR(lens.volume, volume, 1e-7);
      const double step = 1e-6;
      EXPECT_NEAR(lens.heightSlope,
        (lensOf(1.0, height + step, curvature).moment -
          lensOf(1.0, height - step, curvature).moment) /
          (2.0 * step),
        1e-8);
      EXPECT_NEAR(lens.curvatureSlope,
        (lensOf(1.0, height, curvature + step).moment -
          lensOf(1.0, height, curvature - step).moment) /
          (2.0 * step),
        1e-8);
      EXPECT_NEAR(lens.solidAngleSlope,
        (lensOf(1.0 + step, height, curvature).solidAngle -
          lensOf(1.0 - step, height, curvature).solidAngle) /
          (2.0 * step),
        1e-7);
    }
  }
}

// both are gentle where a triangle leaves the ball: what is left of one that faces the center
// shrinks as the square and the cube of what the ball still reaches beyond it
TEST(Patch, ATriangleLeavesTheBallGently)
{
  const Facet facet = facetOf({ -9.0, -9.0, 0.0 }, { 9.0, -9.0, 0.0 }, { 0.0, 9.0, 0.0 });
  for (const double reach : { 1e-2, 1e-4, 1e-6 })
  {
    const Part last = partOf(facet, { 0.0, 0.0, 1.0 }, 1.0 + reach);
    EXPECT_NEAR(last.weight, std::numbers::pi * reach * reach / 2.0, 1e-9 * reach);
    EXPECT_NEAR(last.area, std::numbers::pi * reach, 1e-9 * reach + 1e-15);
  }
}

} // namespace
} // namespace palp
