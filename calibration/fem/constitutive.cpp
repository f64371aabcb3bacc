#include "calibration/fem/constitutive.h"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <array>
#include <cmath>

namespace palp::fem
{
namespace
{

using Eigen::Matrix3d;
using Eigen::Vector3d;

struct Lame
{
  double lambda; // [Pa]
  double mu;     // [Pa]
};

Lame lame(const Material& material)
{
  const double nu = material.poissonRatio;
  const double mu = material.shearModulus();
  return { .lambda = 2.0 * mu * nu / (1.0 - 2.0 * nu), .mu = mu };
}

// derivative of F^-T, which is -F^-T dF^T F^-T
Matrix9d inverseTransposeDerivative(const Matrix3d& g)
{
  Matrix9d result;
  for (int column = 0; column < 9; ++column)
  {
    const int k = column % 3;
    const int l = column / 3;
    const Matrix3d change = -g.col(l) * g.row(k);
    result.col(column) = vec(change);
  }
  return result;
}

StressResponse linear(const Lame& m, const Matrix3d& gradient)
{
  const Matrix3d strain = 0.5 * (gradient + gradient.transpose()) - Matrix3d::Identity();
  const double trace = strain.trace();
  StressResponse out;
  out.energy = m.mu * strain.squaredNorm() + 0.5 * m.lambda * trace * trace;
  out.stress = 2.0 * m.mu * strain + m.lambda * trace * Matrix3d::Identity();
  const Vector9d one = vec(Matrix3d::Identity());
  out.tangent = m.mu * Matrix9d::Identity() + m.lambda * one * one.transpose();
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      out.tangent(i + 3 * j, j + 3 * i) += m.mu;
    }
  }
  return out;
}

StressResponse neoHookean(const Lame& m, const Matrix3d& gradient)
{
  const double logJ = std::log(gradient.determinant());
  const Matrix3d g = gradient.inverse().transpose();
  StressResponse out;
  out.energy =
    0.5 * m.mu * (gradient.squaredNorm() - 3.0) - m.mu * logJ + 0.5 * m.lambda * logJ * logJ;
  out.stress = m.mu * gradient + (m.lambda * logJ - m.mu) * g;
  const Matrix9d bend = inverseTransposeDerivative(g);
  out.tangent = m.mu * Matrix9d::Identity() + m.lambda * vec(g) * vec(g).transpose() +
    (m.lambda * logJ - m.mu) * bend;
  out.pressure = m.lambda * logJ; // theta = ln J
  out.bulk = m.lambda;
  out.volumeSlope = vec(g);
  out.volumeBend = bend;
  return out;
}

StressResponse neoHookeanIsochoric(const Lame& m, const Matrix3d& gradient)
{
  const double bulk = m.lambda + 2.0 / 3.0 * m.mu;
  const double j = gradient.determinant();
  const double scaled = m.mu * std::pow(j, -2.0 / 3.0);
  const double i1 = gradient.squaredNorm();
  const Matrix3d g = gradient.inverse().transpose();
  const Matrix3d deviator = gradient - i1 / 3.0 * g;
  StressResponse out;
  out.energy = 0.5 * (scaled * i1 - 3.0 * m.mu) + 0.5 * bulk * (j - 1.0) * (j - 1.0);
  out.stress = scaled * deviator + bulk * (j - 1.0) * j * g;
  const Matrix9d dg = inverseTransposeDerivative(g);
  out.tangent = scaled *
      (Matrix9d::Identity() - 2.0 / 3.0 * vec(deviator) * vec(g).transpose() -
        2.0 / 3.0 * vec(g) * vec(gradient).transpose() - i1 / 3.0 * dg) +
    bulk * j * ((2.0 * j - 1.0) * vec(g) * vec(g).transpose() + (j - 1.0) * dg);
  out.pressure = bulk * (j - 1.0); // theta = J
  out.bulk = bulk;
  out.volumeSlope = j * vec(g);
  out.volumeBend = j * (vec(g) * vec(g).transpose() + dg);
  return out;
}

