#include "haptics/devices/pointer.h"

#include "haptics/error.h"
#include "haptics/units.h"

#include <gtest/gtest.h>
#include <limits>

namespace palp
{
namespace
{

using namespace units::literals;
using Eigen::Vector3d;

TEST(Pointer, TurnsAJumpIntoAMotionOfBoundedSpeed)
{
  Pointer pointer{ HandTarget{} };
  pointer.moveTo({ .apex = Vector3d(0.1, 0, 0), .axis = Vector3d::UnitX() });
  double last = 0.0;
  for (int i = 0; i < 1000; ++i)
  {
    const ToolPose pose = *pointer.exchange(Vector3d(0, 5, 0), 1.0_ms);
    ASSERT_NEAR(pose.apex.x() - last, pose.velocity.x() * 1.0_ms, 1e-15);
    ASSERT_GE(pose.velocity.x(), 0.0); // never past the target and back
    ASSERT_LE(pose.velocity.norm(), Pointer::kSpeed * (1.0 + 1e-12));
    ASSERT_EQ(pose.apex.y(), 0.0);
    last = pose.apex.x();
  }
  EXPECT_NEAR(last, 0.1, 1e-6);
}

TEST(Pointer, TurnsGraduallyToTheNewAxis)
{
  Pointer pointer{ HandTarget{} };
  pointer.moveTo({ .axis = Vector3d::UnitX() });
  double last = 0.0;
  for (int i = 0; i < 500; ++i)
  {
    const Vector3d axis = pointer.exchange(Vector3d::Zero(), 1.0_ms)->axis;
    ASSERT_NEAR(axis.norm(), 1.0, 1e-12);
    ASSERT_GE(axis.x(), last);
    ASSERT_LE(axis.x() - last, 0.1); // from a right angle, in more than ten ticks
    last = axis.x();
  }
  EXPECT_NEAR(last, 1.0, 1e-6);
}

TEST(Pointer, AppearsAtOnceWhereItIsLifted)
{
  Pointer pointer{ HandTarget{} };
  pointer.moveTo({ .apex = Vector3d(0.1, 0, 0), .axis = Vector3d::UnitX(), .lifted = true });
  const ToolPose pose = *pointer.exchange(Vector3d::Zero(), 1.0_ms);
  EXPECT_EQ(pose.apex, Vector3d(0.1, 0, 0));
  EXPECT_EQ(pose.axis, Vector3d::UnitX());
  EXPECT_EQ(pose.velocity, Vector3d::Zero());
}

TEST(Pointer, RestsAtItsTarget)
{
  Pointer pointer{ HandTarget{} };
  EXPECT_EQ(pointer.exchange(Vector3d::Zero(), 1.0_ms)->velocity, Vector3d::Zero());
  EXPECT_FALSE(pointer.limits().rendersForce);
}

TEST(Pointer, IgnoresWhatIsNotFinite)
{
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  Pointer pointer{ HandTarget{} };
  pointer.moveTo({ .apex = Vector3d(kNaN, 0, 0) });
  EXPECT_EQ(pointer.exchange(Vector3d::Zero(), kNaN)->apex, Vector3d::Zero());
  EXPECT_EQ(pointer.exchange(Vector3d::Zero(), 1.0_ms)->apex, Vector3d::Zero());
  EXPECT_THROW(Pointer({ .apex = Vector3d(kNaN, 0, 0) }), Error);
}

} // namespace
} // namespace palp
