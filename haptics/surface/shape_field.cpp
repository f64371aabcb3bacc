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
constexpr float kSharp = 0.8F;          // [rad] that a sharp one turns there: 55 degrees
constexpr float kOwnTurn = 0.25F; // of the most in a leaf, or of the mean: not of one beside it
constexpr float kOneSide = 0.8F;  // length of the mean normal of one side of the surface
constexpr float kRidge = 0.2F;    // [rad] half of what the surface turns at a ridge, or more
constexpr double kAtRidge = 0.3;  // cells there, so that it is known where it is
constexpr float kBentNode = 0.5F; // [rad] it turns by, from which on it is not all in one place

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

// Leaves out sides that turn little of what is around does: facets of a cylinder beside its rim.
// One that is sharp is no crease any more.
// @param bend  of what is around, over its area [1/m]
template <typename Side>
void keepSharp(std::vector<Side>& sides, const Eigen::Matrix3f& bend, const Eigen::Vector3f& normal,
  float around)
{
  const auto isSharp = [&](const Side& side)
  {
    const Eigen::Vector3f along = (side.ends[1] - side.ends[0]).normalized();
    const Eigen::Vector3f across = along.cross(normal).normalized();
    const float own = std::max(1e-9F, across.dot(bend * across));
    const float other = std::max(0.0F, along.dot(bend * along));
    return 2.0F * side.turn >= kSharp || own * bend.trace() * around >= kSharp * (own + other);
  };
  std::erase_if(sides, [&](const Side& side) { return !side.isCrease && !isSharp(side); });
  for (Side& side : sides)
  {
    side.isCrease = side.isCrease && !isSharp(side);
  }
}

} // namespace

ShapeField::ShapeField(const BoxTree& tree, const LinkedTriangles& mesh, const Creases& creases)
{
  const auto corner = [](const std::array<float, 3>& of)
  { return Eigen::Vector3f(of.data()).cast<double>().eval(); };
  const Eigen::Vector3d low = corner(tree.nodes()[0].low);
  const Eigen::Vector3d high = corner(tree.nodes()[0].high);
  const double size = (high - low).norm();
  const double scale = std::min(kEdges * creases.facetLength, kWidest * size);
  cell_ = std::max({ kFine * kFinest * size, kCoarse * scale, leastCell(tree) });
  finest_ = std::max(scale, cell_ / kFine);
  origin_ = 0.5 * (low + high);
  Pieces pieces;
  std::vector<Entry> entries;
  cutUp(tree, mesh, creases, pieces, entries);
  Leaves leaves;
  build(entries, pieces, leaves);
  measureLeaves(tree, hollowRadii(mesh), pieces, leaves);
  addUp();
}

// into cells, but for triangles that are small in the least average: those stay whole
void ShapeField::cutUp(const BoxTree& tree, const LinkedTriangles& mesh, const Creases& creases,
  Pieces& pieces, std::vector<Entry>& entries) const
{
  const auto bends = evenBends(tree, mesh, creases, finest_);
  pieces.all.reserve(tree.facets().size());
  entries.reserve(tree.facets().size());
  pieces.sides.reserve(3 * tree.facets().size());
  for (std::size_t i = 0; i < tree.facets().size(); ++i)
  {
    const Facet& facet = tree.facets()[i];
    const auto& turns = bends[i].turns;
    const auto& even = bends[i].even;
    const int triangle = tree.triangle(static_cast<int>(i));
    const auto& isCrease = creases.sides[at(triangle)];
    const auto bend = even ? std::array<Eigen::Matrix3d, 3>() : bendsOf(mesh, triangle);
    const auto add = [&](const FacetPart& part)
    {
      const auto& p = part.corners;
      Piece piece;
      piece.sides[0] = static_cast<int>(pieces.sides.size());
      piece.sums.area = (0.5 * (p[1] - p[0]).cross(p[2] - p[0])).cast<float>();
      for (std::size_t k = 0; k < 3; ++k)
      {
        if (part.sides[k] >= 0)
        {
          const auto side = static_cast<std::size_t>(part.sides[k]);
          const Eigen::Vector3d& next = p[(k + 1) % 3];
          piece.sums.bend += even ? Eigen::Matrix3f::Zero().eval()
                                  : ((next - p[k]).norm() * bend[side]).cast<float>().eval();
          pieces.sides.push_back(
            { { (p[k] - origin_).cast<float>(), (next - origin_).cast<float>() }, turns[side],
              isCrease[side] });
        }
      }
      piece.sides[1] = static_cast<int>(pieces.sides.size());
      piece.sums.bend = even.value_or(piece.sums.bend);
      const Eigen::Vector3f center = ((p[0] + p[1] + p[2]) / 3.0 - origin_).cast<float>();
      Entry entry{ .coordinates = {},
        .area = piece.sums.area.norm(),
        .piece = static_cast<int>(pieces.all.size()) };
      entry.coordinates.head<3>() = center.array();
      entry.coordinates.tail<3>() =
        static_cast<float>(cell_) * piece.sums.area.normalized().array();
      entries.push_back(entry);
      pieces.all.push_back(piece);
    };
    cut(FacetPart{ facet.corners, { 0, 1, 2 } }, even ? finest_ : cell_,
      [&](const FacetPart& part)
      {
        const bool isRidge = !even &&
          std::ranges::any_of(part.sides,
            [&](int side)
            { return side >= 0 && (isCrease[at(side)] || std::abs(turns[at(side)]) > kRidge); });
        isRidge ? cut(part, kAtRidge * cell_, add) : add(part);
      });
  }
}

