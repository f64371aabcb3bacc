#pragma once

#include "haptics/files/descriptor.h"

#include <filesystem>
#include <optional>
#include <string>

namespace palp
{

/// What holds a case for one runner, so that others do not compute it at the same time, and the
/// folder in which it works.
///
/// It appears by a rename, which one of several runners can do, on a network, too; no lock. It is
/// beaten as long as the runner lives. One whose runner is gone is taken over: on the same machine
/// at once, and not as long as its process goes on; where it is elsewhere or was stopped, when its
/// last beat is two minutes behind one of ours, or ahead of it, both by the clock of the disk, so
/// that clocks of nodes may differ.
///
/// A claim only saves work: what is finished is renamed into its place, which one runner can do.
class Claim
{
public:
  /// Takes a case; what a runner left that is gone is removed.
  ///
  /// @param claims  folder of all claims
  /// @return        nothing while another runner has it
  /// @throws Error  BadFile: cannot be written
  [[nodiscard]] static std::optional<Claim> take(
    const std::filesystem::path& claims, const std::string& name);

  /// Whether a runner that lives, or may, has the case.
  [[nodiscard]] static bool isHeld(const std::filesystem::path& claims, const std::string& name);

  Claim(Claim&&) noexcept = default;
  Claim& operator=(Claim&&) noexcept = default;

  /// Removes what runners left that ended before they had a case, two minutes ago or earlier.
  static void tidy(const std::filesystem::path& claims);

  /// Where the work of the case is, until it is renamed into its place; gone with the claim.
  [[nodiscard]] const std::filesystem::path& folder() const noexcept
  {
    return folder_;
  }

  /// False where another runner took it over, or is about to.
  [[nodiscard]] bool isOurs() const;

  void beat() const;
  void release() const;

private:
  Claim(std::filesystem::path claim, std::filesystem::path folder, std::string owner);

  std::filesystem::path claim_;
  std::filesystem::path folder_;
  std::string owner_;
  Descriptor file_;
};

constexpr int kSilence = 120; ///< of a runner that counts as gone [s]

} // namespace palp
