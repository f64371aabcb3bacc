#include "calibration/tables/table_tool.h"

#include "haptics/files/input_text.h"
#include "haptics/force/linear/contact_depth.h"
#include "haptics/tip/profile.h"
#include "haptics/units.h"

#include <filesystem>
#include <sstream>
#include <variant>

namespace palp
{
namespace
{

using units::toMillimeters;

} // namespace

std::string toolInWords(const Tip& tip, int digits)
{
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out.precision(digits);
  const double base = toMillimeters(baseRadius(tip));
  if (std::holds_alternative<SphereTip>(tip))
  {
    out << "sphere, R = " << base << " mm";
  }
  else if (const auto* cone = std::get_if<ConeTip>(&tip))
  {
    out << "cone, " << units::toDegrees(cone->halfAngle) << " deg, base " << base << " mm";
  }
  else if (const auto* blunt = std::get_if<BluntConeTip>(&tip))
  {
    out << "cone, " << units::toDegrees(blunt->halfAngle) << " deg, tangent cap "
        << toMillimeters(blunt->tipRadius) << " mm, base " << base << " mm";
  }
  else if (const auto* truncated = std::get_if<TruncatedConeTip>(&tip))
  {
    out << "truncated cone, " << units::toDegrees(truncated->halfAngle) << " deg, flat "
        << toMillimeters(truncated->flatRadius) << " mm, base " << base << " mm";
  }
  else if (const auto* profile = std::get_if<ProfileTip>(&tip))
  {
    // every point has its part in the depth at which the whole of it is in contact
    const auto file = std::filesystem::path(profile->profile->name()).filename();
    out << "profile of revolution " << file.string() << (file.empty() ? "" : ", ") << "base "
        << base << " mm, height " << toMillimeters(tipHeight(tip, baseRadius(tip)))
        << " mm, all in contact with a half-space at "
        << toMillimeters(contactDepth(tip, baseRadius(tip))) << " mm";
  }
  else
  {
    out << (std::holds_alternative<PunchTip>(tip) ? "flat punch" : "paraboloid") << ", R = " << base
        << " mm";
  }
  return out.str();
}

std::string toolOfTable(const std::filesystem::path& file)
{
  const std::string text = readText(file, "a table of palp calibrate");
  const std::size_t begin = text.find(kToolLine);
  if (begin == std::string::npos)
  {
    return "";
  }
  const std::size_t first = begin + kToolLine.size();
  return text.substr(first, text.find_first_of(";\r\n", first) - first);
}

bool isToolOfTable(const Tip& tip, const std::string& inTable)
{
  const std::string words = toolInWords(tip);
  if (!std::holds_alternative<ConeTip>(tip))
  {
    return words == inTable;
  }
  // a sharp one was computed with a cap
  const std::size_t angle = words.find(" deg") + 4;
  return inTable.starts_with(words.substr(0, angle)) &&
    inTable.ends_with(words.substr(words.rfind(", ")));
}

} // namespace palp