// Splits at the median of the widest of place and normal until both fit a cell.
// @return  sum of the centers times their areas, and of the areas
Eigen::Vector4f ShapeField::build(std::span<Entry> entries, const Pieces& pieces, Leaves& leaves)
{
  const auto cell = static_cast<float>(cell_);
  using Coordinates = Eigen::Array<float, 6, 1>;
  Coordinates low = Coordinates::Constant(std::numeric_limits<float>::infinity());
  Coordinates high = -low;
  for (const Entry& entry : entries)
  {
    low = low.min(entry.coordinates);
    high = high.max(entry.coordinates);
  }
  int widest = 0;
  const bool isRidge = std::ranges::any_of(entries,
    [&](const Entry& entry)
    { return pieces.all[at(entry.piece)].sums.bend.norm() * cell > kBentNode * entry.area; });
  const float least = isRidge ? static_cast<float>(kAtRidge) * cell : cell;
  const bool leaf = (high - low).maxCoeff(&widest) <= least || entries.size() < 2;
  const std::size_t self = nodes_.size();
  nodes_.emplace_back();
  sums_.emplace_back();
  leaves.push_back(leaf ? entries : std::span<Entry>());
  ShapePart sums;
  Eigen::Vector4f weight = Eigen::Vector4f::Zero();
  if (leaf)
  {
    for (const auto& [coordinates, area, piece] : entries)
    {
      weight += area * coordinates.head<3>().matrix().homogeneous();
      sums.area += pieces.all[at(piece)].sums.area;
      sums.bend += pieces.all[at(piece)].sums.bend;
    }
  }
  else
  {
    const std::size_t half = entries.size() / 2;
    std::nth_element(entries.begin(), entries.begin() + static_cast<std::ptrdiff_t>(half),
      entries.end(),
      [widest](const Entry& a, const Entry& b)
      { return a.coordinates[widest] < b.coordinates[widest]; });
    weight = build(entries.first(half), pieces, leaves);
    const std::size_t right = nodes_.size();
    nodes_[self].right = static_cast<std::int32_t>(right);
    weight += build(entries.subspan(half), pieces, leaves);
    sums.area = sums_[self + 1].area + sums_[right].area;
    sums.bend = sums_[self + 1].bend + sums_[right].bend;
  }
  Node& node = nodes_[self];
  node.center = weight[3] > 0.0F ? Eigen::Vector3f(weight.head<3>() / weight[3])
                                 : entries.front().coordinates.head<3>().matrix();
  float squaredRadius = 0.0F;
  for (const Entry& entry : entries)
  {
    squaredRadius =
      std::max(squaredRadius, (entry.coordinates.head<3>().matrix() - node.center).squaredNorm());
  }
  node.radius = std::sqrt(squaredRadius);
  const bool isEven = sums.bend.norm() * node.radius < kBentNode * weight[3];
  const bool oneSide = isEven && sums.area.norm() > kOneSide * weight[3];
  node.grain = leaf ? 0.0F : oneSide ? node.radius : std::numeric_limits<float>::infinity();
  sums_[self] = sums;
  return weight;
}

