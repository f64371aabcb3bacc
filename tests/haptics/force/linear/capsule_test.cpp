#include "haptics/error.h"
#include "haptics/force/force_law.h"
#include "haptics/force/linear/layer_contact.h"
#include "haptics/force/validity.h"
#include "haptics/numerics/quadrature.h"
#include "haptics/units.h"
#include "tests/support/sampled.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

// sheets that are thin against the contact

namespace palp
{
namespace
{

using namespace units::literals;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

Coatings one(double thickness, const Material& material)
{
  Coatings coatings;
  coatings.add({ thickness, material });
  return coatings;
}

// int_0^1 P_2n(x) cos(k x) dx = (-1)^n j_2n(k): Lebedev and Ufliand's equation in Legendre's
// polynomials, with Burmister's compliance, for a paraboloid r^2 / 2 R
struct LegendreContact
{
  double depth; // [m]
  double force; // over 2 E* of the coating [m^2]
};

LegendreContact legendreContact(double a, double tipRadius, double coating, double stiffer)
{
  constexpr int kTerms = 14;
  const auto integrals = [&](double radius) // A and B
  {
    Eigen::MatrixXd system = Eigen::MatrixXd::Zero(kTerms, kTerms);
    const double last = 16.0 / coating * radius;
    double low = 0.0;
    double width = 1e-3; // of panels in k a, up to half a turn
    while (low < last)
    {
      const Quadrature rule = gaussLegendre(8, low, low + width);
      for (std::size_t i = 0; i < rule.nodes.size(); ++i)
      {
        const double k = rule.nodes[i];
        const double m = k / radius * coating;
        const double N = (stiffer - 1.0) / (stiffer + 1.0);
        const double e = std::exp(-2.0 * m);
        const double compliance = (1.0 + 4.0 * N * m * e - N * N * e * e) /
          (1.0 - 2.0 * N * (1.0 + 2.0 * m * m) * e + N * N * e * e);
        Eigen::VectorXd bessel(kTerms);
        for (int n = 0; n < kTerms; ++n)
        {
          bessel[n] = (n % 2 == 0 ? 1.0 : -1.0) * std::sph_bessel(2U * static_cast<unsigned>(n), k);
        }
        system -= 2.0 / std::numbers::pi * rule.weights[i] * (1.0 - compliance) * bessel *
          bessel.transpose();
      }
      low += width;
      width = std::min(3.0, 1.5 * width);
    }
    for (int n = 0; n < kTerms; ++n)
    {
      system(n, n) += 1.0 / (4.0 * n + 1.0);
    }
    const Eigen::VectorXd d = system.partialPivLu().solve(Eigen::VectorXd::Unit(kTerms, 0));
    return std::pair(
      radius * d[0], std::pow(radius, 3) / tipRadius * (d[0] / 3.0 + 2.0 / 15.0 * d[1]));
  };
  constexpr double kStep = 1e-4; // [-]
  const auto more = integrals((1.0 + kStep) * a);
  const auto less = integrals((1.0 - kStep) * a);
  const auto here = integrals(a);
  const double depth = (more.second - less.second) / (more.first - less.first);
  return { depth, depth * here.first - here.second };
}

// a capsule of the liver: 0.05 to 0.1 mm
TEST(Capsule, GivesTheForceOfLegendresSeries)
{
  for (const double thickness : { 0.05_mm, 0.1_mm, 0.4_mm })
  {
    for (const double stiffer : { 5.0, 20.0 })
    {
      const Material body{ 5.0_kPa, 0.5 };
      const Material capsule{ stiffer * 5.0_kPa, 0.5 };
      const LayerContact law = LayerContact(ParaboloidTip{ 10.0_mm }, 0.5, Base::Bonded)
                                 .coated(one(thickness, capsule), body, Base::Bonded);
      for (const double a : { 0.3_mm, 1.5_mm, 4.0_mm })
      {
        const LegendreContact expected = legendreContact(a, 10.0_mm, thickness, stiffer);
        const LinearContact found = law(expected.depth, kInfinite, 0.0);
        const double force = 2.0 * stiffer * expected.force; // over E* of the body
        EXPECT_NEAR(found.force / force, 1.0, 5e-3)
          << "capsule " << thickness << " of " << stiffer << " radius " << a;
        EXPECT_NEAR(found.radius / a, 1.0, 0.03) << thickness << " " << stiffer << " " << a;
      }
    }
  }
}

// neo-Hookean elements of palp calibrate, 0.1 mm large, at 1 to 4 mm: a ball of 10 mm in a block of
// 100 x 100 x 50 mm, 20 times as stiff a capsule; 1 mm of such skin would be 20 % off
TEST(Capsule, IsBelievedAndAsForcefulAsElements)
{
  const auto strain = [](const Rules& rules)
  { return std::ranges::find(rules, std::string("large_strain"), &Rule::name)->value; };
  const Validity plain(
    ForceLaw(SphereTip{ 10.0_mm }, { 5.0_kPa, 0.45 }, { .mode = LawMode::Corrected }));
  const std::pair<double, std::array<double, 4>> elements[] = {
    { 0.1_mm, { 0.0278415, 0.0796929, 0.147418, 0.227774 } },
    { 0.2_mm, { 0.0282219, 0.0808891, 0.150022, 0.232471 } },
  };
  for (const auto& [thickness, forces] : elements)
  {
    const ForceLaw law(SphereTip{ 10.0_mm }, { 5.0_kPa, 0.45 },
      { .mode = LawMode::Corrected, .coatings = one(thickness, { 100.0_kPa, 0.45 }) });
    const Validity validity(law);
    for (std::size_t i = 0; i < forces.size(); ++i)
    {
      const ContactGeometry place{ .depth = (1.0 + static_cast<double>(i)) * 1.0_mm,
        .thickness = 50.0_mm };
      EXPECT_NEAR(law(place).force / forces[i], 1.0, 0.03) << thickness << " " << i;
      // no less believed than the body without it
      EXPECT_NEAR(strain(validity(place)) / strain(plain(place)), 1.0, 0.1)
        << thickness << " " << i;
    }
  }
}

// where the elements of palp calibrate say that the tool would have to pull: a punch of 5 mm,
// linear material, a block of 60 x 60 x 30 mm, elements of 0.2 mm
TEST(Coating, IsRefusedUnderAFlatEndFromWhichItBendsAway)
{
  struct Sheet
  {
    double thickness;
    double stiffer;
    bool pulls;
  };
  const auto lawOf = [](const Tip& tip, const Sheet& sheet)
  {
    const LawSettings settings{ .mode = LawMode::Corrected,
      .coatings = one(sheet.thickness, { sheet.stiffer * 10.0_kPa, 0.45 }) };
    return ForceLaw(tip, { 10.0_kPa, 0.45 }, settings);
  };
  test::Sampled samples(5);
  for (const Sheet& sheet :
    { Sheet{ 0.5_mm, 5.0, false }, Sheet{ 1.0_mm, 5.0, false }, Sheet{ 2.0_mm, 5.0, false },
      Sheet{ 3.0_mm, 3.0, false }, Sheet{ 0.5_mm, 10.0, false }, Sheet{ 0.5_mm, 20.0, false },
      Sheet{ 1.0_mm, 10.0, false }, Sheet{ 2.0_mm, 10.0, true }, Sheet{ 1.0_mm, 20.0, true },
      Sheet{ 2.0_mm, 20.0, true }, Sheet{ 3.0_mm, 20.0, true }, Sheet{ 4.0_mm, 20.0, true } })
  {
    if (!samples.takes())
    {
      continue;
    }
    SCOPED_TRACE(testing::Message() << sheet.thickness << " of " << sheet.stiffer);
    if (sheet.pulls)
    {
      EXPECT_THROW((void)lawOf(PunchTip{ 5.0_mm }, sheet), Error);
      EXPECT_THROW((void)lawOf(TruncatedConeTip{ 45.0_deg, 5.0_mm, 8.0_mm }, sheet), Error);
    }
    else
    {
      EXPECT_GT(lawOf(PunchTip{ 5.0_mm }, sheet)({ .depth = 0.5_mm }).force, 0.0);
    }
    EXPECT_GT(lawOf(SphereTip{ 5.0_mm }, sheet)({ .depth = 0.5_mm }).force, 0.0);
  }
}

} // namespace
} // namespace palp
