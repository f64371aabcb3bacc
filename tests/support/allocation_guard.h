#pragma once

#include <cstddef>

namespace palp::test
{

/// Counts the allocations of this thread while it lives. Link palp_allocation_guard.
class AllocationGuard
{
public:
  AllocationGuard() noexcept;

  /// Allocations since it was made.
  [[nodiscard]] std::size_t count() const noexcept;

private:
  std::size_t before_;
};

} // namespace palp::test