// visit(index, root, offset) for the parts in a ball; the weight root^2 falls smoothly to its rim
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
      visit(i, part, Eigen::Vector3f(node.center - from));
    }
    current = waiting > 0 ? stack[--waiting] : -1;
  }
}

LocalShape ShapeField::operator()(const Eigen::Vector3d& center, double radius,
  const Eigen::Vector3d& normal, double grain, CurvatureOf of) const noexcept
{
  ShapeAverage average(normal, radius);
  search(center, radius, grain,
    [&](std::size_t i, float root, const Eigen::Vector3f& offset)
    { average.add(of == CurvatureOf::All ? sums_[i] : sums_[i].ofFaces(), root, offset); });
  return average.shape();
}

// thickness and sharpness of the leaves, from what is about them
void ShapeField::measureLeaves(
  const BoxTree& tree, std::span<const float> hollows, const Pieces& pieces, const Leaves& leaves)
{
  const auto around = static_cast<float>(kTurn * cell_);
  std::vector<SharpEdges::Segment> sharp, creases;
  for (std::size_t i = 0; i < nodes_.size(); ++i)
  {
    ShapePart& leaf = sums_[i];
    if (nodes_[i].right != 0 || leaf.area.isZero(0.0F))
    {
      continue;
    }
    const Eigen::Vector3d coordinates = origin_ + nodes_[i].center.cast<double>();
    ShapePart sum;
    float area = 0.0F;
    search(coordinates, around, 0.0,
      [&](std::size_t k, float root, const Eigen::Vector3f& /*offset*/)
      {
        const float weight = root * root;
        const ShapePart& part = sums_[k];
        const float across = leaf.area.dot(part.area);
        if (across > 0.0F)
        {
          const float facing = weight * across / part.area.norm();
          area += weight * across;
          sum.area += facing * part.area;
          sum.bend += facing * part.bend;
        }
      });
    const Below below =
      lookBelow(tree, hollows, coordinates, -sum.area.normalized().cast<double>());
    leaf.slenderness = leaf.area.norm() / static_cast<float>(std::sqrt(below.thickness));
    leaf.hollow = below.isHollow ? leaf.area.norm() : 0.0F;
    const float curvature = sum.bend.trace() / area;
    std::vector<Side> sides;
    for (const Entry& entry : leaves[i])
    {
      const auto [first, end] = pieces.all[at(entry.piece)].sides;
      sides.insert(sides.end(), pieces.sides.begin() + first, pieces.sides.begin() + end);
    }
    if (curvature * around > kSharp || std::ranges::any_of(sides, &Side::isCrease))
    {
      keepSharp(sides, sum.bend / area, sum.area, around);
      leaf.isSharp = addTurning(sides, kOwnTurn * curvature * leaf.area.norm(), sharp, creases);
    }
  }
  edges_ = SharpEdges(std::move(sharp));
  creases_ = SharpEdges(std::move(creases));
}

// The sides at which a leaf turns, where it does so.
// @param least  that sides of no crease turn together, times their length [m]
bool ShapeField::addTurning(std::span<const Side> sides, float least,
  std::vector<SharpEdges::Segment>& sharp, std::vector<SharpEdges::Segment>& creases)
{
  float sum = 0.0F;
  float most = 0.0F;
  for (const Side& side : sides)
  {
    sum += side.turn * (side.ends[1] - side.ends[0]).norm();
    most = std::max(most, side.turn);
  }
  for (const Side& side : sides)
  {
    const bool isTurning = sum > least && side.turn > kOwnTurn * most;
    side.isCrease ? creases.push_back(side.ends) : isTurning ? sharp.push_back(side.ends) : void();
  }
  return sum > least || std::ranges::any_of(sides, &Side::isCrease);
}

// what the leaves measured, for every node
void ShapeField::addUp()
{
  for (std::size_t i = nodes_.size(); i-- > 0;)
  {
    if (nodes_[i].right != 0)
    {
      const ShapePart& left = sums_[i + 1];
      const ShapePart& right = sums_[static_cast<std::size_t>(nodes_[i].right)];
      sums_[i].slenderness = left.slenderness + right.slenderness;
      sums_[i].hollow = left.hollow + right.hollow;
      sums_[i].isSharp = left.isSharp || right.isSharp;
    }
  }
}

} // namespace palp
