// palp-devices: palp with hidapi and libusb.

#include "app/commands/program.h"
#include "app/devices_report.h"

int main(int argc, char** argv)
{
  return palp::runProgram(argc, argv, { .devices = &palp::showDevices });
}
