#pragma once

#include "app/report/document.h"
#include "app/report/stability_map.h"

#include <stop_token>
#include <string>
#include <vector>

namespace palp
{

/// Judges every case, on all processors.
/// @param quick  a tenth of them
/// @return       only what was judged before a stop
[[nodiscard]] std::vector<JudgedCase> judgeAll(bool quick, std::stop_token stop = {});

/// Two rows a case: through the safety chain, and without.
[[nodiscard]] report::Table stabilityTable(const std::vector<JudgedCase>& cases);

/// How many were stable, limited, refused and unstable, with the cases behind each exception.
[[nodiscard]] std::string stabilitySummary(const std::vector<JudgedCase>& cases);

} // namespace palp
