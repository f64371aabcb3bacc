#include "app/input/press_places.h"

#include "app/input/option_values.h"
#include "app/input/quantity.h"
#include "haptics/error.h"
#include "haptics/files/input_text.h"
#include "haptics/units.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <regex>

namespace palp
{

using namespace units::literals;

namespace
{

// as parseNumbers reads it: also what is pasted from a table, or has the minus sign of print
std::string withCommas(const std::string& text)
{
  static const std::regex minus("\u2212");
  static const std::regex blanks("[ \t]+");
  const std::string plain = std::regex_replace(std::string(trimmed(text)), minus, "-");
  return plain.find(',') == plain.npos ? std::regex_replace(plain, blanks, ",") : plain;
}

} // namespace

PressPlace parsePlace(const std::string& text, const std::string& what)
{
  const bool isWord = text.find_first_of("0123456789") == text.npos; // no number to ask for
  const std::vector<double> numbers =
    isWord ? std::vector<double>() : parseNumbers(withCommas(text), what);
  if (numbers.size() != 3)
  {
    throw Error(ErrorCode::BadValue,
      what + ": " + inQuotes(text) + " is no place; write x,y,z in mm, like -45,12.5,30");
  }
  PressPlace place;
  std::transform(numbers.begin(), numbers.end(), place.position.data(), units::fromMillimeters);
  constexpr double kFarthest = 10.0; // [m], as of a path
  if (place.position.cwiseAbs().maxCoeff() > kFarthest)
  {
    throw Error(ErrorCode::BadValue,
      what + ": " + inQuotes(text) + " is farther than 10 m from the origin; give millimeters");
  }
  return place;
}

Eigen::Vector3d parseDirection(const std::string& text, const std::string& what)
{
  const std::vector<double> parts = parseNumbers(text, what);
  const double norm = parts.size() == 3 ? Eigen::Vector3d(parts.data()).norm() : 0.0;
  if (!(norm > 1e-6 && norm < 1e6))
  {
    throw Error(ErrorCode::BadValue,
      what + ": " + inQuotes(text) + " is no direction; give three numbers, as 0,1,0");
  }
  return Eigen::Vector3d(parts.data());
}

double parsePressDepth(const std::string& text, const std::string& what)
{
  return parseWithin(text, Quantity::Length, { 10.0_um, 100.0_mm, "0.01mm to 100mm" }, what);
}

double parsePressSpeed(const std::string& text, const std::string& what)
{
  return parseWithin(text, Quantity::Speed, { 10.0_um, 1.0, "0.01mm/s to 1m/s" }, what);
}

void PlaceOptions::addTo(CLI::App& command)
{
  auto* at = command.add_option_function<std::vector<std::string>>(
    "--at",
    [this](const std::vector<std::string>& texts)
    {
      for (const std::string& text : texts)
      {
        presses.places.push_back(parsePlace(text));
      }
    },
    "Press at x,y,z in mm, in the frame of FILE (LPS for images and for what says SPACE=RAS), "
    "along "
    "the inward normal of the nearest surface; several are allowed");
  at->allow_extra_args(false)->type_name("X,Y,Z");
  command.add_option(
    "--points", points, "Press at the points of a list of 3D Slicer: .fcsv or .mrk.json");
  addParsed(command, "--toward",
    "Press where the line from each place along x,y,z first meets the surface", "",
    [this](const std::string& text)
    {
      presses.toward = parseDirection(text);
      isSpoken = true;
    });
  addParsed(command, "--depth", "How deep, at each place",
    quantityText(presses.depth, Quantity::Length),
    [this](const std::string& text)
    {
      presses.depth = parsePressDepth(text);
      isSpoken = true;
    });
  addParsed(command, "--speed", "How fast, down and up",
    quantityText(presses.speed, Quantity::Speed),
    [this](const std::string& text)
    {
      presses.speed = parsePressSpeed(text);
      isSpoken = true;
    });
}

} // namespace palp
