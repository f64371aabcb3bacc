// Stands in for libdrd of Force Dimension, with the functions that its documentation names: an arm
// whose frame has x to the user, y to the right, z up.

#include "tests/haptics/devices/families/made_up_drd.h"

namespace
{

DrdArm gArm;

} // namespace

extern "C"
{
  DrdArm* drdArm()
  {
    return &gArm;
  }
  int drdOpen()
  {
    gArm.open = gArm.there;
    return gArm.there ? 5 : -1;
  }
  int drdClose(char arm)
  {
    gArm.open = false;
    return arm == 5 ? 0 : -1;
  }
  bool drdIsInitialized(char)
  {
    return gArm.initialized;
  }
  const char* dhdGetSystemName(char)
  {
    return gArm.name;
  }
  const char* dhdErrorGetLastStr()
  {
    return "no device found";
  }
  int dhdEnableForce(unsigned char on, char)
  {
    gArm.forceOn = on != 0 && gArm.enables;
    return gArm.enables ? 0 : -1;
  }
  int dhdSetWatchdog(unsigned char steps, char)
  {
    gArm.watchdog = steps;
    return 0;
  }
  int dhdGetPosition(double* x, double* y, double* z, char)
  {
    *x = gArm.place[0];
    *y = gArm.place[1];
    *z = gArm.place[2];
    return gArm.there ? 1 : -1; // DHD_TIMEGUARD: asked too early, the newest there is
  }
  bool dhdHasWrist(char)
  {
    return gArm.hasWrist;
  }
  bool dhdHasActiveWrist(char)
  {
    return gArm.hasActiveWrist;
  }
  int dhdGetOrientationFrame(double frame[3][3], char)
  {
    for (int i = 0; i < 9; ++i)
    {
      frame[i / 3][i % 3] = gArm.frame[i / 3][i % 3];
    }
    return 0;
  }
  unsigned int dhdGetButtonMask(char)
  {
    return 1;
  }
  int dhdSetForceAndTorque(double x, double y, double z, double a, double b, double c, char)
  {
    const double size = x * x + y * y + z * z;
    const double share = size > 12.0 * 12.0 ? 0.5 : 1.0; // what its motors can
    gArm.force[0] = share * x;
    gArm.force[1] = share * y;
    gArm.force[2] = share * z;
    gArm.torque[0] = a;
    gArm.torque[1] = b;
    gArm.torque[2] = c;
    return !gArm.there ? -1 : share < 1.0 ? 2 : 0;
  }
  int dhdGetForce(double* x, double* y, double* z, char)
  {
    *x = gArm.force[0];
    *y = gArm.force[1];
    *z = gArm.force[2];
    return 0;
  }
}
