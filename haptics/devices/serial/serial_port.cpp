#include "haptics/devices/serial/serial_port.h"

#include "haptics/devices/file_transport.h"
#include "haptics/error.h"
#include "haptics/files/descriptor.h"

#include <algorithm>
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

std::vector<SerialPort> serialPorts(const std::filesystem::path& folder)
{
  std::vector<SerialPort> ports;
  std::error_code unread; // a folder that cannot be read shows none
  for (const auto& entry : std::filesystem::directory_iterator(folder, unread))
  {
    const std::string name = entry.path().filename();
    if (name.starts_with("ttyACM") || name.starts_with("ttyUSB"))
    {
      ports.push_back({ entry.path(), access(entry.path().c_str(), R_OK | W_OK) == 0 });
    }
  }
  std::ranges::sort(ports, {}, &SerialPort::path);
  return ports;
}

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
        (errno == EACCES ? std::string(": ") + kSerialPermission
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
