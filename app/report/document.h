#pragma once

#include "calibration/figures/figure.h"

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace palp::report
{

using figures::Cell;
using figures::Curve;
using figures::Figure;
using figures::pointsOf;
using figures::shown;
using figures::Table;

/// A figure that a part has drawn itself.
struct Picture
{
  std::string name; ///< of the SVG file
  std::string caption;
  std::string svg;
};

/// A figure or statement of the paper, and what came out here.
struct Claim
{
  std::string of;      ///< the paper: "Fig. 3", "Eq. (7)"
  std::string paper;   ///< what it says
  std::string here;    ///< what was found
  std::string verdict; ///< agreement, or the reason for the difference
};

/// What one part of the report found.
struct Section
{
  std::string name; ///< of the part and its JSON
  std::string title;
  std::vector<std::string> text{}; ///< paragraphs
  std::vector<Claim> claims{};
  std::vector<Table> tables{};
  std::vector<Figure> figures{}; ///< of these tables
  std::vector<Picture> pictures{};
};

/// Letters and digits of a name, joined by _, for files and anchors.
[[nodiscard]] std::string fileWord(const std::string& name);

[[nodiscard]] nlohmann::ordered_json toJson(const Section& section);

/// @throws nlohmann::json::exception  not what toJson() made
[[nodiscard]] Section sectionOf(const nlohmann::ordered_json& json);

} // namespace palp::report
