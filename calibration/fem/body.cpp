#include "calibration/fem/body.h"

#include <Eigen/LU>
#include <cmath>

namespace palp::fem
{
namespace
{

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Gradient = Eigen::Matrix<double, 9, Eigen::Dynamic>;

Matrix3d deformation(const Gradient& gradient, const VectorXd& displacement)
{
  const Vector9d change = gradient * displacement;
  return Matrix3d::Identity() + Eigen::Map<const Matrix3d>(change.data());
}

void add(ElementResponse& out, double weight, const Gradient& b, const StressResponse& local)
{
  out.energy += weight * local.energy;
  out.force.noalias() += weight * b.transpose() * vec(local.stress);
  const Gradient scaled = weight * local.tangent * b;
  out.stiffness.noalias() += b.transpose() * scaled;
}

// the trace of the strain becomes its mean
Gradient withMeanTrace(const Element& element, const Gradient& b)
{
  const Vector9d one = vec(Matrix3d::Identity());
  Eigen::RowVectorXd mean = Eigen::RowVectorXd::Zero(b.cols());
  double volume = 0.0;
  for (const IntegrationPoint& point : element.points)
  {
    mean += point.weight * one.transpose() * point.gradient;
    volume += point.weight;
  }
  return b + one / 3.0 * (mean / volume - one.transpose() * b);
}

// second derivative of ln J: -tr(F^-1 dF F^-1 dF)
MatrixXd logVolumeHessian(const Matrix3d& inverse, const Gradient& b)
{
  Matrix9d form;
  for (int i = 0; i < 9; ++i)
  {
    for (int j = 0; j < 9; ++j)
    {
      form(i, j) = -inverse(j / 3, i % 3) * inverse(i / 3, j % 3);
    }
  }
  return b.transpose() * form * b;
}

struct Volume
{
  Matrix3d f;
  double j;
  VectorXd slope;     // d ln J / du
  MatrixXd curvature; // d2 ln J / du2
};

bool respondWithMeanVolume(const Element& element, StrainEnergy energy, const Material& material,
  const VectorXd& displacement, ElementResponse& out)
{
  const auto size = displacement.size();
  std::vector<Volume> local;
  double volume = 0.0;
  double deformed = 0.0;
  VectorXd slope = VectorXd::Zero(size);
  MatrixXd curvature = MatrixXd::Zero(size, size);
  for (const IntegrationPoint& point : element.points)
  {
    Volume v;
    v.f = deformation(point.gradient, displacement);
    v.j = v.f.determinant();
    if (!(v.j > 0.0))
    {
      return false;
    }
    const Matrix3d inverse = v.f.inverse();
    v.slope = point.gradient.transpose() * vec(inverse.transpose());
    v.curvature = logVolumeHessian(inverse, point.gradient);
    volume += point.weight;
    deformed += point.weight * v.j;
    slope += point.weight * v.j * v.slope;
    curvature += point.weight * v.j * (v.slope * v.slope.transpose() + v.curvature);
    local.push_back(std::move(v));
  }
  slope /= deformed;
  curvature = curvature / deformed - slope * slope.transpose();

  for (std::size_t i = 0; i < local.size(); ++i)
  {
    const Volume& v = local[i];
    const IntegrationPoint& point = element.points[i];
    const double scale = std::cbrt(deformed / volume / v.j);
    const VectorXd turn = (slope - v.slope) / 3.0; // d ln(scale) / du
    const MatrixXd bend = (curvature - v.curvature) / 3.0;
    const StressResponse stress = evaluate(energy, material, scale * v.f);
    add(out, point.weight, scale * (point.gradient + vec(v.f) * turn.transpose()), stress);

    // stress times the second derivative of scale * F
    const VectorXd pull = point.gradient.transpose() * vec(stress.stress);
    const double dot = vec(stress.stress).dot(vec(v.f));
    out.stiffness += point.weight * scale *
      (pull * turn.transpose() + turn * pull.transpose() + dot * (turn * turn.transpose() + bend));
  }
  return true;
}

} // namespace

std::optional<ElementResponse> evaluate(const Element& element, StrainEnergy energy,
  const Material& material, const VectorXd& displacement, const VectorXd* guess)
{
  ElementResponse out;
  out.force = VectorXd::Zero(displacement.size());
  out.stiffness = MatrixXd::Zero(displacement.size(), displacement.size());
  if (element.meanDilatation && energy != StrainEnergy::Linear)
  {
    const bool valid = respondWithMeanVolume(element, energy, material, displacement, out);
    out.pressureSlope.resize(0, displacement.size());
    out.guessedForce = out.force;
    return valid ? std::optional(std::move(out)) : std::nullopt;
  }
  const auto points = static_cast<Eigen::Index>(element.points.size());
  out.guessedForce = out.force;
  out.pressure.resize(points);
  out.pressureSlope.resize(points, displacement.size());
  for (Eigen::Index i = 0; i < points; ++i)
  {
    const IntegrationPoint& point = element.points[static_cast<std::size_t>(i)];
    const Gradient b =
      element.meanDilatation ? withMeanTrace(element, point.gradient) : point.gradient;
    const Matrix3d f = deformation(b, displacement);
    const bool inverted = energy != StrainEnergy::Linear && !(f.determinant() > 0.0);
    out.inverted = out.inverted || inverted;
    if (inverted && energy != StrainEnergy::Corotated)
    {
      return std::nullopt;
    }
    StressResponse local = evaluate(energy, material, f);
    out.pressure[i] = local.pressure;
    out.pressureSlope.row(i) = local.bulk * local.volumeSlope.transpose() * b;
    if (guess != nullptr)
    {
      const double other = (*guess)[i] - local.pressure;
      local.tangent += other * local.volumeBend;
      out.guessedForce += point.weight * other * (b.transpose() * local.volumeSlope);
    }
    add(out, point.weight, b, local);
  }
  out.guessedForce += out.force;
  return out;
}

} // namespace palp::fem
