#pragma once

#include "haptics/tip/tip.h"
#include "pipeline/model/reference_curve.h"

#include <filesystem>
#include <string>

namespace palp
{

/// F(depth) as it stands in a CSV, row by row.
struct ForceRows
{
  ReferenceCurve curve; ///< named as the file
  bool recorded;        ///< has a column time_s
  std::string tool;     ///< that an exported samples.csv names; else empty
  bool isInBody;        ///< has a column local_depth_mm: the body gave way by an organ file
};

/// Reads F(depth) from a CSV whose header names depth_mm and force_N among any others: a table of
/// `palp force`, of `palp calibrate`, an exported samples.csv, or a measurement.
/// @throws Error  BadFile: as NumberTable::readRecording; no row
[[nodiscard]] ForceRows readForceRows(const std::filesystem::path& file);

/// The same over the depth of the contact by itself where the body gave way, else over depth_mm.
/// @throws Error  as readForceRows
[[nodiscard]] ForceRows readContactRows(const std::filesystem::path& file);

/// What to say of rows that were recorded with another tool than they are taken for; else empty.
[[nodiscard]] std::string noteOfTool(const ForceRows& rows, const Tip& tip);

/// The same without what is no loading: of a recording each row that is deeper than all before it.
/// @throws Error  as readForceRows
[[nodiscard]] ReferenceCurve readForceCurve(const std::filesystem::path& file);

} // namespace palp
