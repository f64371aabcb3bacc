#include "haptics/force/nodules/punch_strain.h"

#include <cmath>
#include <numbers>

namespace palp
{
namespace
{

// std::complex looks for values that are not finite at every product
struct Complex
{
  double re;
  double im;

  friend Complex operator*(const Complex& a, const Complex& b) noexcept
  {
    return { a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re };
  }
};

Complex inverse(const Complex& a) noexcept
{
  const double square = a.re * a.re + a.im * a.im;
  return { a.re / square, -a.im / square };
}

// the root with a positive real part, of a number with a positive imaginary part
Complex root(const Complex& a) noexcept
{
  const double larger = std::sqrt(0.5 * (std::sqrt(a.re * a.re + a.im * a.im) + std::abs(a.re)));
  const double smaller = 0.5 * a.im / larger;
  return a.re >= 0.0 ? Complex{ larger, smaller } : Complex{ smaller, larger };
}

} // namespace

Strain punchStrain(double radius, double r, double z, double poissonRatio) noexcept
{
  const Complex zeta{ z, radius };
  const Complex h = root({ r * r + z * z - radius * radius, 2.0 * z * radius });
  const Complex oneOverH = inverse(h);
  const Complex oneOverSum = inverse({ h.re + z, h.im + radius });
  const Complex cube = oneOverH * oneOverH * oneOverH;

  // derivatives of the potential; pR and logR over r
  const double pZ = oneOverH.im;
  const double pR = (oneOverH * oneOverSum).im;
  const double pZZ = -(zeta * cube).im;
  const double pRZ = -r * cube.im;
  const double pRR = -pZZ - pR;
  const double logR = -oneOverSum.im;
  const double logRR = -pZ - logR;

  const double k = 1.0 - 2.0 * poissonRatio;
  const double scale = 1.0 / (std::numbers::pi * (1.0 - poissonRatio) * radius);
  return scale * Strain{ -(k * logRR + z * pRR), -(k * logR + z * pR), k * pZ - z * pZZ, -z * pRZ };
}

} // namespace palp
