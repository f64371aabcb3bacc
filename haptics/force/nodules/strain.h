#pragma once

namespace palp
{

/// Strain of a field that is alike all around an axis; tension positive.
struct Strain
{
  double rr = 0.0;
  double tt = 0.0; ///< around the axis
  double zz = 0.0;
  double rz = 0.0; ///< half the shear angle

  [[nodiscard]] constexpr double trace() const noexcept
  {
    return rr + tt + zz;
  }

  friend constexpr Strain operator+(const Strain& a, const Strain& b) noexcept
  {
    return { a.rr + b.rr, a.tt + b.tt, a.zz + b.zz, a.rz + b.rz };
  }

  friend constexpr Strain operator*(double factor, const Strain& a) noexcept
  {
    return { factor * a.rr, factor * a.tt, factor * a.zz, factor * a.rz };
  }
};

/// Product of the parts that change the shape only.
[[nodiscard]] constexpr double deviatoricProduct(const Strain& a, const Strain& b) noexcept
{
  return a.rr * b.rr + a.tt * b.tt + a.zz * b.zz + 2.0 * a.rz * b.rz - a.trace() * b.trace() / 3.0;
}

} // namespace palp
