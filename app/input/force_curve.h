#pragma once

#include "pipeline/model/reference_curve.h"

#include <filesystem>

namespace palp
{

/// Reads F(depth) from a CSV whose header names depth_mm and force_N among any others: a table of
/// `palp force`, of `palp calibrate`, an exported samples.csv, or a measurement.
///
/// Of a recording, which has a column time_s, the loading part is taken: each row that is deeper
/// than all before it.
///
/// @return        named as the file
/// @throws Error  BadFile: as NumberTable::readColumns; no row
[[nodiscard]] ReferenceCurve readForceCurve(const std::filesystem::path& file);

} // namespace palp
