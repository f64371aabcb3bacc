#include "haptics/force/series/compliance_field.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

namespace palp
{

// by least squares, of the constants and their gradients around
std::array<Eigen::Vector3f, 2> ComplianceField::curvesAt(const Place& place) const
{
  constexpr float kAlike = 0.7F; // cosine of normals
  const Eigen::Vector3f right = place.normal.unitOrthogonal();
  const Eigen::Vector3f ahead = place.normal.cross(right);
  Eigen::Matrix3f squares = Eigen::Matrix3f::Zero();
  Eigen::Vector3f sums = Eigen::Vector3f::Zero();
  const auto add = [&](const Eigen::Vector3f& terms, float value)
  {
    squares += terms * terms.transpose();
    sums += value * terms;
  };
  const Range range = near(place.position.cast<double>());
  for (std::uint32_t k = range.first; k < range.last; ++k)
  {
    const Place& other = places_[near_[k]];
    const Eigen::Vector3f to = other.position - place.position;
    const float distance = to.norm();
    if (!other.isBetween || other.doubtful > 0.0F || distance >= reach_ || !(distance > 0.0F) ||
      other.normal.dot(place.normal) < kAlike)
    {
      continue;
    }
    const float x = perReach_ * to.dot(right);
    const float y = perReach_ * to.dot(ahead);
    const float half = 0.5F * perReach_ * distance;
    const Eigen::Vector3f turned = reach_ * (other.gradient - place.gradient);
    add({ 0.5F * x * x, x * y, 0.5F * y * y }, other.rest - place.rest - place.gradient.dot(to));
    add(half * Eigen::Vector3f(x, y, 0.0F), half * turned.dot(right));
    add(half * Eigen::Vector3f(0.0F, x, y), half * turned.dot(ahead));
  }
  constexpr float kLeast = 1e-3F; // what few tell is none
  squares.diagonal().array() += kLeast;
  const Eigen::Vector3f found = squares.ldlt().solve(sums);
  Eigen::Matrix2f second;
  second << found[0], found[1], found[1], found[2];
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2f> along(second);
  const Eigen::Array2f roots = along.eigenvalues().array().max(0.0F).sqrt() * perReach_;
  const auto curve = [&](int k) -> Eigen::Vector3f
  { return roots[k] * (along.eigenvectors()(0, k) * right + along.eigenvectors()(1, k) * ahead); };
  return { curve(0), curve(1) };
}

} // namespace palp
