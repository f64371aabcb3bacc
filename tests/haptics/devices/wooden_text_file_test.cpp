// The text that describes a WoodenHaptics of one's own.

#include "haptics/devices/hid/wooden_haptics.h"
#include "haptics/error.h"

#include <gtest/gtest.h>
#include <string>

namespace palp
{
namespace
{

TEST(WoodenHaptics, ConfigurationIsReadAndCheckedByLine)
{
  const WoodenArm arm = parseWoodenArm("# AluHaptics\nlength = 0.111 0.140 0.111\r\n"
                                       "origin =0.140 0 0\nmax_force=3 # N\n",
    "arm.conf");
  EXPECT_EQ(arm.length[1], 0.140);
  EXPECT_EQ(arm.origin[2], 0.0);
  EXPECT_EQ(arm.maxForce, 3.0);
  for (const char* bad : { "lenght = 1 2 3", "length = 1 2", "length 1 2 3", "length = 1 2 3 4",
         "body = 0 1 1", "sign = 0.5 1 1", "rest = 0 0 0.5", "rest = 0 0 40000", "radius = nan",
         "continuous_current = 3" })
  {
    EXPECT_THROW((void)parseWoodenArm(bad, "arm.conf"), Error) << bad;
  }
}

// in the words of whoever wrote millimeters, or a comma
TEST(WoodenHaptics, ConfigurationThatIsWrongIsToldByKeyValueAndRange)
{
  struct Bad
  {
    const char* text;
    const char* why;
  };
  for (const auto& [text, why] : { Bad{ "length = 80 205 245", "length is 80; give 0.01 to 2 m" },
         Bad{ "torque = 25.9 25.9 25.9", "torque is 25.9; give 0.001 to 5 N m/A" },
         Bad{ "damping = 50", "damping is 50; give 0.001 to 10 N s/m" },
         Bad{ "damping = -0.5", "damping is -0.5" }, Bad{ "damping = inf", "damping is inf" },
         Bad{ "max_force = 5000", "max_force is 5000" },
         Bad{ "max_current = 200", "max_current is 200" },
         Bad{ "peak_time = 4000", "peak_time is 4000; give 0.01 to 60 s" },
         Bad{ "radius = 100", "radius is 100" }, Bad{ "counts = -1 2 3", "counts is -1" },
         Bad{ "damping = 0,5", "damping takes one number in N s/m, with a decimal point" },
         Bad{ "length = 0.080mm 0.2 0.2", "length takes three numbers in m" },
         Bad{ "damping = 0.5 N*s/m", "damping has more values than it takes" },
         Bad{ "radius = 0.1\nradius = 0.2", "arm.conf:2: radius is given twice" },
         Bad{ "lenght = 1 2 3", "unknown key 'lenght'; expected one of capstan, length" },
         Bad{ "length 1 2 3", "no = after length" }, Bad{ "length body = 1", "no = after length" },
         Bad{ "sign = 1 1 2", "arm.conf: a sign is neither 1 nor -1" },
         Bad{ "", "tells nothing of an arm" } })
  {
    try
    {
      (void)parseWoodenArm(text, "arm.conf");
      ADD_FAILURE() << text << ": taken";
    }
    catch (const Error& error)
    {
      const std::string said = error.what();
      EXPECT_NE(said.find(why), std::string::npos) << said;
      EXPECT_EQ(said.find("arm.conf:"), 0U) << said;
    }
  }
}

} // namespace
} // namespace palp
