#include "calibration/baselines/backward_euler.h"

namespace palp::fem
{

using Eigen::Matrix3Xd;

BackwardEuler::BackwardEuler(const Eigen::VectorXd& masses, std::vector<int> bonded)
  : masses_(masses)
  , bonded_(std::move(bonded))
{
  for (Matrix3Xd* m :
    { &load_, &residual_, &direction_, &product_, &scaled_, &inverseDiagonal_, &reactions_ })
  {
    m->setZero(3, masses_.size());
  }
}

void BackwardEuler::apply(const System& system, const Matrix3Xd& v, Matrix3Xd& product) const
{
  system.stiffness.multiply(v, product);
  const double ofStiffness = system.dt * (system.dt + system.beta);
  const double ofMass = 1.0 + system.alpha * system.dt;
  product =
    ofStiffness * product + ((ofMass * masses_).replicate<3, 1>().array() * v.array()).matrix();
}

// keeps what bonded nodes and nodes of given speed may do
void BackwardEuler::restrict(const System& system, Matrix3Xd& v) const
{
  for (const int i : bonded_)
  {
    v.col(i).setZero();
  }
  for (const VelocityConstraint& g : system.given)
  {
    v.col(g.node) -= g.normal.dot(v.col(g.node)) * g.normal;
  }
}

BackwardEuler::Solution BackwardEuler::solve(const System& system, Matrix3Xd& velocity)
{
  load_ =
    (masses_.replicate<3, 1>().array() * velocity.array()).matrix() + system.dt * system.forces;
  const double ofStiffness = system.dt * (system.dt + system.beta);
  const double ofMass = 1.0 + system.alpha * system.dt;
  for (Eigen::Index i = 0; i < masses_.size(); ++i)
  {
    const auto& block = system.stiffness.diagonal()[static_cast<std::size_t>(i)];
    inverseDiagonal_.col(i) =
      (ofStiffness * block.diagonal().array() + ofMass * masses_[i]).inverse();
  }

  restrict(system, velocity);
  for (const VelocityConstraint& g : system.given)
  {
    velocity.col(g.node) += g.speed * g.normal;
  }
  apply(system, velocity, product_);
  residual_ = load_ - product_;
  restrict(system, residual_);

  const double enough = system.tolerance * load_.norm();
  double norm = residual_.norm();
  double descent = 0.0;
  int k = 0;
  for (; k < system.mostIterations && norm > enough; ++k)
  {
    scaled_ = residual_.cwiseProduct(inverseDiagonal_);
    restrict(system, scaled_);
    const double before = descent;
    descent = residual_.cwiseProduct(scaled_).sum();
    direction_ = k == 0 ? scaled_ : Matrix3Xd(scaled_ + descent / before * direction_);
    apply(system, direction_, product_);
    const double length = descent / direction_.cwiseProduct(product_).sum();
    velocity += length * direction_;
    restrict(system, product_);
    residual_ -= length * product_;
    norm = residual_.norm();
  }

  apply(system, velocity, product_);
  reactions_ = (product_ - load_) / system.dt;
  const double scale = load_.norm();
  return { .iterations = k, .residual = scale > 0.0 ? norm / scale : 0.0 };
}

} // namespace palp::fem
