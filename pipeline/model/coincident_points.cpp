#include "pipeline/model/coincident_points.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace palp
{
namespace
{

using Shown = std::array<float, 3>;

// nothing: not finite
std::optional<Shown> shownOf(const Eigen::Vector3d& point)
{
  // what is next to nothing beside the others is the rounding of 0, as sin(pi) has it
  const double nothing = point.cwiseAbs().maxCoeff() * 0x1p-32;
  const Eigen::Vector3f x =
    (point.array().abs() <= nothing).select(0.0, point.array()).matrix().cast<float>();
  const auto withoutSign = [](float value) { return value + 0.0F; }; // of 0
  return x.allFinite()
    ? std::optional(Shown{ withoutSign(x[0]), withoutSign(x[1]), withoutSign(x[2]) })
    : std::nullopt;
}

std::size_t hashOf(const Shown& point)
{
  std::uint64_t hash = 0;
  for (const float x : point)
  {
    constexpr std::uint64_t kGolden = 0x9E3779B97F4A7C15;
    hash = (hash ^ std::bit_cast<std::uint32_t>(x)) * kGolden;
    hash ^= hash >> 32U;
  }
  return hash;
}

} // namespace

std::vector<int> firstOfEach(std::span<const Eigen::Vector3d> points)
{
  std::vector<Shown> shown(points.size());
  std::vector<int> first(points.size());
  std::vector<int> table(std::bit_ceil(2 * points.size() + 1), -1); // of the first ones, by hash
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    first[i] = static_cast<int>(i);
    const std::optional<Shown> finite = shownOf(points[i]);
    if (!finite)
    {
      continue;
    }
    shown[i] = *finite;
    std::size_t slot = hashOf(shown[i]) & (table.size() - 1);
    while (table[slot] >= 0 && shown[static_cast<std::size_t>(table[slot])] != shown[i])
    {
      slot = (slot + 1) & (table.size() - 1);
    }
    table[slot] = table[slot] < 0 ? first[i] : table[slot];
    first[i] = table[slot];
  }
  return first;
}

} // namespace palp
