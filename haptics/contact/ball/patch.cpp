#include "haptics/contact/ball/patch.h"

#include "haptics/contact/ball/disc_integral.h"
#include "haptics/numerics/box_probe.h"
#include "haptics/numerics/smooth_step.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace palp
{
namespace
{

constexpr double kCone = 1.0 / 3.0; // volume by base and height

// of Q, as far as the ball reaches behind a plane: with less its rim, which is all at once 2 pi
// where the ball meets a far wall, counts gradually
constexpr double kNew = 0.1;

// of the sphere, nearer than which to none or all of it its triangles are summed one by one: the
// angle of the rim is known up to whole spheres
constexpr double kUnsure = 1e-3; // [rad^2]
constexpr double kSphere = 4.0 * std::numbers::pi;

// of the center over the plane of one of the triangles [m]
double heightOver(const Facet& facet, const PatchBall& ball) noexcept
{
  return facet.normal.dot(ball.center - facet.corners[0]);
}

// how much a triangle counts that fades
struct Fading
{
  Fading(const Facet& facet, const PatchBall& ball, double height) noexcept
  {
    const double faced = std::max(0.0, 1.0 + ball.turning * height);
    const double fall = 6.0 * faced * (1.0 - faced);
    part = smoothStep(faced);
    change = fall * ball.turning * facet.normal;
    byTurning = fall * height;
  }

  // whether one that the center is so high over does not count in full
  static bool applies(const PatchBall& ball, double height) noexcept
  {
    return 1.0 + ball.turning * height < 1.0;
  }

  double part;            // that counts [-]
  Eigen::Vector3d change; // of that part as the center moves [1/m]
  double byTurning;       // of it over how fast it fades [m]
};

// Sums of what is along the outward normal n, of unit length, and of the same without it as a
// fourth row: what a processor adds in pairs.
struct NormalSums
{
  Eigen::Vector4d weight = Eigen::Vector4d::Zero();                        // [m^4]
  Eigen::Vector4d area = Eigen::Vector4d::Zero();                          // [m^2]
  Eigen::Matrix<double, 4, 3> slope = Eigen::Matrix<double, 4, 3>::Zero(); // of weight [m^3]
};

// sums the triangles in a ball
class PatchSum
{
public:
  PatchSum(const Surface& surface, const PatchBall& ball) noexcept
    : surface_(surface)
    , ball_(ball)
    , squaredRadius_(ball.radius * ball.radius)
    , byArea_(2.0 / 15.0 * squaredRadius_)
    , byAngle_(kCone * squaredRadius_ * ball.radius)
    , full_(byArea_ * squaredRadius_ * ball.radius)
    , rim_(ball.radius)
  {
  }

  [[nodiscard]] Patch operator()(double inside) noexcept
  {
    const BoxTree& tree = surface_.tree();
    const BoxProbe probe(ball_.center);
    const auto isNear = [&](const BoxTree::Node& box)
    { return static_cast<double>(probe.squaredDistance(box)) < squaredRadius_; };
    const auto isToVisit = [&](const BoxTree::Node& box)
    {
      if (!isNear(box))
      {
        return false;
      }
      const FacetSum* sum =
        surface_.sums().of(static_cast<std::size_t>(&box - tree.nodes().data()));
      const bool isWhole = sum != nullptr && squaredReach(box, ball_.center) <= squaredRadius_ &&
        (ball_.turning == 0.0 || sum->areAllSeen(ball_.center, ball_.radius, ball_.turning));
      if (isWhole)
      {
        add(*sum);
      }
      return !isWhole;
    };
    tree.search(isToVisit, [&](int i) { add(i); });
    takeOver();
    patch_.solidAngle = bodyAngle(kSphere * inside, isNear);
    patch_.orientationSum += patch_.normal;
    patch_.orientationWeight += patch_.weight;
    patch_.solidAngleSlope /= squaredRadius_ * ball_.radius;
    patch_.volume += byAngle_ * patch_.solidAngle;
    patch_.moment += full_ * patch_.solidAngle;
    return patch_;
  }

private:
  // Of the sphere within the body, as far as its triangles count.
  // @param without  the same were no triangle seen from the center [rad^2]
  template <typename Near>
  [[nodiscard]] double bodyAngle(double without, Near isNear) const noexcept
  {
    const double within = without - rim_.value(); // up to whole spheres
    const double filled = within - kSphere * std::floor(within / kSphere);
    if (!patch_.isOpen && filled > kUnsure && filled < kSphere - kUnsure)
    {
      return filled + faded_;
    }
    const BoxTree& tree = surface_.tree();
    double seen = 0.0;
    const auto see = [&](int i)
    {
      const Facet& facet = tree.facets()[at(i)];
      const double height = heightOver(facet, ball_);
      const double part = Fading::applies(ball_, height) ? Fading(facet, ball_, height).part : 1.0;
      seen += part * seenOf(facet, height);
    };
    tree.search(isNear, see);
    return without - seen;
  }

  // the part of a triangle in the ball, below 0 where its back is seen
  [[nodiscard]] double seenOf(const Facet& facet, double height) const noexcept
  {
    return std::copysign(solidAngleOf(facet, ball_.center, squaredRadius_), -height);
  }

  void add(const FacetSum& sum) noexcept
  {
    const Eigen::Vector3d place = ball_.center - sum.origin;
    const double from = squaredRadius_ - place.squaredNorm();
    const double weight = from * sum.area + 2.0 * place.dot(sum.place) - sum.squares;
    const Eigen::Vector3d turned = sum.normalPlace * place;
    // of the heights of the center over the planes, and of those times w
    const double over = sum.normal.dot(place) - sum.height;
    const double weighed = from * over + 2.0 * place.dot(turned - sum.heightPlace) -
      sum.normalSquares.dot(place) + sum.heightSquares;
    sums_.weight.head<3>() += from * sum.normal + 2.0 * turned - sum.normalSquares;
    sums_.weight[3] += weight;
    sums_.area.head<3>() += sum.normal;
    sums_.area[3] += sum.area;
    sums_.slope.topRows<3>() += 2.0 * (sum.normalPlace - sum.normal * place.transpose());
    sums_.slope.row(3) += 2.0 * (sum.place - sum.area * place).transpose();
    patch_.volume -= kCone * over;
    patch_.moment -= byArea_ * over + 0.2 * weighed;
  }

  void add(int index) noexcept
  {
    const Facet& facet = surface_.tree().facets()[at(index)];
    const DiscIntegral within = integrate(facet, ball_.center, squaredRadius_, rim_);
    if (!(within.weight > 0.0))
    {
      return;
    }
    if (const std::uint8_t open = surface_.sums().openSides(index); open != 0)
    {
      patch_.isOpen = true;
      const SeamIntegral border = seamsOf(facet, ball_.center, squaredRadius_, open);
      patch_.fading -= border.moment;
      patch_.volumeFading -= border.volume;
      patch_.rim -= border.rim;
    }
    if (const double height = heightOver(facet, ball_); Fading::applies(ball_, height))
    {
      const Fading one(facet, ball_, height);
      addFaded(facet, within, one, height);
      add(facet, within, height, one.part, one.part * within.slope + within.weight * one.change);
    }
    else
    {
      add(facet, within, height, 1.0, within.slope);
    }
  }

  // @param part   that counts [-]
  // @param slope  of the weight that counts [m^3]
  void add(const Facet& facet, const DiscIntegral& within, double height, double part,
    const Eigen::Vector3d& slope) noexcept
  {
    const Eigen::Vector2d across(facet.normal[0], facet.normal[1]);
    const Eigen::Vector2d rest(facet.normal[2], 1.0);
    const auto addTo = [&](auto sum, double by)
    {
      sum.template head<2>() += by * across;
      sum.template tail<2>() += by * rest;
    };
    addTo(sums_.slope.col(0), slope[0]);
    addTo(sums_.slope.col(1), slope[1]);
    addTo(sums_.slope.col(2), slope[2]);
    addTo(sums_.weight.col(0), part * within.weight);
    addTo(sums_.area.col(0), part * within.area);
    patch_.volume += part * below(within, height);
    patch_.moment += part * nearer(within, height);
    if (within.rim > 0.0)
    {
      const double reached = (squaredRadius_ - height * height) / (kNew * squaredRadius_);
      const double rim = part * std::min(1.0, reached) * within.rim;
      patch_.rim += rim * facet.normal;
      patch_.solidAngleSlope += rim * height;
    }
  }

  void takeOver() noexcept
  {
    patch_.slopes.normal = sums_.slope.topRows<3>();
    patch_.slopes.weight = sums_.slope.row(3).transpose();
    patch_.slopes.area = sums_.area[3];
    patch_.normal = sums_.weight.head<3>();
    patch_.weight = sums_.weight[3];
    patch_.area = sums_.area.head<3>();
  }

  void addFaded(
    const Facet& facet, const DiscIntegral& within, const Fading& one, double height) noexcept
  {
    const double seen = seenOf(facet, height);
    const double rest = 1.0 - one.part;
    const SeamIntegral seams = seamsOf(facet, ball_.center, squaredRadius_);
    const double moment = nearer(within, height) - full_ * seen;
    const double volume = below(within, height) - byAngle_ * seen;
    faded_ += rest * seen;
    patch_.fading += rest * seams.moment - moment * one.change;
    patch_.volumeFading += rest * seams.volume - volume * one.change;
    patch_.turns.moment += moment * one.byTurning;
    patch_.turns.volume += volume * one.byTurning;
    patch_.turns.weight += within.weight * one.byTurning;
    patch_.turns.normal += within.weight * one.byTurning * facet.normal;
    patch_.orientationSum += rest * within.weight * facet.normal;
    patch_.orientationWeight += rest * within.weight;
  }

  // what a triangle adds to the moment [m^5]
  [[nodiscard]] double nearer(const DiscIntegral& within, double height) const noexcept
  {
    return -height * (byArea_ * within.area + 0.2 * within.weight);
  }

  // and to the volume [m^3]
  [[nodiscard]] static double below(const DiscIntegral& within, double height) noexcept
  {
    return -kCone * height * within.area;
  }

  const Surface& surface_;
  PatchBall ball_;
  double squaredRadius_;
  double byArea_;  // of the moment [m^2]
  double byAngle_; // of the volume [m^3]
  double full_;    // of w [m^5]
  RimAngle rim_;
  double faded_ = 0.0; // solid angle that does not count [rad^2]
  NormalSums sums_;
  Patch patch_;
};

} // namespace

Patch patchWithin(const Surface& surface, const PatchBall& ball, double inside) noexcept
{
  return PatchSum(surface, ball)(inside);
}

} // namespace palp
