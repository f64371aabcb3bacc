#include "calibration/fem/constitutive.h"

#include "haptics/units.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace palp::fem
{
namespace
{

using namespace units::literals;
using Eigen::Matrix3d;

constexpr Material kTissue{ .youngModulus = 50.0_kPa, .poissonRatio = 0.33 };

Matrix3d stretchedAndTurned()
{
  Matrix3d f;
  f << 1.2, 0.3, -0.1, 0.05, 0.8, 0.2, -0.15, 0.1, 0.9;
  return f;
}

class AnyEnergy : public testing::TestWithParam<StrainEnergy>
{
};
INSTANTIATE_TEST_SUITE_P(Constitutive, AnyEnergy,
  testing::Values(StrainEnergy::Linear, StrainEnergy::Corotated, StrainEnergy::NeoHookean,
    StrainEnergy::NeoHookeanIsochoric),
  [](const auto& tested)
  {
    std::string text(name(tested.param));
    std::erase(text, '-');
    return text;
  });

// fourth-order central differences leave about 1e-11 of the moduli
constexpr double kStep = 1e-3;

template <typename Function>
auto derivative(Function function, const Matrix3d& at, int component)
{
  const auto value = [&](double shift)
  {
    Matrix3d moved = at;
    moved.data()[component] += shift;
    return function(moved);
  };
  using Value = decltype(function(at));
  const Value near = value(kStep) - value(-kStep);
  const Value far = value(2 * kStep) - value(-2 * kStep);
  return Value((8.0 * near - far) / (12.0 * kStep));
}

TEST_P(AnyEnergy, StressIsTheDerivativeOfTheEnergy)
{
  const auto energy = [](const Matrix3d& f) { return evaluate(GetParam(), kTissue, f).energy; };
  const Matrix3d f = stretchedAndTurned();
  const Matrix3d stress = evaluate(GetParam(), kTissue, f).stress;
  for (int i = 0; i < 9; ++i)
  {
    EXPECT_NEAR(stress.data()[i], derivative(energy, f, i), 1e-8 * kTissue.youngModulus);
  }
}

TEST_P(AnyEnergy, TangentIsTheDerivativeOfTheStress)
{
  const auto stress = [](const Matrix3d& f) -> Matrix3d
  { return evaluate(GetParam(), kTissue, f).stress; };
  const Matrix3d f = stretchedAndTurned();
  const Matrix9d tangent = evaluate(GetParam(), kTissue, f).tangent;
  for (int i = 0; i < 9; ++i)
  {
    const Matrix3d expected = derivative(stress, f, i);
    for (int j = 0; j < 9; ++j)
    {
      EXPECT_NEAR(tangent(j, i), expected.data()[j], 1e-8 * kTissue.youngModulus);
    }
  }
}

TEST_P(AnyEnergy, IsAtRestUndeformedAndStiffensAsHookeSays)
{
  const auto rest = evaluate(GetParam(), kTissue, Matrix3d::Identity());
  EXPECT_NEAR(rest.energy, 0.0, 1e-12);
  EXPECT_LT(rest.stress.norm(), 1e-12 * kTissue.youngModulus);
  const auto hooke = evaluate(StrainEnergy::Linear, kTissue, Matrix3d::Identity());
  EXPECT_LT((rest.tangent - hooke.tangent).norm(), 1e-12 * hooke.tangent.norm());
}

// a turn costs nothing, except to small-strain theory, which takes it for a strain
TEST_P(AnyEnergy, FeelsARotationOnlyInSmallStrainTheory)
{
  const Matrix3d turn = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).matrix();
  const Matrix3d f = stretchedAndTurned();
  const auto before = evaluate(GetParam(), kTissue, f);
  const auto after = evaluate(GetParam(), kTissue, turn * f);
  const double change = (after.stress - turn * before.stress).norm() / kTissue.youngModulus;
  EXPECT_EQ(change > 1e-12, GetParam() == StrainEnergy::Linear);
}

TEST(Constitutive, NamesAreReadBack)
{
  EXPECT_EQ(energyNamed("neo-hookean-isochoric"), StrainEnergy::NeoHookeanIsochoric);
  EXPECT_EQ(energyNamed(name(StrainEnergy::Corotated)), StrainEnergy::Corotated);
  EXPECT_EQ(energyNamed("mooney"), std::nullopt);
}

} // namespace
} // namespace palp::fem
