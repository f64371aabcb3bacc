#pragma once

#include "app/report/document.h"
#include "app/report/stability_map.h"

#include <functional>
#include <stop_token>
#include <string>
#include <vector>

namespace palp
{

/// Judges every case, on all processors.
/// @param quick  a tenth of them
/// @param tell   the part that is judged, 0 to 1; from several threads
/// @return       only what was judged before a stop
[[nodiscard]] std::vector<JudgedCase> judgeAll(
  bool quick, std::stop_token stop = {}, const std::function<void(double)>& tell = {});

/// Two rows a case: through the safety chain, and without.
[[nodiscard]] report::Table stabilityTable(const std::vector<JudgedCase>& cases);

/// How many were stable, limited, refused and unstable, with the cases behind each exception.
[[nodiscard]] std::string stabilitySummary(const std::vector<JudgedCase>& cases);

} // namespace palp
