#include "app/program/sha256.h"

#include "haptics/error.h"

#include <array>
#include <cstdint>
#include <fstream>
#include <nettle/sha2.h>

namespace palp
{

Sha256::Sha256()
  : state_(std::make_unique<sha256_ctx>())
{
  sha256_init(state_.get());
}

Sha256::~Sha256() = default;

void Sha256::add(std::string_view bytes)
{
  sha256_update(state_.get(), bytes.size(), reinterpret_cast<const std::uint8_t*>(bytes.data()));
}

void Sha256::addFile(const std::filesystem::path& file)
{
  std::ifstream in(file, std::ios::binary);
  std::array<char, 1 << 16> bytes{};
  while (in.read(bytes.data(), bytes.size()), in.gcount() > 0)
  {
    add({ bytes.data(), static_cast<std::size_t>(in.gcount()) });
  }
  if (!in.eof())
  {
    throw Error(ErrorCode::BadFile, file.string() + ": cannot be read; check name and permission");
  }
}

std::string Sha256::hex()
{
  std::array<std::uint8_t, SHA256_DIGEST_SIZE> digest{};
  sha256_digest(state_.get(), digest.size(), digest.data());
  std::string text;
  for (const unsigned byte : digest)
  {
    constexpr const char* kDigits = "0123456789abcdef";
    text.append({ kDigits[byte / 16], kDigits[byte % 16] });
  }
  return text;
}

std::string sha256Of(std::string_view text)
{
  Sha256 hash;
  hash.add(text);
  return hash.hex();
}

} // namespace palp
