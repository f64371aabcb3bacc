#include "haptics/contact/overlap/overlap.h"

#include "haptics/contact/overlap/piece.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace palp
{
namespace
{

constexpr double kInscribed =
  0.99;                         // [-] of a cross section's outer radius: less than its inner one
constexpr double kAlong = 1e-3; // [-] sine between a triangle and a side that it lies along

using Field = ToolSolid::Field;
using Layer = ToolSolid::Layer;

// Sums over the triangles in a tool.
class Sums
{
public:
  Sums(const ToolSolid& solid, bool closed) noexcept
    : solid_(&solid)
    , beyond_(solid.beyond())
    , closed_(closed)
  {
  }

  // @param isBorder  of which side of the triangle, whether nothing is beyond it
  void add(const std::array<Eigen::Vector3d, 3>& corners, const Eigen::Vector3d& normal,
    const std::array<bool, 3>& isBorder) noexcept
  {
    const auto [low, high] = std::minmax({ corners[0].z(), corners[1].z(), corners[2].z() });
    const Eigen::Vector3d middle = (corners[0] + corners[1] + corners[2]) / 3.0;
    double extent = 0.0;
    for (const Eigen::Vector3d& corner : corners)
    {
      extent = std::max(extent, (corner - middle).head<2>().norm());
    }
    const double nearest = kInscribed * (middle.head<2>().norm() - extent);
    if (high > beyond_.low && nearest <= beyond_.radius)
    {
      addBeyond(corners, normal);
    }
    for (const Layer& layer : solid_->layers())
    {
      const bool isLowest = &layer == solid_->layers().data();
      const double widest = layer.radiusAt(std::min(high, layer.high));
      if (high < layer.low || low >= layer.high || nearest > widest)
      {
        continue;
      }
      Piece piece(corners);
      clipTo(layer, piece);
      if (piece.size() < 3)
      {
        continue;
      }
      addPiece(layer, piece, normal, isLowest);
      for (std::size_t k = 0; k < piece.size(); ++k)
      {
        const std::int8_t bound = piece.bound(k);
        if (bound < codeOf(Bound::Bottom) && isBorder[at(bound)])
        {
          const Eigen::Vector3d& from = piece[k];
          const Eigen::Vector3d& to = piece[piece.after(k)];
          sum_.area -= acrossBorder(layer, layer.volume, from, to);
          if (solid_->isFlat())
          {
            sum_.liftArea -= acrossBorder(layer, layer.lift, from, to);
          }
        }
      }
    }
  }

  [[nodiscard]] const Overlap& sum() const noexcept
  {
    return sum_;
  }

private:
  // Integrals over a piece.
  struct Integrals
  {
    double area = 0.0;
    double twist = 0.0;   // of 1 / cube of the height over the pole
    double squares = 0.0; // of the height
    Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  };

  static Integrals integralsOf(
    const Layer& layer, const Piece& piece, const Eigen::Vector3d& normal) noexcept
  {
    Integrals sum;
    const Eigen::Vector3d& first = piece[0];
    const double rise = first.z() - layer.pole;
    for (std::size_t k = 1; k + 1 < piece.size(); ++k)
    {
      const Eigen::Vector3d& a = piece[k];
      const Eigen::Vector3d& b = piece[k + 1];
      const Eigen::Vector3d corners = first + a + b;
      const double part = 0.5 * normal.dot((a - first).cross(b - first));
      sum.area += part;
      sum.moment += part / 3.0 * corners;
      sum.squares += part / 12.0 *
        (first.z() * first.z() + a.z() * a.z() + b.z() * b.z() + corners.z() * corners.z());
      if (layer.volume.twist != 0.0 || layer.lift.twist != 0.0)
      {
        sum.twist += part / (rise * (a.z() - layer.pole) * (b.z() - layer.pole));
      }
    }
    return sum;
  }

  // of a field
  static double through(const Layer& layer, const Field& field, const Integrals& sums,
    const Piece& piece, const Eigen::Vector3d& normal) noexcept
  {
    const double rise = sums.moment.z() - layer.pole * sums.area;
    if (layer.isShaft())
    {
      return normal.z() *
        (layer.upward(field, 0.0) * sums.area + field.constant * sums.moment.z() +
          0.5 * field.linear * sums.squares);
    }
    return (layer.atPole(field) * sums.area + 0.25 * field.linear * rise +
             field.twist * sums.twist) *
      normal.dot(piece[0] - layer.pole * Eigen::Vector3d::UnitZ());
  }

  // what went into the shaft leaves the body there, as often as it comes in; a sheet has no inside
  void addBeyond(
    const std::array<Eigen::Vector3d, 3>& corners, const Eigen::Vector3d& normal) noexcept
  {
    Piece piece(corners);
    clipTo(beyond_, piece);
    if (piece.size() < 3)
    {
      return;
    }
    sum_.isBeyond = true;
    if (closed_)
    {
      const Integrals sums = integralsOf(beyond_, piece, normal);
      sum_.volume += through(beyond_, beyond_.volume, sums, piece, normal);
      sum_.lift += through(beyond_, beyond_.lift, sums, piece, normal);
    }
  }

  void addPiece(
    const Layer& layer, const Piece& piece, const Eigen::Vector3d& normal, bool isLowest) noexcept
  {
    const Integrals sums = integralsOf(layer, piece, normal);
    const double area = sums.area;
    const Eigen::Vector3d& moment = sums.moment;
    sum_.volume += through(layer, layer.volume, sums, piece, normal);
    sum_.area += area * normal;
    if (solid_->isFlat())
    {
      sum_.lift += through(layer, layer.lift, sums, piece, normal);
      sum_.liftArea += moment.z() * normal;
    }
    if (!(normal.z() > 0.0))
    {
      return;
    }
    const double facing = normal.z() * normal.z();
    Eigen::Vector3d widening = Eigen::Vector3d::Zero();
    Eigen::Matrix3d shifting = Eigen::Matrix3d::Zero();
    for (std::size_t k = 0; k < piece.size(); ++k)
    {
      if (!isOfTool(piece.bound(k), isLowest))
      {
        continue;
      }
      const Eigen::Vector3d outward = outwardOf(layer, piece.bound(k));
      const Eigen::Vector3d& from = piece[k];
      const Eigen::Vector3d& to = piece[piece.after(k)];
      const double sine = std::max(kAlong, outward.cross(normal).norm());
      const Eigen::Vector3d part = (to - from).norm() / sine * outward;
      widening += part;
      shifting += 0.5 * (from + to) * part.transpose();
    }
    sum_.weight += facing * area;
    sum_.normal += facing * area * normal;
    sum_.place += facing * moment;
    sum_.placeSlope += facing * shifting;
    sum_.weightSlope += facing * widening;
    sum_.normalSlope += facing * normal * widening.transpose();
  }

  // and neither of the triangle nor between two layers
  static bool isOfTool(std::int8_t bound, bool isLowest) noexcept
  {
    return bound >= codeOf(Bound::Side) || (isLowest && bound == codeOf(Bound::Bottom));
  }

  static Eigen::Vector3d outwardOf(const Layer& layer, std::int8_t bound) noexcept
  {
    if (bound == codeOf(Bound::Bottom))
    {
      return { 0.0, 0.0, -1.0 };
    }
    const Eigen::Vector2d to =
      ToolSolid::outward(static_cast<std::size_t>(bound - codeOf(Bound::Side)));
    return layer.perSquare * Eigen::Vector3d(to.x(), to.y(), -layer.slope);
  }

  // what a field takes across a part of the border as the tool moves
  static Eigen::Vector3d acrossBorder(const Layer& layer, const Field& field,
    const Eigen::Vector3d& from, const Eigen::Vector3d& to) noexcept
  {
    if (layer.isShaft())
    {
      const double squares = from.z() * from.z() + from.z() * to.z() + to.z() * to.z();
      const double mean = layer.upward(field, 0.0) + 0.5 * field.constant * (from.z() + to.z()) +
        field.linear * squares / 6.0;
      return mean * Eigen::Vector3d::UnitZ().cross(to - from);
    }
    const double a = from.z() - layer.pole;
    const double b = to.z() - layer.pole;
    const double twist = field.twist != 0.0 ? 0.5 * field.twist / (a * a * b * b) : 0.0;
    return (layer.atPole(field) + (0.125 * field.linear + twist) * (a + b)) *
      (from - layer.pole * Eigen::Vector3d::UnitZ()).cross(to - from);
  }

  const ToolSolid* solid_;
  Layer beyond_;
  bool closed_;
  Overlap sum_;
};

} // namespace

ToolFrame::ToolFrame(const ToolPose& pose) noexcept
  : apex(pose.apex)
{
  axes.col(2) = -pose.axis;
  axes.col(0) = pose.axis.unitOrthogonal();
  axes.col(1) = axes.col(2).cross(axes.col(0));
}

Overlap overlapOf(const Surface& surface, const ToolSolid& solid, const ToolFrame& frame) noexcept
{
  const BoxTree& tree = surface.tree();
  const Eigen::Vector3d up = frame.axes.col(2);
  // whether the ball about a box comes near the tool
  const auto near = [&](const BoxTree::Node& box)
  {
    Eigen::Vector3d middle;
    double size = 0.0;
    for (Eigen::Index k = 0; k < 3; ++k)
    {
      const auto low = static_cast<double>(box.low[static_cast<std::size_t>(k)]);
      const auto high = static_cast<double>(box.high[static_cast<std::size_t>(k)]);
      middle[k] = 0.5 * (low + high) - frame.apex[k];
      size += 0.25 * (high - low) * (high - low);
    }
    const double along = std::max(0.0, middle.dot(up));
    size = std::sqrt(size);
    const double reach = solid.outerRadiusBelow(along + size) + size;
    return (middle - along * up).squaredNorm() < reach * reach;
  };
  Sums sums(solid, surface.closed());
  const auto add = [&](int i)
  {
    const Facet& facet = tree.facets()[at(i)];
    const std::array<Eigen::Vector3d, 3> corners = { frame.place(facet.corners[0]),
      frame.place(facet.corners[1]), frame.place(facet.corners[2]) };
    std::array<bool, 3> isBorder{};
    for (int k = 0; !surface.closed() && k < 3; ++k)
    {
      isBorder[at(k)] = surface.across(tree.triangle(i), k) < 0;
    }
    sums.add(corners, frame.axes.transpose() * facet.normal, isBorder);
  };
  tree.search(near, add);
  return sums.sum();
}

} // namespace palp