StressResponse corotated(const Lame& m, const Matrix3d& gradient)
{
  const Eigen::JacobiSVD<Matrix3d> svd(gradient, Eigen::ComputeFullU | Eigen::ComputeFullV);
  // a gradient turned inside out keeps a proper rotation, its smallest stretch is negative
  Vector3d stretch = svd.singularValues();
  Matrix3d left = svd.matrixU();
  if (left.determinant() * svd.matrixV().determinant() < 0.0)
  {
    left.col(2) *= -1.0;
    stretch[2] *= -1.0;
  }
  const Matrix3d r = left * svd.matrixV().transpose();
  const Matrix3d u = svd.matrixV() * stretch.asDiagonal() * svd.matrixV().transpose();
  const double trace = u.trace() - 3.0;
  StressResponse out;
  out.energy = m.mu * (gradient - r).squaredNorm() + 0.5 * m.lambda * trace * trace;
  out.stress = 2.0 * m.mu * (gradient - r) + m.lambda * trace * r;
  out.tangent = 2.0 * m.mu * Matrix9d::Identity() + m.lambda * vec(r) * vec(r).transpose();

  // R turns with F: R^T dR is skew with the axial vector of R^T dF, weighed by (tr U) I - U
  const Matrix3d weight = (u.trace() * Matrix3d::Identity() - u).inverse();
  for (int column = 0; column < 9; ++column)
  {
    Matrix3d change = Matrix3d::Zero();
    change(column % 3, column / 3) = 1.0;
    const Matrix3d local = r.transpose() * change;
    const Vector3d turn = weight *
      Vector3d(local(2, 1) - local(1, 2), local(0, 2) - local(2, 0), local(1, 0) - local(0, 1));
    Matrix3d spin;
    spin << 0, -turn.z(), turn.y(), turn.z(), 0, -turn.x(), -turn.y(), turn.x(), 0;
    out.tangent.col(column) += (m.lambda * trace - 2.0 * m.mu) * vec(r * spin);
  }
  return out;
}

struct Known
{
  StrainEnergy energy;
  std::string_view name;
  std::string_view formula;
};

constexpr std::array kKnown{
  Known{ StrainEnergy::Linear, "linear", "small strain, gap at the undeformed radius" },
  Known{ StrainEnergy::Corotated, "corotated", "W = mu |F - R|^2 + lambda/2 (tr U - 3)^2" },
  Known{
    StrainEnergy::NeoHookean, "neo-hookean", "W = mu/2 (I1 - 3) - mu ln J + lambda/2 (ln J)^2" },
  Known{ StrainEnergy::NeoHookeanIsochoric, "neo-hookean-isochoric",
    "W = mu/2 (J^(-2/3) I1 - 3) + K/2 (J - 1)^2" },
};

} // namespace

std::string_view name(StrainEnergy energy) noexcept
{
  return kKnown[static_cast<std::size_t>(energy)].name;
}

std::string_view formula(StrainEnergy energy) noexcept
{
  return kKnown[static_cast<std::size_t>(energy)].formula;
}

std::optional<StrainEnergy> energyNamed(std::string_view name) noexcept
{
  for (const Known& known : kKnown)
  {
    if (known.name == name)
    {
      return known.energy;
    }
  }
  return std::nullopt;
}

StressResponse evaluate(StrainEnergy energy, const Material& material, const Matrix3d& gradient)
{
  const Lame moduli = lame(material);
  switch (energy)
  {
    case StrainEnergy::Linear:
      return linear(moduli, gradient);
    case StrainEnergy::Corotated:
      return corotated(moduli, gradient);
    case StrainEnergy::NeoHookean:
      return neoHookean(moduli, gradient);
    case StrainEnergy::NeoHookeanIsochoric:
      return neoHookeanIsochoric(moduli, gradient);
  }
  return {}; // every energy returned above
}

} // namespace palp::fem
