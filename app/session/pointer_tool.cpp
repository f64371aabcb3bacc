#include "app/session/pointer_tool.h"

#include "haptics/surface/closest_point.h"
#include "haptics/surface/ray.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace palp
{

PointerTool::PointerTool(std::function<SightLine(double, double)> view)
  : view_(std::move(view))
{
}

void PointerTool::setSurfaces(std::vector<std::shared_ptr<const Surface>> surfaces)
{
  surfaces_ = std::move(surfaces);
  letGo();
  point_.reset();
  last_.reset();
}

std::optional<SurfacePoint> PointerTool::below(const Pixel& pixel) const
{
  const SightLine line = view_(pixel.x, pixel.y);
  const auto distance = [&line](const SurfacePoint& point)
  { return (point.position - line.origin).squaredNorm(); };
  std::optional<SurfacePoint> first;
  for (const auto& surface : surfaces_)
  {
    const auto point = pick(*surface, line.origin, line.direction);
    first = point && (!first || distance(*point) < distance(*first)) ? point : first;
  }
  return first;
}

// between two events: motion comes merged, the more so the slower the machine
bool PointerTool::leftSurface(const Pixel& to) const
{
  constexpr double kStep = 4.0;   // [pixels]
  constexpr double kMost = 500.0; // steps
  const Pixel from = last_.value_or(to);
  const double steps =
    std::clamp(std::ceil(std::hypot(to.x - from.x, to.y - from.y) / kStep), 1.0, kMost);
  for (double i = 1.0; i <= steps; ++i)
  {
    const double fraction = i / steps;
    if (!below({ from.x + fraction * (to.x - from.x), from.y + fraction * (to.y - from.y) }))
    {
      return true;
    }
  }
  return false;
}

// that which the point is on
const Surface& PointerTool::surfaceAt(const SurfacePoint& point) const
{
  const auto distance = [&point](const std::shared_ptr<const Surface>& surface)
  {
    constexpr double kAnywhere = std::numeric_limits<double>::infinity();
    return (findClosestPoint(*surface, point.position, kAnywhere).point - point.position).norm();
  };
  return surfaces_.size() == 1 ? *surfaces_.front()
                               : **std::ranges::min_element(surfaces_, {}, distance);
}

void PointerTool::moveTo(const SurfacePoint& point)
{
  const BoxTree& tree = surfaceAt(point).tree();
  point_ = point;
  deepest_ = std::min(kMaxDepth, 0.5 * rayExit(tree, point.position, -point.normal).distance);
}

void PointerTool::hover(int x, int y)
{
  const Pixel pixel{ static_cast<double>(x), static_cast<double>(y) };
  if (held_ > 0.0 && leftSurface(pixel))
  {
    letGo();
  }
  last_ = pixel;
  const bool stays = pressed_ > 0.0 || given_; // a click that is shown, or a press by itself
  if (const auto point = below(pixel); point && !stays)
  {
    moveTo(*point);
  }
}

void PointerTool::press(int x, int y, double time)
{
  pressed_ = 0.0;
  given_.reset();
  hover(x, y);
  if (below(*last_))
  {
    pressing_ = true;
    pressedAt_ = time;
    from_ = std::max(held_, kTouch);
    pressed_ = from_;
  }
}

void PointerTool::drag(int pixelsDown)
{
  if (pressing_)
  {
    pressed_ = std::max(0.0, from_ + pixelsDown * kDepthPerPixel);
  }
}

void PointerTool::release(double time)
{
  if (pressed_ != from_)
  {
    pressed_ = 0.0;
  }
  pressing_ = false;
  last_.reset(); // the drag was no way over the surface
  update(time);
}

void PointerTool::wheel(int notches)
{
  deepen(notches * kDepthPerNotch);
}

void PointerTool::deepen(double by)
{
  if (!point_)
  {
    return;
  }
  given_.reset();
  double& depth = pressing_ ? pressed_ : held_;
  const double before = std::min(depth, deepest_);
  depth = std::clamp(before + by, 0.0, deepest_);
  from_ += depth - before; // of a drag that goes on
}

void PointerTool::turnView()
{
  last_.reset();
}

void PointerTool::pressAt(const SurfacePoint& point, double depth, double speed)
{
  letGo();
  moveTo(point);
  given_ = { .depth = depth, .speed = speed };
}

void PointerTool::lead(double time)
{
  if (!given_)
  {
    return;
  }
  constexpr double kMost = 0.05; // [s]
  const double passed = std::clamp(time - given_->last.value_or(time), 0.0, kMost);
  given_->last = time;
  if (given_->rested >= kShortest)
  {
    given_->now -= given_->speed * passed;
    given_->now < 0.0 ? given_.reset() : void();
  }
  else if (given_->now < given_->depth)
  {
    given_->now = std::min(given_->depth, given_->now + given_->speed * passed);
  }
  else
  {
    given_->rested += passed;
  }
}

void PointerTool::letGo()
{
  given_.reset();
  pressing_ = false;
  held_ = 0.0;
  pressed_ = 0.0;
  last_.reset();
}

void PointerTool::update(double time)
{
  if (!pressing_ && time - pressedAt_ >= kShortest)
  {
    pressed_ = 0.0;
  }
}

std::optional<PressTarget> PointerTool::target() const
{
  if (!point_)
  {
    return std::nullopt;
  }
  const double wanted = given_ ? given_->now : pressing_ || pressed_ > 0.0 ? pressed_ : held_;
  return PressTarget{
    .position = point_->position, .normal = point_->normal, .depth = std::min(wanted, deepest_)
  };
}

} // namespace palp
