#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace CLI
{
class App;
}

namespace palp
{

/// A place that is to be pressed.
struct PressPlace
{
  std::string name{};                                 ///< for people; empty: none
  Eigen::Vector3d position = Eigen::Vector3d::Zero(); ///< near the surface, in its frame [m]

  bool operator==(const PressPlace&) const = default;
};

/// Presses of one depth at places, one after the other.
struct PlacedPresses
{
  std::vector<PressPlace> places{};
  double depth = 5e-3;                     ///< of the contact [m]
  double speed = 0.01;                     ///< down and up [m/s]
  std::optional<Eigen::Vector3d> toward{}; ///< presses where the line from a place along this first
                                           ///< meets the surface; none: at its nearest point

  bool operator==(const PlacedPresses&) const = default;
};

/// The same as options; --points is a file of places.
struct PlaceOptions
{
  PlacedPresses presses{};
  std::filesystem::path points{}; ///< see readFiducials; empty: none
  bool isSpoken = false;          ///< a depth, a speed or a direction was given

  void addTo(CLI::App& command);
};

// Their text, for options, scenes and window alike.
// Error BadValue: names the option, what is wrong and how to write it

/// `x,y,z` in mm, as a place without a name.
[[nodiscard]] PressPlace parsePlace(const std::string& text, const std::string& what = "--at");
[[nodiscard]] Eigen::Vector3d parseDirection(
  const std::string& text, const std::string& what = "--toward"); ///< `x,y,z`, of any length but 0
[[nodiscard]] double parsePressDepth(
  const std::string& text, const std::string& what = "--depth"); ///< [m]
[[nodiscard]] double parsePressSpeed(
  const std::string& text, const std::string& what = "--speed"); ///< [m/s]

} // namespace palp
