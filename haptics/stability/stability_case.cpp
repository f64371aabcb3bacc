#include "haptics/stability/stability_case.h"

#include "haptics/servo/sample.h"

namespace palp
{
namespace
{

struct Stage
{
  Flag flag;
  const char* name;
};

// in the order of the chain
constexpr Stage kStages[] = { { Flag::Late, "late" }, { Flag::StiffnessLimited, "stiffness" },
  { Flag::Rebased, "rebase" }, { Flag::DampingLimited, "damping" },
  { Flag::Passivity, "passivity" }, { Flag::Limited, "force" }, { Flag::SlewLimited, "slew" } };

} // namespace

std::string stagesIn(std::uint32_t flags)
{
  std::string names;
  for (const auto& [flag, name] : kStages)
  {
    if ((flags & static_cast<std::uint32_t>(flag)) != 0)
    {
      names.append(names.empty() ? "" : "+").append(name);
    }
  }
  return names.empty() ? "none" : names;
}

} // namespace palp
