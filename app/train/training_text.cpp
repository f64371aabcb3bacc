#include "app/train/training_text.h"

#include "app/input/quantity.h"
#include "haptics/error.h"
#include "haptics/files/input_text.h"

#include <cmath>

namespace palp
{
namespace
{

constexpr double kMostNodules = 12.0;

double wholeWithin(const std::string& text, double least, double most, const std::string& what)
{
  const double value = parseNumber(text, what);
  if (!(value >= least && value <= most) || value != std::floor(value))
  {
    throw Error(ErrorCode::BadValue,
      what + ": " + inQuotes(text) + " is no whole number from " +
        std::to_string(std::llround(least)) + " to " + std::to_string(std::llround(most)) +
        "; give one");
  }
  return value;
}

} // namespace

std::uint32_t parseSeed(const std::string& text, const std::string& what)
{
  return static_cast<std::uint32_t>(wholeWithin(text, 0.0, 0xffff'ffffU, what));
}

int parseNoduleCount(const std::string& text, const std::string& what)
{
  return static_cast<int>(wholeWithin(text, 1.0, kMostNodules, what));
}

} // namespace palp
