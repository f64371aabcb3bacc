#include "haptics/surface/sharp_edges.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace palp
{
namespace
{

constexpr std::size_t kDepth = 40; // of a tree that is halved, for more than fits any memory

Eigen::Vector3f middleOf(const SharpEdges::Segment& segment)
{
  return 0.5F * (segment[0] + segment[1]);
}

float distanceTo(const SharpEdges::Segment& segment, const Eigen::Vector3f& position) noexcept
{
  const Eigen::Vector3f along = segment[1] - segment[0];
  const float squared = along.squaredNorm();
  const float at = squared > 0.0F ? along.dot(position - segment[0]) / squared : 0.0F;
  return (segment[0] + std::clamp(at, 0.0F, 1.0F) * along - position).norm();
}

} // namespace

SharpEdges::SharpEdges(std::vector<Segment> segments)
{
  if (!segments.empty())
  {
    nodes_.reserve(2 * segments.size());
    build(segments);
  }
}

void SharpEdges::build(std::span<Segment> segments)
{
  Eigen::Vector3f low = segments.front()[0];
  Eigen::Vector3f high = low;
  for (const Segment& segment : segments)
  {
    low = low.cwiseMin(segment[0]).cwiseMin(segment[1]);
    high = high.cwiseMax(segment[0]).cwiseMax(segment[1]);
  }
  const std::size_t self = nodes_.size();
  nodes_.push_back({ 0.5F * (low + high), 0.5F * (high - low).norm(), 0, segments.front() });
  if (segments.size() == 1)
  {
    return;
  }
  Eigen::Index widest = 0;
  (high - low).maxCoeff(&widest);
  const std::size_t half = segments.size() / 2;
  std::nth_element(segments.begin(), segments.begin() + static_cast<std::ptrdiff_t>(half),
    segments.end(),
    [&](const Segment& a, const Segment& b) { return middleOf(a)[widest] < middleOf(b)[widest]; });
  build(segments.first(half));
  nodes_[self].right = static_cast<std::int32_t>(nodes_.size());
  build(segments.subspan(half));
}

float SharpEdges::distance(const Eigen::Vector3f& position) const noexcept
{
  float nearest = std::numeric_limits<float>::infinity();
  const auto atLeast = [&](std::size_t i)
  { return (nodes_[i].center - position).norm() - nodes_[i].radius; };
  std::array<std::size_t, kDepth> stack{};
  std::size_t waiting = nodes_.empty() ? 0 : 1;
  while (waiting > 0)
  {
    const std::size_t i = stack[--waiting];
    if (atLeast(i) >= nearest)
    {
      continue;
    }
    const Node& node = nodes_[i];
    if (node.right == 0)
    {
      nearest = std::min(nearest, distanceTo(node.segment, position));
      continue;
    }
    std::size_t near = i + 1;
    auto far = static_cast<std::size_t>(node.right);
    if (atLeast(far) < atLeast(near))
    {
      std::swap(near, far);
    }
    stack[waiting++] = far;
    stack[waiting++] = near;
  }
  return nearest;
}

} // namespace palp
