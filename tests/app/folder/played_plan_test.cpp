#include "app/folder/played_plan.h"

#include <gtest/gtest.h>

namespace palp
{
namespace
{

// whatever a law takes into account
TEST(PlayedPlan, RepeatsTheLawThatWasInUse)
{
  LawOptions options{ .mode = LawMode::Corrected, .base = Base::Slip, .friction = 0.3 };
  options.relaxation = parseRelaxation("0.3:50ms,0.2:1s");
  options.constitution = ConstitutiveModel::Linear;
  Recording recording;
  recording.scene.law = ForceLaw(SphereTip{ 5e-3 }, { 20e3, 0.45 }, options.settings());
  recording.scene.rule = ContactRule::Paper;
  recording.scene.damping = 0.7;

  const ScenePlan plan = planOf({}, {}, recording);
  const ForceLaw law = plan.press.tissue.law();
  EXPECT_EQ(law.settings().friction, 0.3);
  EXPECT_EQ(describeRelaxation(law.settings().relaxation), "0.3:0.05s,0.2:1s");
  EXPECT_EQ(law.settings().base, Base::Slip);
  EXPECT_EQ(law.settings().constitution, ConstitutiveModel::Linear);
  EXPECT_EQ(law.material().youngModulus, 20e3);
  EXPECT_EQ(plan.press.contact, ContactRule::Paper);
  EXPECT_EQ(plan.press.damping, 0.7);
}

} // namespace
} // namespace palp
