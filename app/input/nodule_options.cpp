#include "app/input/nodule_options.h"

#include "app/input/quantity.h"
#include "haptics/error.h"
#include "haptics/files/input_text.h"
#include "haptics/units.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>

namespace palp
{
namespace
{

using namespace units::literals;

constexpr double kLeastDepth = 1.0_mm; // that tables reach, so that a press of 0 has one

// as nodules in a plane through the tool's axis
void checkPlaces(const std::vector<OffsetNodule>& nodules)
{
  std::vector<Nodule> balls;
  std::vector<Eigen::Vector3d> places;
  for (const OffsetNodule& one : nodules)
  {
    balls.push_back(one.nodule);
    places.emplace_back(one.offset, 0.0, one.nodule.depth());
  }
  checkApart(balls, places);
}

} // namespace

OffsetNodule parseNodule(std::string_view text, std::string_view what)
{
  const std::string name(what);
  const std::vector<std::string_view> fields = split(text, ':');
  if (fields.size() != 3 && fields.size() != 4)
  {
    throw Error(ErrorCode::BadValue,
      name + ": " + inQuotes(text) +
        " has not the form 4mm:5mm:10 or 4mm:5mm:10:8mm (radius, depth of its highest point, its "
        "stiffness over that of the tissue, distance from the tool's axis); write it like that");
  }
  OffsetNodule one{ .nodule = checkedNodule({ parseQuantity(fields[0], Quantity::Length, what),
                                              parseQuantity(fields[1], Quantity::Length, what),
                                              parseNumber(fields[2], what) },
                      name) };
  if (fields.size() == 4)
  {
    one.offset =
      parseWithin(fields[3], Quantity::Length, { 0.0, 1.0, "0mm to 1m" }, name + ", distance");
  }
  return one;
}

NodulesUnderTool::NodulesUnderTool(const std::vector<OffsetNodule>& nodules, const ForceLaw& law,
  const ContactGeometry& place, double deepest)
  : thickness_(place.thickness)
  , constitution_(law.settings().constitution)
{
  checkPlaces(nodules);
  for (const OffsetNodule& one : nodules)
  {
    nodules_.push_back(one.nodule);
    offsets_.push_back(one.offset);
    squares_.push_back(one.offset * one.offset);
  }
  energy_.emplace(HomogeneousPress(law, place, std::max(deepest, kLeastDepth)), nodules_);
}

NodulesUnderTool::Felt NodulesUnderTool::at(double depth) const noexcept
{
  const Nodules::Answer answer = (*energy_)(depth, squares_);
  Felt felt{ .response = answer.response };
  for (std::size_t i = 0; i < offsets_.size(); ++i)
  {
    felt.lateral += answer.repulsion[i] * offsets_[i];
  }
  return felt;
}

NoduleRules NodulesUnderTool::rules(double depth, const Response& plain) const noexcept
{
  const double added = at(depth).response.force;
  const double force = plain.force + added;
  return noduleRules(nodules_,
    { .depth = depth,
      .contactRadius = plain.contactRadius,
      .thickness = thickness_,
      .added = force > 0.0 ? added / force : 0.0 },
    constitution_);
}

void NoduleOptions::addTo(CLI::App& command)
{
  command
    .add_option_function<std::vector<std::string>>(
      "--nodule",
      [this](const std::vector<std::string>& texts)
      {
        nodules.clear();
        for (const std::string& text : texts)
        {
          nodules.push_back(parseNodule(text));
        }
      },
      "A ball of other tissue below the tool, for --law corrected: RADIUS:TOP:RATIO[:OFFSET], as "
      "in "
      "4mm:5mm:10:8mm (TOP: depth of its highest point, RATIO: its stiffness over that of the "
      "tissue, OFFSET: beside the tool); may stand several times")
    ->allow_extra_args(false);
}

std::optional<NodulesUnderTool> NoduleOptions::under(
  const ForceLaw& law, const ContactGeometry& place, double deepest) const
{
  if (nodules.empty())
  {
    return std::nullopt;
  }
  if (!law.settings().coatings.empty())
  {
    throw Error(ErrorCode::BadValue,
      "--nodule: below a coating its force is not known; leave out --coating, or the nodule");
  }
  try
  {
    return NodulesUnderTool(nodules, law, place, deepest);
  }
  catch (const Error& error)
  {
    throw Error(error.code(), std::string("--nodule: ") + error.what());
  }
}

} // namespace palp
