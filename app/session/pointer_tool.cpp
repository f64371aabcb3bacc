#include "app/session/pointer_tool.h"

#include "haptics/surface/closest_point.h"
#include "haptics/surface/ray.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace palp
{

namespace
{

constexpr double kApart = 0.06; // of two presses, longer than a bounce [s]

} // namespace

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

// what is pressed is given back: the tool rises from there, and is apart for longer than a bounce
void PointerTool::lift(double time)
{
  const double depth = std::min(given_ ? given_->deepest : pressed_, deepest_);
  apartAt_ = depth > 0.0 ? time + depth / GuidedTool::kSpeed + kApart : apartAt_;
  pressed_ = 0.0;
  given_.reset();
}

bool PointerTool::press(int x, int y, double time)
{
  lift(time);
  hover(x, y);
  pressing_ = below(*last_).has_value();
  if (pressing_)
  {
    from_ = std::max(held_, kTouch);
    pressed_ = from_;
    pressedAt_ = held_ > 0.0 ? time : std::max(time, apartAt_);
    isLifting_ = pressedAt_ > time;
  }
  return pressing_;
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
  pressed_ != from_ ? lift(time) : void();
  pressing_ = false;
  last_.reset(); // the drag was no way over the surface
  update(time);
}

void PointerTool::wheel(int notches)
{
  const bool isBeside = !pressing_ && last_ && !below(*last_);
  isBeside ? void() : deepen(notches * kDepthPerNotch);
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

void PointerTool::lead(const Sample& newest)
{
  if (!given_)
  {
    return;
  }
  constexpr double kMost = 0.05; // of a call [s]
  constexpr double kNever = 1.0; // without touch, the tool does not fit there [s]
  constexpr double kSlow = 0.1;  // of its speed, below which the tool is where it can get
  using Phase = Given::Phase;
  Given& given = *given_;
  given.waited += std::clamp(newest.time - given.last.value_or(newest.time), 0.0, kMost);
  given.last = newest.time;
  const double depth = newest.contact.touching() ? newest.contact.depth : 0.0;
  if (given.phase == Phase::Rise)
  {
    depth > 0.0 ? void() : given_.reset();
  }
  else if (given.phase == Phase::Lift)
  {
    given.waited = depth > 0.0 ? 0.0 : given.waited;
    given.phase = given.waited >= kApart ? Phase::Press : Phase::Lift;
    given.waited = given.phase == Phase::Press ? 0.0 : given.waited;
  }
  else if (depth > given.deepest + kSlow * given.speed * given.waited)
  {
    given.deepest = depth;
    given.waited = 0.0;
  }
  else if (given.waited >= (given.deepest > 0.0 ? kShortest : kNever))
  {
    given.phase = Phase::Rise;
  }
}

void PointerTool::letGo()
{
  given_.reset();
  pressing_ = false;
  isLifting_ = false;
  held_ = 0.0;
  pressed_ = 0.0;
  last_.reset();
}

void PointerTool::update(double time)
{
  isLifting_ = isLifting_ && time < pressedAt_;
  if (!pressing_ && pressed_ > 0.0 && time - pressedAt_ >= kShortest)
  {
    lift(time);
  }
}

std::optional<PressTarget> PointerTool::target() const
{
  if (!point_)
  {
    return std::nullopt;
  }
  const bool isGiven = given_ && given_->phase != Given::Phase::Lift;
  const double wanted = isLifting_ ? 0.0
    : given_                       ? (given_->phase == Given::Phase::Press ? given_->depth : 0.0)
    : pressing_ || pressed_ > 0.0  ? pressed_
                                   : held_;
  return PressTarget{ .position = point_->position,
    .normal = point_->normal,
    .depth = std::min(wanted, deepest_),
    .speed = isGiven ? given_->speed : 0.0 };
}

} // namespace palp
