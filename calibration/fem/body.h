#pragma once

#include "calibration/fem/constitutive.h"

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace palp::fem
{

/// Where the energy density is sampled inside an element.
struct IntegrationPoint
{
  double weight = 0.0;                               ///< undeformed volume of the whole body [m^3]
  Eigen::Matrix<double, 9, Eigen::Dynamic> gradient; ///< vec(grad u) = gradient * displacements
};

/// A finite element: displacements in, gradients out. Dimension, symmetry and shape are in there.
struct Element
{
  std::vector<int> dofs{};
  std::vector<IntegrationPoint> points{};
  bool meanDilatation =
    false; ///< volume change averaged over the element, so that nu = 0.49 does not lock
  std::optional<Material> material{}; ///< where it is not the body's
};

/// The soft body: axisymmetric (r, z), or a block (x, y, z); the last coordinate points out of it.
struct Body
{
  int dimension = 2;           ///< 2 or 3; node n owns the dofs dimension * n and following
  Eigen::MatrixXd positions{}; ///< dimension x #nodes, undeformed [m]
  std::vector<Element> elements{};
  std::vector<int> surface{};  ///< nodes that the tool may touch
  std::vector<int> profile{};  ///< nodes of the surface on one ray from the axis, outwards
  std::vector<int> base{};     ///< nodes held in place
  std::vector<int> heldDofs{}; ///< displacements that stay zero, base and symmetry
  double top = 0.0;            ///< height at which the tool first touches [m]
  double elementSize = 0.0;    ///< under the tool [m]

  /// First dof of a node.
  [[nodiscard]] Eigen::Index dofOf(int node) const noexcept
  {
    return static_cast<Eigen::Index>(dimension) * node;
  }

  [[nodiscard]] int nodeCount() const
  {
    return static_cast<int>(positions.cols());
  }
  [[nodiscard]] int dofCount() const
  {
    return dimension * nodeCount();
  }
};

/// What an element answers to a displacement.
struct ElementResponse
{
  double energy = 0.0;       ///< [J]
  Eigen::VectorXd force;     ///< dW/du [N]
  Eigen::MatrixXd stiffness; ///< d2W/du2 [N/m], symmetric
  bool inverted = false;     ///< turned inside out, which a corotated material survives

  // of elements without mean dilatation, per integration point
  Eigen::VectorXd pressure;      ///< of the displacement [Pa]
  Eigen::MatrixXd pressureSlope; ///< its derivative, points x dofs [Pa/m]
  Eigen::VectorXd guessedForce;  ///< force [N] with the guessed pressures
};

/// @param displacement  of the element's dofs [m]
/// @param guess         null, or the pressures by which the stiffness counts how the volume bends;
///                      energy and force are those of the displacement
/// @return              nothing where the element is turned inside out
/// @source              mean dilatation: Nagtegaal, Parks and Rice 1974, as an energy of
///                      (Jmean / J)^(1/3) F
[[nodiscard]] std::optional<ElementResponse> evaluate(const Element& element, StrainEnergy energy,
  const Material& material, const Eigen::VectorXd& displacement,
  const Eigen::VectorXd* guess = nullptr);

} // namespace palp::fem
