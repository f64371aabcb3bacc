#pragma once

#include <filesystem>
#include <functional>
#include <stop_token>
#include <string>

namespace palp::fem
{

/// Makes every table in data/tables by finite elements:
///
/// R_d of spheres of 6 and 10 mm and of the 45 degree cone, with the calibrated surface curves;
/// the ratio of the neo-Hookean to the linear force of sphere and cone on layers; and the surface
/// under a sphere over (depth / R, R / thickness, nu).
///
/// Takes four minutes of one core. A stop leaves some of them out.
///
/// @param folder  exists
/// @param tell    called before each case with its name
/// @throws Error  BadFile: not writable
void makeShippedTables(const std::filesystem::path& folder, const std::stop_token& stop,
  const std::function<void(const std::string&)>& tell);

} // namespace palp::fem
