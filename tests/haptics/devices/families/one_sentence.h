#pragma once

#include "haptics/devices/usb/open_device.h"
#include "haptics/error.h"

#include <gtest/gtest.h>
#include <string>

namespace palp::test
{

/// That a device is refused by one sentence, which says what to do.
inline void expectRefusedInOneSentence(const std::string& device)
{
  try
  {
    (void)openDriver(device);
    ADD_FAILURE() << device;
  }
  catch (const Error& error)
  {
    const std::string what = error.what();
    EXPECT_NE(what.find("; "), what.npos) << what;
    EXPECT_EQ(what.find('\n'), what.npos) << what;
  }
}

} // namespace palp::test
