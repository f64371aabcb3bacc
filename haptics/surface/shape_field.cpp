#include "haptics/surface/shape_field.h"

#include "haptics/surface/facet_part.h"
#include "haptics/surface/ray.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace palp
{
namespace
{

constexpr double kFinest = 1.0 / 50.0; // of the diagonal: least radius of an average
constexpr double kEdges = 2.0;         // edges of the mesh there; fewer come through one by one
constexpr double kWidest = 1.0 / 6.0;  // of the diagonal: the least radius, however coarse the mesh
constexpr double kFine = 0.5;          // cells in the least radius, the reciprocal
constexpr double kCoarse = 0.25;       // the same where edges of the mesh set that radius
constexpr double kMaxPieces = 100000.0; // of the triangles, beyond one each
constexpr double kTurn = 3.0;           // cells to each side of an edge within which it turns
constexpr double kSharp = 0.8;          // [rad] that a sharp one turns there: 55 degrees
constexpr float kOwnTurn = 0.25F; // of the most in a leaf, or of the mean: not of one beside it
constexpr float kOneSide = 0.8F;  // length of the mean normal of one side of the surface

// diagonal of the box about all triangles
double diagonal(const BoxTree::Node& box)
{
  double sum = 0.0;
  for (std::size_t k = 0; k < 3; ++k)
  {
    const double side = static_cast<double>(box.high[k]) - static_cast<double>(box.low[k]);
    sum += side * side;
  }
  return std::sqrt(sum);
}

double longestEdge(const std::array<Eigen::Vector3d, 3>& p)
{
  return std::sqrt(std::max(
    { (p[0] - p[1]).squaredNorm(), (p[1] - p[2]).squaredNorm(), (p[2] - p[0]).squaredNorm() }));
}

// so large that the triangles are not cut into too many pieces
double leastCell(const BoxTree& tree)
{
  double area = 0.0;
  double length = 0.0;
  for (const Facet& facet : tree.facets())
  {
    const auto& [a, b, c] = facet.corners;
    area += 0.5 * (b - a).cross(c - a).norm();
    length += longestEdge(facet.corners);
  }
  const double pieces = kMaxPieces + 4.0 * static_cast<double>(tree.facets().size());
  return std::max(std::sqrt(4.0 * area / kMaxPieces), 2.0 * length / pieces);
}

} // namespace

ShapeField::ShapeField(const BoxTree& tree, const LinkedTriangles& mesh, double edgeLength)
{
  const BoxTree::Node& box = tree.nodes()[0];
  const double size = diagonal(box);
  const double scale = std::min(kEdges * edgeLength, kWidest * size);
  cell_ = std::max({ kFine * kFinest * size, kCoarse * scale, leastCell(tree) });
  finest_ = std::max(scale, cell_ / kFine);
  for (Eigen::Index k = 0; k < 3; ++k)
  {
    const auto i = static_cast<std::size_t>(k);
    origin_[k] = 0.5 * (static_cast<double>(box.low[i]) + static_cast<double>(box.high[i]));
  }

  std::vector<Piece> pieces = cutUp(tree, mesh);
  Leaves leaves;
  build(pieces, static_cast<float>(cell_), leaves);
  measureLeaves(tree, hollowRadii(mesh), leaves);
  addUp();
}

// into cells, but for triangles that are small in the least average: those stay whole
std::vector<ShapeField::Piece> ShapeField::cutUp(
  const BoxTree& tree, const LinkedTriangles& mesh) const
{
  const auto bends = evenBends(tree, mesh, finest_);
  std::vector<Piece> pieces;
  pieces.reserve(tree.facets().size());
  for (std::size_t i = 0; i < tree.facets().size(); ++i)
  {
    const Facet& facet = tree.facets()[i];
    const auto turns = bendsOf(mesh, facet, tree.triangle(static_cast<int>(i)));
    cut(FacetPart{ facet.corners, { 0, 1, 2 } }, bends[i] ? finest_ : cell_,
      [&](const FacetPart& part)
      {
        const auto& p = part.corners;
        Piece piece{ ((p[0] + p[1] + p[2]) / 3.0 - origin_).cast<float>(), {} };
        piece.sums.area = (0.5 * (p[1] - p[0]).cross(p[2] - p[0])).cast<float>();
        for (std::size_t k = 0; k < 3; ++k)
        {
          if (part.sides[k] >= 0)
          {
            const double length = (p[(k + 1) % 3] - p[k]).norm();
            const Eigen::Matrix3d& turn = turns[static_cast<std::size_t>(part.sides[k])];
            piece.sums.bend += (length * turn).cast<float>();
            piece.sides.push_back(
              { { (p[k] - origin_).cast<float>(), (p[(k + 1) % 3] - origin_).cast<float>() },
                static_cast<float>(turn.trace()) });
          }
        }
        piece.sums.bend = bends[i].value_or(piece.sums.bend);
        pieces.push_back(piece);
      });
  }
  return pieces;
}

// splits at the median of the widest of place and normal until both fit a cell
void ShapeField::build(std::span<Piece> pieces, float cell, Leaves& leaves)
{
  using Coordinates = Eigen::Array<float, 6, 1>;
  const auto coordinatesOf = [cell](const Piece& piece)
  {
    Coordinates coordinates;
    coordinates << piece.center.array(), cell * piece.sums.area.normalized().array();
    return coordinates;
  };
  Coordinates low = Coordinates::Constant(std::numeric_limits<float>::infinity());
  Coordinates high = -low;
  Node node;
  Sums sums;
  float area = 0.0F;
  for (const Piece& piece : pieces)
  {
    const Coordinates coordinates = coordinatesOf(piece);
    low = low.min(coordinates);
    high = high.max(coordinates);
    const float weight = piece.sums.area.norm();
    area += weight;
    node.center += weight * piece.center;
    sums.area += piece.sums.area;
    sums.bend += piece.sums.bend;
  }
  node.center = area > 0.0F ? Eigen::Vector3f(node.center / area) : pieces.front().center;
  for (const Piece& piece : pieces)
  {
    node.radius = std::max(node.radius, (piece.center - node.center).norm());
  }
  int widest = 0;
  const bool leaf = (high - low).maxCoeff(&widest) <= cell || pieces.size() < 2;
  const bool oneSide = sums.area.norm() > kOneSide * area;
  node.grain = leaf ? 0.0F : oneSide ? node.radius : std::numeric_limits<float>::infinity();
  const std::size_t self = nodes_.size();
  nodes_.push_back(node);
  sums_.push_back(sums);
  leaves.push_back(leaf ? pieces : std::span<Piece>());
  if (leaf)
  {
    return;
  }
  const auto along = [&](const Piece& piece) // coordinatesOf()[widest]
  { return widest < 3 ? piece.center[widest] : cell * piece.sums.area.normalized()[widest - 3]; };
  const std::size_t half = pieces.size() / 2;
  std::nth_element(pieces.begin(), pieces.begin() + static_cast<std::ptrdiff_t>(half), pieces.end(),
    [&](const Piece& a, const Piece& b) { return along(a) < along(b); });
  build(pieces.first(half), cell, leaves);
  nodes_[self].right = static_cast<std::int32_t>(nodes_.size());
  build(pieces.subspan(half), cell, leaves);
}

// visit(index, weight) for the parts in a ball; the weight falls smoothly to its rim
template <typename Visit>
void ShapeField::search(
  const Eigen::Vector3d& center, double radius, double grain, Visit visit) const noexcept
{
  const Eigen::Vector3f from = (center - origin_).cast<float>();
  const auto reach = static_cast<float>(radius);
  const auto coarse = static_cast<float>(grain);
  const float scale = 1.0F / (reach * reach);
  std::array<std::int32_t, BoxTree::kDepth> stack;
  std::size_t waiting = 0;
  std::int32_t current = nodes_.empty() ? -1 : 0;
  while (current >= 0)
  {
    const auto i = static_cast<std::size_t>(current);
    const Node& node = nodes_[i];
    const float squared = (node.center - from).squaredNorm();
    const float farthest = reach + node.radius;
    const bool near = squared < farthest * farthest;
    if (near && node.grain > coarse)
    {
      stack[waiting++] = node.right;
      ++current;
      continue;
    }
    if (const float part = 1.0F - scale * squared; near && part > 0.0F)
    {
      visit(i, part * part);
    }
    current = waiting > 0 ? stack[--waiting] : -1;
  }
}

LocalShape ShapeField::operator()(const Eigen::Vector3d& center, double radius,
  const Eigen::Vector3d& normal, double grain) const noexcept
{
  const Eigen::Vector3f toward = normal.cast<float>();
  Sums sum;
  float area = 0.0F;
  search(center, radius, grain,
    [&](std::size_t i, float weight)
    {
      const Sums& part = sums_[i];
      const float across = toward.dot(part.area);
      if (across > 0.0F)
      {
        const float facing = weight * across / part.area.norm();
        area += weight * across;
        sum.bend += facing * part.bend;
        sum.slenderness += facing * part.slenderness;
        sum.hollow += facing * part.hollow;
      }
    });
  if (!(area > 0.0F))
  {
    return {};
  }
  const Eigen::Vector3d u = normal.unitOrthogonal();
  const Eigen::Vector3d v = normal.cross(u);
  const Eigen::Matrix3d tensor = (sum.bend / area).cast<double>();
  const double uu = u.dot(tensor * u);
  const double vv = v.dot(tensor * v);
  const double root = static_cast<double>(area) / static_cast<double>(sum.slenderness);
  LocalShape shape;
  shape.meanCurvature = 0.5 * (uu + vv);
  shape.curvatureSpread = std::hypot(0.5 * (uu - vv), u.dot(tensor * v));
  shape.thickness = root * root;
  shape.hollow = static_cast<double>(sum.hollow / area);
  return shape;
}

// thickness and sharpness of the leaves, from what is about them
void ShapeField::measureLeaves(
  const BoxTree& tree, std::span<const float> hollows, const Leaves& leaves)
{
  const double around = kTurn * cell_;
  std::vector<SharpEdges::Segment> sharp;
  for (std::size_t i = 0; i < nodes_.size(); ++i)
  {
    Sums& leaf = sums_[i];
    if (nodes_[i].right != 0 || leaf.area.isZero(0.0F))
    {
      continue;
    }
    const Eigen::Vector3d coordinates = origin_ + nodes_[i].center.cast<double>();
    Sums sum;
    float area = 0.0F;
    search(coordinates, around, 0.0,
      [&](std::size_t k, float weight)
      {
        const Sums& part = sums_[k];
        const float across = leaf.area.dot(part.area);
        if (across > 0.0F)
        {
          const float facing = weight * across / part.area.norm();
          area += weight * across;
          sum.area += facing * part.area;
          sum.bend += facing * part.bend;
        }
      });
    const Eigen::Vector3d inward = -sum.area.normalized().cast<double>();
    const Below below = lookBelow(tree, hollows, coordinates, inward);
    leaf.slenderness = leaf.area.norm() / static_cast<float>(std::sqrt(below.thickness));
    leaf.hollow = below.isHollow ? leaf.area.norm() : 0.0F;
    const float curvature = sum.bend.trace() / area;
    const bool bends = turningOf(leaves[i]) > kOwnTurn * curvature * leaf.area.norm();
    if (bends && static_cast<double>(curvature) * around > kSharp)
    {
      addTurning(leaves[i], sharp);
    }
  }
  edges_ = SharpEdges(std::move(sharp));
}

// of the sides of a leaf, times their length [m]
float ShapeField::turningOf(std::span<const Piece> leaf)
{
  float sum = 0.0F;
  for (const Piece& piece : leaf)
  {
    for (const Side& side : piece.sides)
    {
      sum += side.turn * (side.ends[1] - side.ends[0]).norm();
    }
  }
  return sum;
}

// the sides at which a leaf turns
void ShapeField::addTurning(std::span<const Piece> leaf, std::vector<SharpEdges::Segment>& sharp)
{
  float most = 0.0F;
  for (const Piece& piece : leaf)
  {
    for (const Side& side : piece.sides)
    {
      most = std::max(most, side.turn);
    }
  }
  for (const Piece& piece : leaf)
  {
    for (const Side& side : piece.sides)
    {
      if (side.turn > kOwnTurn * most)
      {
        sharp.push_back(side.ends);
      }
    }
  }
}

// what the leaves measured, for every node
void ShapeField::addUp()
{
  for (std::size_t i = nodes_.size(); i-- > 0;)
  {
    if (nodes_[i].right != 0)
    {
      const Sums& left = sums_[i + 1];
      const Sums& right = sums_[static_cast<std::size_t>(nodes_[i].right)];
      sums_[i].slenderness = left.slenderness + right.slenderness;
      sums_[i].hollow = left.hollow + right.hollow;
    }
  }
}

} // namespace palp
