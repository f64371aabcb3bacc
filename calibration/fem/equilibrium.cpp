#include "calibration/fem/equilibrium.h"

#include "haptics/error.h"

#include <algorithm>

namespace palp::fem
{
namespace
{

using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd gather(const Element& element, const VectorXd& all)
{
  return all(element.dofs);
}

void checkPoisson(const Material& material)
{
  if (!(material.poissonRatio >= 0.0 && material.poissonRatio < 0.5))
  {
    throw Error(ErrorCode::BadValue,
      "poisson: finite elements need 0 or more and less than 0.5; give 0.49 for tissue like water");
  }
}

} // namespace

Equilibrium::Equilibrium(const Body& body, StrainEnergy energy, const Material& material)
  : body_(body)
  , energy_(energy)
  , material_(material)
  , held_(static_cast<std::size_t>(body.dofCount()), 0)
  , responses_(body.elements.size())
  , pressures_(body.elements.size())
  , before_(body.elements.size())
  , after_(body.elements.size())
{
  for (const Element& element : body.elements)
  {
    checkPoisson(element.material.value_or(material));
  }
  for (const int dof : body.heldDofs)
  {
    held_[static_cast<std::size_t>(dof)] = 1;
  }

  std::vector<Eigen::Triplet<double>> pattern;
  for (const Element& element : body.elements)
  {
    for (const int i : element.dofs)
    {
      for (const int j : element.dofs)
      {
        if (i >= j)
        {
          pattern.emplace_back(i, j, 0.0);
        }
      }
    }
  }
  matrix_.resize(body.dofCount(), body.dofCount());
  matrix_.setFromTriplets(pattern.begin(), pattern.end());
  solver_.analyzePattern(matrix_);

  const auto entryOf = [this](int i, int j)
  {
    const int* begin = matrix_.innerIndexPtr() + matrix_.outerIndexPtr()[j];
    const int* end = matrix_.innerIndexPtr() + matrix_.outerIndexPtr()[j + 1];
    return static_cast<int>(std::lower_bound(begin, end, i) - matrix_.innerIndexPtr());
  };
  for (int dof = 0; dof < body.dofCount(); ++dof)
  {
    diagonal_.push_back(entryOf(dof, dof));
  }
  for (const Element& element : body.elements)
  {
    std::vector<int> entries;
    for (std::size_t a = 0; a < element.dofs.size(); ++a)
    {
      for (std::size_t b = 0; b <= a; ++b)
      {
        const auto [low, high] = std::minmax(element.dofs[a], element.dofs[b]);
        entries.push_back(entryOf(high, low));
      }
    }
    entries_.push_back(std::move(entries));
  }
}

bool Equilibrium::assemble(const VectorXd& displacement)
{
  if (!assembleAll(displacement, false))
  {
    return false;
  }
  for (std::size_t e = 0; e < responses_.size(); ++e)
  {
    pressures_[e] = responses_[e].pressure;
  }
  return true;
}

bool Equilibrium::follow(const VectorXd& displacement, double part)
{
  for (std::size_t e = 0; e < pressures_.size() && part > 0.0; ++e)
  {
    pressures_[e] = before_[e] + part * (after_[e] - before_[e]);
  }
  return assembleAll(displacement, true);
}

bool Equilibrium::assembleAll(const VectorXd& displacement, bool guessed)
{
  forces_ = VectorXd::Zero(displacement.size());
  guessed_ = forces_;
  storedEnergy_ = 0.0;
  for (std::size_t e = 0; e < body_.elements.size(); ++e)
  {
    const Element& element = body_.elements[e];
    auto response = evaluate(element, energy_, element.material.value_or(material_),
      gather(element, displacement), guessed ? &pressures_[e] : nullptr);
    if (!response)
    {
      return false;
    }
    responses_[e] = std::move(*response);
    storedEnergy_ += responses_[e].energy;
    forces_(element.dofs) += responses_[e].force;
    guessed_(element.dofs) += responses_[e].guessedForce;
  }
  return forces_.allFinite();
}

// the pressures at the end of a step, by the slope of those of the displacement
void Equilibrium::predict(const VectorXd& change)
{
  before_ = pressures_;
  for (std::size_t e = 0; e < responses_.size(); ++e)
  {
    const ElementResponse& at = responses_[e];
    after_[e] = at.pressure + at.pressureSlope * gather(body_.elements[e], change);
  }
}

// fills the matrix; returns the residual of the dofs that are free
VectorXd Equilibrium::linearize(const std::vector<ContactConstraint>& sliding, double added)
{
  std::vector<int> slidingOf(static_cast<std::size_t>(body_.nodeCount()), -1);
  for (std::size_t s = 0; s < sliding.size(); ++s)
  {
    slidingOf[static_cast<std::size_t>(sliding[s].node)] = static_cast<int>(s);
  }
  std::fill_n(matrix_.valuePtr(), matrix_.nonZeros(), 0.0);
  VectorXd residual = VectorXd::Zero(body_.dofCount());
  for (std::size_t e = 0; e < body_.elements.size(); ++e)
  {
    scatter(e, slidingOf, sliding, residual);
  }

  // a held or sliding dof keeps a row of its own, so that the pattern never changes
  const int d = body_.dimension;
  std::vector<char> removed = held_;
  for (const ContactConstraint& s : sliding)
  {
    removed[static_cast<std::size_t>(d * s.node + d - 1)] = 1;
    const double press = forces_[d * s.node + d - 1];
    for (int i = 0; i < d - 1; ++i)
    {
      for (int j = 0; j <= i; ++j)
      {
        // the two horizontal dofs of a node are neighbors in the column
        const int at = diagonal_[static_cast<std::size_t>(body_.dofOf(s.node) + j)] + (i - j);
        matrix_.valuePtr()[at] += press * s.curvature(i, j);
      }
    }
  }
  const double unit = material_.youngModulus * body_.top / body_.nodeCount();
  for (int dof = 0; dof < body_.dofCount(); ++dof)
  {
    matrix_.valuePtr()[diagonal_[static_cast<std::size_t>(dof)]] *= 1.0 + added;
    if (removed[static_cast<std::size_t>(dof)] != 0)
    {
      for (int at = matrix_.outerIndexPtr()[dof]; at < matrix_.outerIndexPtr()[dof + 1]; ++at)
      {
        matrix_.valuePtr()[at] = 0.0;
      }
      matrix_.valuePtr()[diagonal_[static_cast<std::size_t>(dof)]] = unit;
      residual[dof] = 0.0;
    }
  }
  return residual;
}

Equilibrium::Step Equilibrium::solve(const std::vector<ContactConstraint>& sliding, double added)
{
  const VectorXd residual = linearize(sliding, added);
  Step step{ .residual = residual.lpNorm<Eigen::Infinity>(),
    .imbalance = (residual + onTheTool(guessed_ - forces_, sliding)).lpNorm<Eigen::Infinity>() };
  solver_.factorize(matrix_);
  if (solver_.info() != Eigen::Success)
  {
    return step;
  }
  step.stable = solver_.vectorD().minCoeff() > 0.0;
  step.change = solver_.solve(-residual);
  const int d = body_.dimension;
  for (const ContactConstraint& s : sliding)
  {
    step.change[d * s.node + d - 1] =
      s.gap + s.slope.head(d - 1).dot(step.change.segment(body_.dofOf(s.node), d - 1));
  }
  if (!step.change.allFinite())
  {
    step.change.resize(0);
    return step;
  }
  predict(step.change);
  return step;
}

int Equilibrium::invertedElements() const noexcept
{
  return static_cast<int>(std::count_if(responses_.begin(), responses_.end(),
    [](const ElementResponse& response) { return response.inverted; }));
}

double Equilibrium::imbalance(const std::vector<ContactConstraint>& sliding) const
{
  return onTheTool(guessed_, sliding).lpNorm<Eigen::Infinity>();
}

// what forces do to the dofs that are free while nodes slide
VectorXd Equilibrium::onTheTool(
  VectorXd forces, const std::vector<ContactConstraint>& sliding) const
{
  const int d = body_.dimension;
  for (const ContactConstraint& s : sliding)
  {
    const double press = forces[d * s.node + d - 1];
    forces.segment(body_.dofOf(s.node), d - 1) += s.slope.head(d - 1) * press;
    forces[d * s.node + d - 1] = 0.0;
  }
  for (const int dof : body_.heldDofs)
  {
    forces[dof] = 0.0;
  }
  return forces;
}

// the heights of sliding nodes are eliminated: height = gap + slope * horizontal
void Equilibrium::scatter(std::size_t e, const std::vector<int>& slidingOf,
  const std::vector<ContactConstraint>& sliding, VectorXd& residual)
{
  const std::vector<int>& dofs = body_.elements[e].dofs;
  const int d = body_.dimension;
  const auto nodes = static_cast<int>(dofs.size()) / d;
  std::vector<char> removed(dofs.size());
  for (std::size_t a = 0; a < dofs.size(); ++a)
  {
    removed[a] = held_[static_cast<std::size_t>(dofs[a])];
  }

  MatrixXd stiffness = responses_[e].stiffness;
  VectorXd force = responses_[e].force;
  std::vector<std::pair<int, const ContactConstraint*>> touching;
  for (int a = 0; a < nodes; ++a)
  {
    const int node = dofs[static_cast<std::size_t>(d) * static_cast<std::size_t>(a)] / d;
    if (const int s = slidingOf[static_cast<std::size_t>(node)]; s >= 0)
    {
      touching.emplace_back(d * a, &sliding[static_cast<std::size_t>(s)]);
    }
  }
  for (const auto& [first, slide] : touching)
  {
    force += slide->gap * stiffness.col(first + d - 1);
  }
  for (const auto& [first, slide] : touching)
  {
    const int height = first + d - 1;
    for (int i = 0; i < d - 1; ++i)
    {
      stiffness.row(first + i) += slide->slope[i] * stiffness.row(height);
      force[first + i] += slide->slope[i] * force[height];
    }
    for (int i = 0; i < d - 1; ++i)
    {
      stiffness.col(first + i) += slide->slope[i] * stiffness.col(height);
    }
    removed[static_cast<std::size_t>(height)] = 1;
  }

  std::size_t at = 0;
  for (std::size_t a = 0; a < dofs.size(); ++a)
  {
    residual[dofs[a]] += force[static_cast<Eigen::Index>(a)];
    for (std::size_t b = 0; b <= a; ++b, ++at)
    {
      if (removed[a] == 0 && removed[b] == 0)
      {
        matrix_.valuePtr()[entries_[e][at]] +=
          stiffness(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b));
      }
    }
  }
}

} // namespace palp::fem
