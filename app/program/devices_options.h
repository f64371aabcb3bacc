#pragma once

#include <string>

namespace palp
{

/// The whole of `palp devices`.
struct DevicesOptions
{
  std::string probe{};    ///< as a user names a device; empty: none
  std::string identify{}; ///< the same: measure it
  std::string added{};    ///< a mass on its handle, as 100g; empty: none
  std::string home{};     ///< as probe: move this board to its zero
  bool watch = false;
};

} // namespace palp
