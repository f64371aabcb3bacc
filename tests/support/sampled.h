#pragma once

namespace palp::test
{

#ifdef PALP_SANITIZED
constexpr bool kSanitized = true; ///< takes more time and memory than any limit
#else
constexpr bool kSanitized = false;
#endif
constexpr double kSlower = kSanitized ? 4.0 : 1.0; ///< times what a program takes without [-]

/// Which samples a test of arithmetic takes: all; under a sanitizer, which finds nothing in one
/// that it does not in another, the first of every few.
class Sampled
{
public:
  explicit Sampled(int few = 10)
    : few_(kSanitized ? few : 1)
  {
  }

  /// @return  whether to take the next one
  [[nodiscard]] bool takes()
  {
    return count_++ % few_ == 0;
  }

private:
  int few_;
  int count_ = 0;
};

} // namespace palp::test
