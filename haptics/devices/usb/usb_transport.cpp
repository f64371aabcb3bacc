#include "haptics/devices/usb/usb_transport.h"

#include "haptics/devices/usb/found_device.h"
#include "haptics/error.h"

#include <algorithm>
#include <libusb-1.0/libusb.h>
#include <poll.h>

namespace palp
{
namespace
{

constexpr std::uint16_t kVendor = 0x0403;
constexpr std::uint16_t kProduct = 0xcb48;
constexpr unsigned char kOut = 0x02;
constexpr unsigned char kIn = 0x81;
constexpr std::uint8_t kVendorRequest = 0x40;
constexpr unsigned kTransferPatience = 100; // for what should take no time [ms]

using Context = std::unique_ptr<libusb_context, decltype(&libusb_exit)>;
using Handle = std::unique_ptr<libusb_device_handle, decltype(&libusb_close)>;

constexpr const char* kNoUsb = "USB cannot be used on this system; check /dev/bus/usb";

// null where there is no USB
Context openContext() noexcept
{
  libusb_context* context = nullptr;
  return { libusb_init(&context) == LIBUSB_SUCCESS ? context : nullptr, &libusb_exit };
}

Context makeContext()
{
  Context context = openContext();
  if (!context)
  {
    throw Error(ErrorCode::NoDevice, std::string("Novint Falcon: ") + kNoUsb);
  }
  return context;
}

std::string unusableReasonOf(int error)
{
  switch (error)
  {
    case LIBUSB_SUCCESS:
      return {};
    case LIBUSB_ERROR_ACCESS:
      return "no permission; install the udev rules (cmake --install), then plug it in again";
    case LIBUSB_ERROR_BUSY:
      return "is used by another program; close it";
    default:
      return std::string("cannot be opened (") + libusb_error_name(error) + "); plug it in again";
  }
}

IoCode codeOf(int error) noexcept
{
  return error == LIBUSB_SUCCESS ? IoCode::Ok
    : error == LIBUSB_ERROR_TIMEOUT || error == LIBUSB_ERROR_OVERFLOW ||
      error == LIBUSB_ERROR_INTERRUPTED || error == LIBUSB_ERROR_PIPE
    ? IoCode::Timeout
    : IoCode::Gone;
}

class UsbTransport final : public SerialTransport
{
public:
  UsbTransport(Context context, Handle handle) noexcept
    : context_(std::move(context))
    , handle_(std::move(handle))
  {
  }

  ~UsbTransport() override
  {
    (void)libusb_release_interface(handle_.get(), 0);
  }

  // that of usbfs is the one which libusb waits for to be writable
  [[nodiscard]] int descriptor() const noexcept override
  {
    int found = -1;
    const libusb_pollfd** all = libusb_get_pollfds(context_.get());
    for (const libusb_pollfd** one = all; one != nullptr && *one != nullptr; ++one)
    {
      found = ((*one)->events & POLLOUT) != 0 ? (*one)->fd : found;
    }
    libusb_free_pollfds(all);
    return found;
  }

  UsbTransport(const UsbTransport&) = delete;
  UsbTransport& operator=(const UsbTransport&) = delete;

  [[nodiscard]] IoResult read(
    MutableBytes into, std::chrono::microseconds timeout) noexcept override
  {
    const auto wait = std::chrono::ceil<std::chrono::milliseconds>(timeout).count();
    int size = 0;
    const int error = libusb_bulk_transfer(handle_.get(), kIn,
      reinterpret_cast<unsigned char*>(into.data()), static_cast<int>(into.size()), &size,
      static_cast<unsigned>(std::max<long>(1, static_cast<long>(wait)))); // 0 would mean for ever
    clearHalt(kIn, error);
    return { codeOf(error), static_cast<std::size_t>(size) };
  }

  [[nodiscard]] IoCode write(Bytes bytes) noexcept override
  {
    int size = 0;
    // libusb takes what it only reads as if it wrote it
    auto* data = reinterpret_cast<unsigned char*>(const_cast<std::byte*>(bytes.data()));
    const int error = libusb_bulk_transfer(
      handle_.get(), kOut, data, static_cast<int>(bytes.size()), &size, kTransferPatience);
    clearHalt(kOut, error);
    return codeOf(error);
  }

  [[nodiscard]] bool request(std::uint8_t what, std::uint16_t value) noexcept override
  {
    return libusb_control_transfer(
             handle_.get(), kVendorRequest, what, value, 0, nullptr, 0, kTransferPatience) >= 0;
  }

private:
  // a halted endpoint stays so until it is told otherwise
  void clearHalt(unsigned char endpoint, int error) noexcept
  {
    if (error == LIBUSB_ERROR_PIPE)
    {
      (void)libusb_clear_halt(handle_.get(), endpoint);
    }
  }

  Context context_;
  Handle handle_;
};

} // namespace

const char* usbUnusableReason() noexcept
{
  return openContext() ? "" : kNoUsb;
}

std::vector<FoundDevice> listUsb()
{
  std::vector<FoundDevice> found;
  const Context context = openContext();
  if (!context)
  {
    return found;
  }
  libusb_device** devices = nullptr;
  const auto count = libusb_get_device_list(context.get(), &devices);
  for (long i = 0; i < static_cast<long>(count); ++i)
  {
    libusb_device_descriptor descriptor{};
    if (libusb_get_device_descriptor(devices[i], &descriptor) != LIBUSB_SUCCESS ||
      descriptor.idVendor != kVendor || descriptor.idProduct != kProduct)
    {
      continue;
    }
    libusb_device_handle* handle = nullptr;
    const int error = libusb_open(devices[i], &handle);
    libusb_close(handle);
    found.push_back({ .kind = DeviceKind::Falcon,
      .name = "Novint Falcon",
      .ids = "0403:cb48",
      .path = "usb:" + std::to_string(libusb_get_bus_number(devices[i])) + ":" +
        std::to_string(libusb_get_device_address(devices[i])),
      .unusableReason = unusableReasonOf(error) });
  }
  if (count >= 0)
  {
    libusb_free_device_list(devices, 1);
  }
  return found;
}

std::unique_ptr<SerialTransport> openFalcon()
{
  Context context = makeContext();
  Handle handle(libusb_open_device_with_vid_pid(context.get(), kVendor, kProduct), &libusb_close);
  if (handle == nullptr)
  {
    throw Error(ErrorCode::NoDevice,
      "Novint Falcon: not found, or no permission; plug it in, and see palp devices");
  }
  (void)libusb_set_auto_detach_kernel_driver(handle.get(), 1); // a serial driver may hold it
  const std::string unusableReason = unusableReasonOf(libusb_claim_interface(handle.get(), 0));
  if (!unusableReason.empty())
  {
    throw Error(ErrorCode::NoDevice, "Novint Falcon: " + unusableReason);
  }
  return std::make_unique<UsbTransport>(std::move(context), std::move(handle));
}

} // namespace palp
