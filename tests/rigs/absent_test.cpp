#include "app/devices_report.h"
#include "app/program/devices_options.h"
#include "haptics/devices/usb/open_device.h"
#include "haptics/error.h"

#include <gtest/gtest.h>

namespace palp
{
namespace
{

TEST(WithoutLibraries, DevicesSaysWhatToInstall)
{
  testing::internal::CaptureStdout();
  EXPECT_EQ(showDevices({}), 3);
  const std::string text = testing::internal::GetCapturedStdout();
  EXPECT_NE(text.find("SpaceMouse"), text.npos);
  for (const char* library : { "libhidapi-dev", "libusb-1.0-0-dev", "libspnav-dev",
         "libwebsockets-dev", "libopenigtlink-dev" })
  {
    const std::string missing = std::string("install ") + library + " and build again";
    EXPECT_NE(text.find(missing), text.npos) << missing << '\n' << text;
  }
}

TEST(WithoutLibraries, ADeviceThatIsNamedIsRefusedWithTheReason)
{
  for (const auto& [name, library] : { std::pair("phd1:/dev/hidraw0", "libhidapi-dev"),
         std::pair("falcon", "libusb-1.0-0-dev"), std::pair("openigtlink", "libopenigtlink-dev"),
         std::pair("haply", "libwebsockets-dev"), std::pair("spacenavd", "libspnav-dev") })
  {
    try
    {
      (void)openDriver(name);
      ADD_FAILURE() << name;
    }
    catch (const Error& error)
    {
      EXPECT_EQ(error.code(), ErrorCode::NoDevice);
      EXPECT_NE(std::string(error.what()).find(library), std::string::npos) << error.what();
    }
  }
}

} // namespace
} // namespace palp
