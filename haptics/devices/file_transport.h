#pragma once

#include "haptics/devices/transport.h"

namespace palp
{

/// Reports through an open file: a hidraw node, or a socket that keeps messages apart.
class FileTransport final : public Transport
{
public:
  /// @param descriptor  open for both ways; owned from now on
  explicit FileTransport(int descriptor) noexcept
    : descriptor_(descriptor)
  {
  }
  ~FileTransport() override;
  FileTransport(const FileTransport&) = delete;
  FileTransport& operator=(const FileTransport&) = delete;

  [[nodiscard]] IoResult read(
    MutableBytes into, std::chrono::microseconds timeout) noexcept override;
  [[nodiscard]] IoCode write(Bytes bytes) noexcept override;
  [[nodiscard]] int descriptor() const noexcept override
  {
    return descriptor_;
  }

private:
  int descriptor_;
};

/// Takes the device behind a descriptor for this program and those that share its descriptor.
/// @return  false: another program of ours has it
[[nodiscard]] bool takeForOneself(int descriptor) noexcept;

} // namespace palp
