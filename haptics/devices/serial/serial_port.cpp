#include "haptics/devices/serial/serial_port.h"

#include "haptics/devices/file_transport.h"
#include "haptics/error.h"
#include "haptics/files/descriptor.h"

#include <cerrno>
#include <fcntl.h>
#include <termios.h>
#include <unistd.h>

namespace palp
{
namespace
{

int openTerminal(const std::string& path) noexcept
{
  return open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
}

bool makeRaw(int descriptor) noexcept
{
  termios settings{};
  if (tcgetattr(descriptor, &settings) != 0)
  {
    return false;
  }
  cfmakeraw(&settings);
  settings.c_cflag |= CLOCAL | CREAD;
  settings.c_cflag &= ~static_cast<tcflag_t>(HUPCL); // a port that closes must not reset a board
  (void)cfsetispeed(&settings, B115200);
  (void)cfsetospeed(&settings, B115200);
  return tcsetattr(descriptor, TCSANOW, &settings) == 0 && tcflush(descriptor, TCIOFLUSH) == 0;
}

} // namespace

bool isSerialPort(const std::string& path)
{
  const Descriptor file(openTerminal(path));
  return file ? isatty(file.get()) != 0 : path.starts_with("/dev/tty");
}

std::unique_ptr<Transport> openSerialPort(const std::string& path)
{
  const int file = openTerminal(path);
  if (file < 0)
  {
    throw Error(ErrorCode::NoDevice,
      path +
        (errno == EACCES ? ": no permission; join the group dialout, then log in again"
                         : ": cannot be opened; plug it in again"));
  }
  auto transport = std::make_unique<FileTransport>(file);
  if (!takeForOneself(file))
  {
    throw Error(ErrorCode::NoDevice, path + ": is driven by another palp; close it");
  }
  if (!makeRaw(file))
  {
    throw Error(ErrorCode::NoDevice, path + ": not a serial port; see palp devices");
  }
  return transport;
}

} // namespace palp
