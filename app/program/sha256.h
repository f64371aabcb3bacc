#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

struct sha256_ctx;

namespace palp
{

/// SHA-256 of bytes that come one after another.
class Sha256
{
public:
  Sha256();
  ~Sha256();
  Sha256(const Sha256&) = delete;
  Sha256& operator=(const Sha256&) = delete;

  void add(std::string_view bytes);

  /// All of a file.
  /// @throws Error  BadFile: cannot be read
  void addFile(const std::filesystem::path& file);

  /// 64 hexadecimal digits; begins anew.
  [[nodiscard]] std::string hex();

private:
  std::unique_ptr<sha256_ctx> state_;
};

/// The hash of a text, as hex() has it.
[[nodiscard]] std::string sha256Of(std::string_view text);

} // namespace palp
