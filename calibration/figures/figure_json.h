#pragma once

#include "calibration/figures/figure.h"

#include <nlohmann/json_fwd.hpp>

namespace palp::figures
{

[[nodiscard]] nlohmann::ordered_json toJson(const Table& table);

/// @throws nlohmann::json::exception  not what toJson() made
[[nodiscard]] Table tableOf(const nlohmann::ordered_json& json);

[[nodiscard]] nlohmann::ordered_json toJson(const Figure& figure);

/// @throws nlohmann::json::exception  not what toJson() made
[[nodiscard]] Figure figureOf(const nlohmann::ordered_json& json);

} // namespace palp::figures
