#include "haptics/contact/overlap/tool_solid.h"

#include "haptics/force/linear/contact_depth.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace palp
{
namespace
{

// more of the shaft may be in another part of a body
constexpr double kShaft = 4.0;     // [-] base radii of it that count,
constexpr double kBeside = 3.0;    // and that many more than the tool is in, for one that leans
constexpr double kEndless = 1e3;   // [m]
constexpr double kCorner = 0.2;    // [-] of the base: the corner of its radius
constexpr double kFlattest = 1e-9; // [-] of the base: a height that is none

struct Ring
{
  std::array<Eigen::Vector2d, ToolSolid::kSides>
    corners; // of a ring whose sides are 1 from the axis
  ToolSolid::Sides outwardX;
  ToolSolid::Sides outwardY;
  double area;    // of a ring whose sides are 1 from the axis
  double apothem; // of a circle of radius 1 and the same area
};

Ring makeRing() noexcept
{
  constexpr double step = 2.0 * std::numbers::pi / ToolSolid::kSides;
  Ring ring{};
  for (std::size_t k = 0; k < ToolSolid::kSides; ++k)
  {
    const double at = step * static_cast<double>(k);
    ring.corners[k] = Eigen::Vector2d(std::cos(at), std::sin(at)) / std::cos(0.5 * step);
    const auto side = static_cast<Eigen::Index>(k);
    ring.outwardX[side] = std::cos(at + 0.5 * step);
    ring.outwardY[side] = std::sin(at + 0.5 * step);
  }
  ring.area = ToolSolid::kSides * std::tan(0.5 * step);
  ring.apothem = std::sqrt(std::numbers::pi / ring.area);
  return ring;
}

const Ring kRing = makeRing();

} // namespace

ToolSolid::ToolSolid(const Tip& tip, double inside) noexcept
  : flat_(palp::flatRadius(tip))
{
  const double base = baseRadius(tip);
  const auto* profile = std::get_if<ProfileTip>(&tip);
  const bool isCone = std::holds_alternative<ConeTip>(tip);
  double low = 0.0;
  double from = flat_;
  for (std::size_t i = isCone ? Profile::kCircles - 1 : 0; i < Profile::kCircles; ++i)
  {
    const double to = Profile::circleRadius(flat_, base, i);
    const double high =
      profile != nullptr ? profile->profile->circleDepths()[i] : contactDepth(tip, to);
    if (high - low > kFlattest * base)
    {
      add(low, high, from, to);
      low = high;
      from = to;
    }
  }
  add(low, std::max(low + kShaft * base, inside + kBeside * base), base, base);
}

ToolSolid::Layer ToolSolid::beyond() const noexcept
{
  Layer layer = layers_[count_ - 1];
  for (Field Layer::*field : { &Layer::volume, &Layer::lift })
  {
    const double entering = layer.upward(layer.*field, layer.high);
    layer.*field = { .constant = 0.0, .linear = 0.0, .entering = entering };
  }
  layer.low = layer.high;
  layer.high = kEndless;
  return layer;
}

void ToolSolid::add(double low, double high, double from, double to) noexcept
{
  const double slope = kRing.apothem * (to - from) / (high - low);
  Layer layer{ .low = low,
    .high = high,
    .radius = kRing.apothem * from,
    .slope = slope,
    .pole = slope > 0.0 ? low - kRing.apothem * from / slope : 0.0,
    .perSquare = 1.0 / std::hypot(1.0, slope),
    .below = 0.0 };
  for (Field Layer::*field : { &Layer::volume, &Layer::lift })
  {
    if (count_ > 0)
    {
      const Layer& under = layers_[count_ - 1];
      (layer.*field).entering = under.upward(under.*field, low);
    }
    if (!layer.isShaft())
    {
      const double rise = low - layer.pole;
      (layer.*field).twist =
        rise * rise * ((layer.*field).entering - layer.upward(layer.*field, low));
    }
  }
  if (count_ > 0) // of a pyramid cut off: another way to what the field says
  {
    const Layer& under = layers_[count_ - 1];
    const double area = crossArea(under.radius);
    const double areaAbove = crossArea(layer.radius);
    layer.below =
      under.below + (low - under.low) / 3.0 * (area + areaAbove + std::sqrt(area * areaAbove));
  }
  layers_[count_++] = layer;
}

double ToolSolid::crossArea(double radius) noexcept
{
  return kRing.area * radius * radius;
}

double ToolSolid::outerRadius() const noexcept
{
  return layers_[count_ - 1].radius * outerPart();
}

double ToolSolid::outerRadiusBelow(double height) const noexcept
{
  double radius = layers_[0].radius;
  for (const Layer& layer : layers())
  {
    radius += layer.slope * std::clamp(height - layer.low, 0.0, layer.high - layer.low);
  }
  return outerPart() * radius;
}

double ToolSolid::outerPart() noexcept
{
  return kRing.corners[0].x();
}

const std::array<Eigen::Vector2d, ToolSolid::kSides>& ToolSolid::corners() noexcept
{
  return kRing.corners;
}

const ToolSolid::Layer& ToolSolid::layerAt(double height) const noexcept
{
  std::size_t i = count_ - 1;
  while (i > 0 && height < layers_[i].low)
  {
    --i;
  }
  return layers_[i];
}

Sloped ToolSolid::radiusAt(double height) const noexcept
{
  const Layer& layer = layerAt(height);
  const double base = layers_[count_ - 1].radius;
  return smoothMin(
    { layer.radiusAt(std::max(height, layer.low)), height > layer.low ? layer.slope : 0.0 },
    { base }, kCorner * base);
}

const ToolSolid::Sides& ToolSolid::outwardX() noexcept
{
  return kRing.outwardX;
}

const ToolSolid::Sides& ToolSolid::outwardY() noexcept
{
  return kRing.outwardY;
}

Eigen::Vector3d ToolSolid::corner(const Layer& layer, double height, std::size_t k) noexcept
{
  const double radius = layer.radiusAt(height);
  const Eigen::Vector2d& to = kRing.corners[k];
  return { radius * to.x(), radius * to.y(), height };
}

} // namespace palp
