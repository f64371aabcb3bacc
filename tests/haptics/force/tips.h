#pragma once

#include "haptics/tip/profile.h"
#include "haptics/tip/tip.h"
#include "haptics/units.h"

#include <memory>
#include <vector>

namespace palp::test
{

/// One tip of every shape that has a closed form.
inline std::vector<Tip> closedFormTips()
{
  using namespace units::literals;
  return { SphereTip{ 10.0_mm }, ConeTip{ 30.0_deg, 10.0_mm }, PunchTip{ 5.0_mm },
    TruncatedConeTip{ 45.0_deg, 2.0_mm, 10.0_mm }, BluntConeTip{ 60.0_deg, 3.0_mm, 10.0_mm },
    ParaboloidTip{ 10.0_mm } };
}

/// Those and a profile with a corner.
inline std::vector<Tip> allTips()
{
  using namespace units::literals;
  std::vector<Tip> tips = closedFormTips();
  tips.push_back(ProfileTip{ std::make_shared<const Profile>(
    std::vector<Profile::Point>{ { 0.0, 0.0 }, { 2.0_mm, 1.0_mm }, { 6.0_mm, 5.0_mm } }) });
  return tips;
}

} // namespace palp::test
