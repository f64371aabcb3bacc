#pragma once

// A peer that speaks OpenIGTLink as its specification writes it down, without its library: bytes,
// most significant first, and the checksum of ECMA-182 bit by bit.

#include <arpa/inet.h>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <sys/socket.h>
#include <unistd.h>
#include <vector>

namespace palp::test
{

using Octets = std::vector<unsigned char>;

inline std::uint64_t crcEcma(const Octets& octets)
{
  std::uint64_t crc = 0;
  for (const unsigned char octet : octets)
  {
    crc ^= static_cast<std::uint64_t>(octet) << 56;
    for (int bit = 0; bit < 8; ++bit)
    {
      crc = (crc << 1) ^ ((crc >> 63) != 0 ? 0x42F0E1EBA9EA3693ULL : 0ULL);
    }
  }
  return crc;
}

inline void put(Octets& octets, std::uint64_t value, int size)
{
  for (int i = size - 1; i >= 0; --i)
  {
    octets.push_back(static_cast<unsigned char>(value >> (8 * i)));
  }
}

inline void put(Octets& octets, const std::string& text, std::size_t size)
{
  for (std::size_t i = 0; i < size; ++i)
  {
    octets.push_back(i < text.size() ? static_cast<unsigned char>(text[i]) : 0);
  }
}

inline std::uint64_t get(const Octets& octets, std::size_t at, std::size_t size)
{
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < size; ++i)
  {
    value = value << 8 | octets.at(at + i);
  }
  return value;
}

inline Octets floats(const std::vector<float>& values)
{
  Octets octets;
  for (const float value : values)
  {
    put(octets, std::bit_cast<std::uint32_t>(value), 4);
  }
  return octets;
}

inline Octets message(
  const std::string& type, const std::string& device, const Octets& body, int version = 1)
{
  Octets octets;
  put(octets, static_cast<std::uint64_t>(version), 2);
  put(octets, type, 12);
  put(octets, device, 20);
  put(octets, 0, 8); // no time
  put(octets, body.size(), 8);
  put(octets, crcEcma(body), 8);
  octets.insert(octets.end(), body.begin(), body.end());
  return octets;
}

// a quarter turn about z, at a place in millimeters
inline Octets turned(const std::string& device, float x, float y, float z)
{
  return message("TRANSFORM", device, floats({ 0, 1, 0, -1, 0, 0, 0, 0, 1, x, y, z }));
}

/// A connection to whoever listens on a port of this machine.
class IgtlPeer
{
public:
  explicit IgtlPeer(std::uint16_t port)
    : socket_(socket(AF_INET, SOCK_STREAM, 0))
  {
    sockaddr_in place{};
    place.sin_family = AF_INET;
    place.sin_port = htons(port);
    place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    connected_ = connect(socket_, reinterpret_cast<const sockaddr*>(&place), sizeof(place)) == 0;
  }
  ~IgtlPeer()
  {
    close(socket_);
  }
  IgtlPeer(const IgtlPeer&) = delete;
  IgtlPeer& operator=(const IgtlPeer&) = delete;

  [[nodiscard]] bool connected() const
  {
    return connected_;
  }

  bool say(const Octets& octets)
  {
    return send(socket_, octets.data(), octets.size(), MSG_NOSIGNAL) ==
      static_cast<ssize_t>(octets.size());
  }

  // what has come by now
  Octets hear()
  {
    Octets octets(1 << 16);
    const ssize_t size = recv(socket_, octets.data(), octets.size(), MSG_DONTWAIT);
    octets.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
    return octets;
  }

  // the other side has closed it
  [[nodiscard]] bool isLetGo()
  {
    char one = 0;
    for (;;)
    {
      const ssize_t size = recv(socket_, &one, 1, MSG_DONTWAIT);
      if (size <= 0)
      {
        return size == 0 || (errno != EAGAIN && errno != EWOULDBLOCK);
      }
    }
  }

private:
  int socket_;
  bool connected_ = false;
};

} // namespace palp::test
