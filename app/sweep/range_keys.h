#pragma once

#include "app/sweep/sweep.h"
#include "app/sweep/sweep_range.h"

#include <initializer_list>
#include <string>
#include <vector>

namespace palp
{

class JsonObject;

/// Refuses a key that is none of these, before what the object lacks is told: that may be what was
/// misspelled.
/// @throws Error  BadFile: names it
void refuseUnknown(JsonObject& object, std::initializer_list<const char*> keys);

/// A whole number.
/// @param why     follows the message
/// @throws Error  BadFile: none, or out of its range
[[nodiscard]] std::size_t countOf(JsonObject& object, const char* key, std::size_t least,
  const std::string& why, std::size_t most = kMostCases);

/// "from" and "to" in one unit, "scale" linear or log.
/// @throws Error  BadFile: no such range
[[nodiscard]] SweepRange rangeOf(JsonObject& object);

/// The values of a range by its "count", or by a "step" that meets both ends.
/// @throws Error  BadFile: no such range, an unknown key
[[nodiscard]] std::vector<std::string> rangeValues(JsonObject object);

} // namespace palp
