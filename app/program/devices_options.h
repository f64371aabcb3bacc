#pragma once

#include <string>

namespace palp
{

/// The whole of `palp devices`.
struct DevicesOptions
{
  std::string probe; ///< as a user names a device; empty: none
  bool watch = false;
};

} // namespace palp
