// The module palp-usb: a window that nobody holds a device to never maps a USB library.

#include "haptics/devices/usb/usb_module.h"

#include "haptics/devices/haply/haply_driver.h"
#include "haptics/devices/usb/hid_transport.h"
#include "haptics/devices/usb/usb_transport.h"

extern "C" const palp::UsbModule* palpUsbModule()
{
  static const palp::UsbModule module{ palp::listHid, palp::openHid, palp::listUsb,
    palp::openFalcon, palp::openHaply };
  return &module;
}
