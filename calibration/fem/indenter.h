#pragma once

#include "calibration/fem/equilibrium.h"
#include "haptics/tip/tip.h"

#include <stop_token>
#include <string>
#include <vector>

namespace palp::fem
{

/// The pressed body at one depth.
struct IndentationStep
{
  double depth = 0.0;         ///< delta [m]
  double force = 0.0;         ///< pressed by the tool, from the contact [N]
  double baseReaction = 0.0;  ///< carried by the held base [N]
  double contactRadius = 0.0; ///< on the deformed surface [m]
  double penetration = 0.0;   ///< largest, of a node into the tool [m]
  int inverted = 0;           ///< elements inside out, which only a corotated material survives

  struct Point
  {
    double radius; ///< of the undeformed point [m]
    double ur;     ///< outward displacement [m]
    double uz;     ///< upward displacement [m]
  };
  std::vector<Point> profile{}; ///< along a ray from the axis
};

/// Enough of a pressed body to go on from.
struct Checkpoint
{
  double depth = 0.0;           ///< delta [m]
  Eigen::VectorXd displacement; ///< of all dofs [m]
};

/// What press says once it is asked to stop.
constexpr const char* kInterrupted = "interrupted; --resume goes on from here";

/// Presses a rigid, frictionless tool into a body, deeper and deeper.
///
/// Total Lagrangian; the nodes in contact slide on the exact tool surface (their height is
/// eliminated), which nodes those are is found by an active set: a node that would be pulled is
/// released, one that would enter the tool is taken. Under a tool of revolution only the edge of
/// the contact is released: the force at one node of a quadratic element does not tell the
/// pressure's sign. A state in which the surface folds, is pulled or hangs off the tool is none.
class Indenter
{
public:
  /// @param body    borrowed; must outlive this
  /// @throws Error  BadValue: see Equilibrium
  Indenter(const Body& body, const Tip& tip, StrainEnergy energy, const Material& material);

  /// Goes from the present depth to a deeper one, in smaller steps where needed.
  /// @param depth   delta [m], more than before
  /// @param stop    asked before every Newton step
  /// @throws Error  NoSolution: says at which depth and why, or
  ///                kInterrupted; the last solution stays
  void press(double depth, const std::stop_token& stop = {});

  [[nodiscard]] IndentationStep state() const;

  [[nodiscard]] Checkpoint checkpoint() const
  {
    return { depth_, displacement_ };
  }

  /// Goes back to a state of the same body, tool and material.
  /// @throws Error  BadFile: of another size, or no equilibrium
  void resume(const Checkpoint& checkpoint);

private:
  struct ToolPoint
  {
    double height; // of the tool above the undeformed top, at this depth [m]
    Eigen::Vector2d slope;
    Eigen::Matrix2d curvature;
    bool below; // the tool reaches that far from its axis
  };
  [[nodiscard]] ToolPoint toolAt(int node) const;
  [[nodiscard]] double heightOf(int node) const;
  [[nodiscard]] double radiusOf(int node) const;
  [[nodiscard]] std::vector<ContactConstraint> sliding() const;
  [[nodiscard]] bool updateContact(double force, bool onlyOne);
  [[nodiscard]] Equilibrium::Step descentStep(std::vector<ContactConstraint> nodes, bool mayTurn);
  [[nodiscard]] bool lineSearch(
    const Equilibrium::Step& step, std::vector<ContactConstraint> nodes, bool closed);
  [[nodiscard]] std::string solveEquilibrium(
    double depth, const std::stop_token& stop, int iterations); // empty, or failure
  [[nodiscard]] std::string surfaceFault() const; // empty, or why no tool presses such a surface
  [[nodiscard]] double contactRadius() const;
  [[nodiscard]] bool contactReachesRim() const;

  struct Held
  {
    Eigen::VectorXd displacement;
    std::vector<char> touching;
    double depth;
    double force;
  };
  void restore(const Held& held);

  const Body& body_;
  Tip tip_;
  StrainEnergy energy_;
  Equilibrium equilibrium_;
  Eigen::VectorXd displacement_;
  std::vector<char> touching_; // per node of body_.surface
  double depth_ = 0.0;
  double force_ = 0.0;
  Eigen::VectorXd previous_; // displacement before the last step, for extrapolation
  double previousDepth_ = 0.0;
};

} // namespace palp::fem
