#pragma once

#include <array>
#include <cstddef>
#include <span>

namespace palp
{

/// A part of the modulus that decays.
struct PronyTerm
{
  double fraction; ///< of the instantaneous modulus [-]
  double time;     ///< tau, in which it falls to 1/e [s]
};

/// How the modulus of a tissue falls while it is held: E(t) / E(0) = 1 - sum p_i (1 -
/// exp(-t/tau_i)).
///
/// Poisson's ratio stays. In place, so that a law that carries it is copied without allocation.
class PronySeries
{
public:
  static constexpr std::size_t kMost = 6;

  /// @throws Error  BadValue: one more than kMost, a fraction that is not above 0, fractions whose
  /// sum
  ///                is not below 1, a time outside 0.1 ms to 1e6 s
  void add(const PronyTerm& term);

  [[nodiscard]] std::span<const PronyTerm> all() const noexcept
  {
    return { items_.data(), count_ };
  }
  [[nodiscard]] bool empty() const noexcept
  {
    return count_ == 0;
  }

  /// What never decays: E(infinite) / E(0) [-].
  [[nodiscard]] double lasting() const noexcept;

private:
  std::array<PronyTerm, kMost> items_{};
  std::size_t count_ = 0;
};

} // namespace palp
