#include "haptics/devices/simulated/lagging_tool.h"

#include "haptics/contact/embed_nodules.h"
#include "haptics/servo/servo_step.h"
#include "haptics/units.h"
#include "tests/support/allocation_guard.h"
#include "tests/support/surfaces.h"

#include <array>
#include <gtest/gtest.h>

namespace palp
{
namespace
{

using namespace units::literals;

// holds the tool where it was told
class Held final : public Device
{
public:
  explicit Held(const ToolPose& pose)
    : pose_(pose)
  {
  }

  [[nodiscard]] DeviceLimits limits() const override
  {
    return { .model = "held" };
  }
  [[nodiscard]] std::optional<ToolPose> exchange(const Wrench&, double) noexcept override
  {
    return pose_;
  }

private:
  ToolPose pose_;
};

ForceLaw lawOf(double young)
{
  return { SphereTip{ .radius = 10.0_mm }, makeMaterial(young, 0.45),
    { .mode = LawMode::Corrected, .constitution = ConstitutiveModel::Linear } };
}

Scene blockOf(double young)
{
  Scene scene;
  scene.surface =
    std::make_shared<const Surface>(test::makeSurface(test::block({ 0.2, 0.2, 0.05 }, 8)));
  scene.law = lawOf(young);
  return scene;
}

// that is shown of a depth that is asked
double shownDepth(const Scene& scene, const Material& reference, double asked)
{
  const ToolPose pose{ .apex = { 0.0, 0.0, -asked }, .axis = -Eigen::Vector3d::UnitZ() };
  LaggingTool tool(std::make_unique<Held>(pose), reference);
  tool.setScene(scene);
  const std::optional<ToolPose> shown = tool.exchange(Eigen::Vector3d::Zero(), 0.001);
  return -shown.value_or(ToolPose{}).apex.z();
}

TEST(LaggingTool, TissuesOfOtherComplianceShowAsMuchOtherDepths)
{
  const Material reference = lawOf(10.0_kPa).material();
  for (const double asked : { 1.0_mm, 4.0_mm, 8.0_mm })
  {
    const double soft = shownDepth(blockOf(10.0_kPa), reference, asked);
    const double stiff = shownDepth(blockOf(12.2_kPa), reference, asked);
    EXPECT_NEAR(soft / stiff, 1.22, 1e-6);
    EXPECT_GT(soft, 0.3 * asked);
    EXPECT_LT(soft, 0.5 * asked) << "a body of 50 mm is stiffer than a half-space";
    EXPECT_NEAR(shownDepth(blockOf(1.0_kPa), reference, asked), asked, 1e-9) << "never deeper";
  }
}

TEST(LaggingTool, ANoduleIsSeenByTheDepth)
{
  const Scene plain = blockOf(10.0_kPa);
  Scene hidden = plain;
  hidden.nodules = embedNodules(
    *hidden.surface, hidden.law, std::array{ PlacedNodule{ { 0.0, 0.0, -8.0_mm }, 5.0_mm, 10.0 } });
  const ToolPose pose{ .apex = { 0.0, 0.0, -4.0_mm }, .axis = -Eigen::Vector3d::UnitZ() };
  const double more = step(hidden, pose).response.force / step(plain, pose).response.force;
  EXPECT_GT(more, 1.2);
  EXPECT_NEAR(shownDepth(plain, plain.law.material(), 4.0_mm) /
      shownDepth(hidden, plain.law.material(), 4.0_mm),
    more, 1e-6);
}

TEST(LaggingTool, GoesWhereItIsAskedInTheAir)
{
  const ToolPose pose{ .apex = { 0.0, 0.0, 3.0_mm }, .axis = -Eigen::Vector3d::UnitZ() };
  LaggingTool tool(std::make_unique<Held>(pose), lawOf(10.0_kPa).material());
  EXPECT_EQ(tool.exchange(Eigen::Vector3d::Zero(), 0.001)->apex, pose.apex);
  tool.setScene(blockOf(10.0_kPa));
  const test::AllocationGuard guard;
  const std::optional<ToolPose> shown = tool.exchange(Eigen::Vector3d::Zero(), 0.001);
  EXPECT_EQ(guard.count(), 0);
  EXPECT_EQ(shown->apex, pose.apex);
}

TEST(LaggingTool, MovesAsItIsShown)
{
  const Scene scene = blockOf(10.0_kPa);
  const ToolPose pose{ .apex = { 0.0, 0.0, -4.0_mm },
    .axis = -Eigen::Vector3d::UnitZ(),
    .velocity = { 0.01, 0.0, -0.02 } };
  LaggingTool tool(std::make_unique<Held>(pose), scene.law.material());
  tool.setScene(scene);
  const std::optional<ToolPose> shown = tool.exchange(Eigen::Vector3d::Zero(), 0.001);
  EXPECT_EQ(shown->velocity.x(), 0.01);
  EXPECT_NEAR(shown->velocity.z(), -0.02 * shown->apex.z() / -4.0_mm, 1e-9);
}

} // namespace
} // namespace palp
