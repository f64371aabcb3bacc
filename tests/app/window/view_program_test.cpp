#include "app/session/session.h"
#include "tests/support/process.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace palp
{
namespace
{

TEST(ViewProgram, WithAMouseMapsNoUsbLibrary)
{
  const test::Finished finished =
    test::runCommand("PALP_DATA=" PALP_SHARE " " PALP_VIEW " scene liver_mouse --explain");
  ASSERT_EQ(finished.code, 0) << finished.err;
  EXPECT_NE(finished.out.find("USB 0"), std::string::npos) << finished.out;
}

// last of all uses of the module here: once mapped, it stays
TEST(UsbModule, ComesWhenDevicesAreLookedFor)
{
  EXPECT_EQ(test::readAll("/proc/self/maps").find("palp-usb.so"), std::string::npos);
  const std::vector<std::string> names = Session::devices();
  EXPECT_NE(std::find(names.begin(), names.end(), "mouse"), names.end());
  EXPECT_NE(test::readAll("/proc/self/maps").find("palp-usb.so"), std::string::npos);
}

TEST(ViewProgram, WithoutAUsableDisplayEndsWithItsExitCode)
{
  const test::Finished finished =
    test::runCommand("DISPLAY=:987 PALP_DATA=" PALP_SHARE " " PALP_VIEW " view");
  EXPECT_EQ(finished.code, 4);
  EXPECT_NE(finished.err.find("palp run"), std::string::npos) << finished.err;
}

TEST(ViewProgram, EndsInOrderOnASignalAndTellsIt)
{
  for (const auto& [signal, code] : { std::pair("TERM", 143), std::pair("INT", 130) })
  {
    // once it takes the signal, bit 14 of those it has a handler for
    const test::Finished finished = test::runCommand(
      "PALP_DATA=" PALP_SHARE " " PALP_VIEW " view & running=$!; until grep -q "
      "'^SigCgt:.*[4567cdef][0-9a-f]\\{3\\}$' /proc/$running/status; do kill -0 $running || exit; "
      "sleep 0.05; done; sleep 1; kill -" +
      std::string(signal) + " $running; wait $running");
    EXPECT_EQ(finished.code, code) << finished.err;
  }
}

} // namespace
} // namespace palp
