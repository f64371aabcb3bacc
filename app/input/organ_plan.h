#pragma once

#include "app/input/press_options.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace palp
{

/// What tool and eye meet of an organ.
enum class OrganRole
{
  Press,   ///< felt, opaque
  Through, ///< not felt, seen through
  Show,    ///< not felt, opaque
  Hide,    ///< neither felt nor seen
};

using OrganColor = std::array<std::uint8_t, 3>; ///< red, green, blue

/// One of several organs in a scene; its surface stands in the scene's meshes, at the same place.
struct OrganPlan
{
  std::string name; ///< no other has it
  OrganRole role = OrganRole::Press;
  OrganColor color{ 0x8c, 0x33, 0x28 };
  PressOptions press{}; ///< its tissue; the tool, the law and the dent are those of the scene

  [[nodiscard]] bool isFelt() const noexcept
  {
    return role == OrganRole::Press;
  }
};

/// The places of the felt ones in a list, in their order: that of organs in a Sample.
[[nodiscard]] inline std::vector<std::size_t> feltOrgans(const std::vector<OrganPlan>& organs)
{
  std::vector<std::size_t> felt;
  for (std::size_t i = 0; i < organs.size(); ++i)
  {
    organs[i].isFelt() ? felt.push_back(i) : void();
  }
  return felt;
}

} // namespace palp
