#pragma once

#include "calibration/fem/body.h"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <vector>

namespace palp::fem
{

/// A node of the surface that slides on the tool: its height follows from where it is.
struct ContactConstraint
{
  int node;
  double gap;                ///< height of the tool above the node [m]; the step closes it
  Eigen::Vector2d slope;     ///< of the tool to the node's horizontal coordinates [-]
  Eigen::Matrix2d curvature; ///< [1/m]
};

/// Sparse linear systems of a body, whose pattern is analyzed once. The elements are of our own,
/// for pressing tissue to large strain, nearly without change of volume, is what the tables are
/// made of.
class Equilibrium
{
public:
  /// @throws Error  BadValue: nu outside [0, 0.5)
  Equilibrium(const Body& body, StrainEnergy energy, const Material& material);

  /// Internal forces dW/du [N] and their derivative at a displacement of all dofs [m].
  /// @return  false where an element is turned inside out
  [[nodiscard]] bool assemble(const Eigen::VectorXd& displacement);

  /// The same after a part of the last step, or of none. The stiffness counts how the volume
  /// bends by pressures that go with the step, not by those of the displacement, which near nu =
  /// 0.5 follow from what the step left of the volume and mislead the next one.
  /// @source  Magisano, Leonetti and Garcea 2017: mixed integration points
  [[nodiscard]] bool follow(const Eigen::VectorXd& displacement, double part);

  /// Stored [J].
  [[nodiscard]] double energy() const noexcept
  {
    return storedEnergy_;
  }
  [[nodiscard]] int invertedElements() const noexcept;
  [[nodiscard]] const Eigen::VectorXd& forces() const noexcept
  {
    return forces_;
  }
  /// With the pressures of the steps.
  [[nodiscard]] const Eigen::VectorXd& guessedForces() const noexcept
  {
    return guessed_;
  }

  /// Residual and Newton step with held dofs at rest and sliding nodes on the tool.
  /// @param added  part of the diagonal that is added to it, for a shorter and safer step [-]
  struct Step
  {
    double residual = 0.0;    ///< largest unbalanced force after the gaps are closed [N]
    double imbalance = 0.0;   ///< the same with the pressures of the steps [N]
    bool stable = false;      ///< the energy is convex here
    Eigen::VectorXd change{}; ///< of all dofs [m]; empty where the system is singular
  };
  [[nodiscard]] Step solve(const std::vector<ContactConstraint>& sliding, double added = 0.0);

  /// Largest unbalanced force where the sliding nodes are [N], at the assembled displacement and
  /// with the pressures of the steps.
  [[nodiscard]] double imbalance(const std::vector<ContactConstraint>& sliding) const;

private:
  [[nodiscard]] bool assembleAll(const Eigen::VectorXd& displacement, bool guessed);
  [[nodiscard]] Eigen::VectorXd onTheTool(
    Eigen::VectorXd forces, const std::vector<ContactConstraint>& sliding) const;
  void predict(const Eigen::VectorXd& change);
  [[nodiscard]] Eigen::VectorXd linearize(
    const std::vector<ContactConstraint>& sliding, double added);
  void scatter(std::size_t element, const std::vector<int>& slidingOf,
    const std::vector<ContactConstraint>& sliding, Eigen::VectorXd& residual);

  const Body& body_;
  StrainEnergy energy_;
  Material material_;
  std::vector<char> held_;                 // per dof
  std::vector<ElementResponse> responses_; // per element
  std::vector<std::vector<int>> entries_;  // per element: lower triangle into the matrix's values
  std::vector<int> diagonal_;              // per dof: into the matrix's values
  double storedEnergy_ = 0.0;
  Eigen::VectorXd forces_;
  Eigen::VectorXd guessed_;                // forces with the pressures of the steps
  std::vector<Eigen::VectorXd> pressures_; // per element and integration point, of the steps
  std::vector<Eigen::VectorXd> before_;    // the same when the last step was found
  std::vector<Eigen::VectorXd> after_;     // and at its end
  Eigen::SparseMatrix<double> matrix_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> solver_;
};

} // namespace palp::fem
