#include "pipeline/formats/regions/contour_pieces.h"

#include "haptics/files/input_text.h"
#include "haptics/surface/winding.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace palp
{
namespace
{

constexpr double kHalfAround = 0.5; // of all directions

// what hangs together
struct Piece
{
  int point = 0;       // on it
  double volume = 0.0; // positive where it faces as the largest does; 0 in a filled hollow [unit^3]
  bool isKept = false;
};

std::vector<Piece> piecesFrom(std::span<const Triangle> triangles, std::span<const int> numbers,
  std::span<const PieceSize> sizes)
{
  std::vector<Piece> pieces(sizes.size());
  std::ranges::transform(
    sizes, pieces.begin(), [](const PieceSize& size) { return Piece{ .volume = size.volume }; });
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    pieces[at(numbers[i])].point = triangles[i][0];
  }
  const auto size = [](const Piece& piece) { return std::abs(piece.volume); };
  const double side = std::copysign(1.0, std::ranges::max(pieces, {}, size).volume);
  for (Piece& piece : pieces)
  {
    piece.volume *= side;
  }
  return pieces;
}

// What lies in a hollow that is filled is a part of the body that fills it, and no piece of its
// own.
void dropFilled(std::span<const Eigen::Vector3d> points, std::span<const Triangle> triangles,
  std::span<const int> numbers, double leastHollow, std::vector<Piece>& pieces)
{
  std::vector<Triangle> walls;
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    const double volume = pieces[at(numbers[i])].volume;
    volume < 0.0 && -volume < leastHollow ? walls.push_back(triangles[i]) : void();
  }
  if (walls.empty())
  {
    return;
  }
  const Winding winding(BoxTree(points, walls));
  for (Piece& piece : pieces)
  {
    const bool isSmall = piece.volume > 0.0 && piece.volume < leastHollow;
    piece.volume *= isSmall && std::abs(winding(points[at(piece.point)])) > kHalfAround ? 0.0 : 1.0;
  }
}

// keeps the largest that are no hollows, and besides the first no crumbs; how many
std::size_t keepLargest(std::vector<Piece>& pieces, std::size_t components, double least)
{
  std::vector<std::size_t> order(pieces.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, std::greater(), [&](std::size_t i) { return pieces[i].volume; });
  std::size_t kept = 0;
  for (const std::size_t i : order)
  {
    pieces[i].isKept =
      pieces[i].volume > 0.0 && kept < components && (kept == 0 || pieces[i].volume >= least);
    kept += pieces[i].isKept ? 1 : 0;
  }
  return kept;
}

// Whether each hollow lies in a body that is kept: in none that is left out. None of those is
// around one that is kept, which is larger.
std::vector<bool> hollowsWithin(std::span<const Eigen::Vector3d> points,
  std::span<const Triangle> triangles, std::span<const int> numbers,
  const std::vector<Piece>& pieces)
{
  std::vector<Triangle> walls;
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    const Piece& piece = pieces[at(numbers[i])];
    piece.volume > 0.0 && !piece.isKept ? walls.push_back(triangles[i]) : void();
  }
  const Winding winding(BoxTree(points, walls));
  std::vector<bool> within(pieces.size());
  for (std::size_t i = 0; i < pieces.size(); ++i)
  {
    within[i] =
      pieces[i].volume < 0.0 && std::abs(winding(points[at(pieces[i].point)])) < kHalfAround;
  }
  return within;
}

std::string noteOf(std::size_t kept, std::size_t all, std::size_t hollows, std::size_t filled)
{
  const std::string which = kept == 1 ? "the largest" : "the " + std::to_string(kept) + " largest";
  const std::string taken = kept == all
    ? counted(all, "piece")
    : which + " of its " + std::to_string(all) + " pieces " + (kept == 1 ? "is" : "are") + " taken";
  return taken + (hollows > 0 ? ", with " + counted(hollows, "hollow") : "") +
    (filled > 0 ? ", and " + counted(filled, "hollow") + " of less than 100 voxels filled" : "");
}

// of all bodies, or of those that are left out
double volumeOf(const std::vector<Piece>& pieces, bool isLeftOut)
{
  double sum = 0.0;
  for (const Piece& piece : pieces)
  {
    sum += isLeftOut && piece.isKept ? 0.0 : std::max(0.0, piece.volume);
  }
  return sum;
}

} // namespace

ContourPieces contourPieces(std::span<const Eigen::Vector3d> points,
  std::span<const Triangle> triangles, std::span<const int> numbers,
  std::span<const PieceSize> sizes, std::size_t components, double voxel)
{
  const double leastHollow = kLeastHollow * voxel;
  ContourPieces result{ .isKept = std::vector<bool>(triangles.size(), true), .note = {} };
  std::vector<Piece> pieces = piecesFrom(triangles, numbers, sizes);
  if (pieces.size() < 2)
  {
    return result;
  }
  dropFilled(points, triangles, numbers, leastHollow, pieces);
  const std::size_t bodies = keepLargest(pieces, components, leastPiece(voxel));
  std::size_t hollows = 0;
  std::size_t filled = 0;
  double filledVolume = 0.0;
  if (std::ranges::any_of(pieces, [](const Piece& piece) { return piece.volume < 0.0; }))
  {
    const std::vector<bool> within = hollowsWithin(points, triangles, numbers, pieces);
    for (std::size_t i = 0; i < pieces.size(); ++i)
    {
      const bool isLarge = -pieces[i].volume >= leastHollow;
      hollows += within[i] && isLarge ? 1 : 0;
      filled += within[i] && !isLarge ? 1 : 0;
      filledVolume -= within[i] && !isLarge ? pieces[i].volume : 0.0;
      pieces[i].isKept = pieces[i].isKept || (within[i] && isLarge);
    }
  }
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    result.isKept[i] = pieces[at(numbers[i])].isKept;
  }
  result.areAll = bodies + hollows == pieces.size();
  const auto isBody = [](const Piece& piece) { return piece.volume > 0.0; };
  result.note = noteOf(
    bodies, static_cast<std::size_t>(std::ranges::count_if(pieces, isBody)), hollows, filled);
  constexpr double kMuch = 0.01;
  double all = volumeOf(pieces, false); // of voxels: less the hollows that stay
  for (const Piece& piece : pieces)
  {
    all += piece.isKept ? std::min(0.0, piece.volume) : 0.0;
  }
  const double out = volumeOf(pieces, true);
  const auto partOf = [all](double volume)
  { return std::to_string(std::lround(100.0 * volume / all)) + " % of its volume"; };
  result.note += filledVolume > kMuch * all ? ", " + partOf(filledVolume) : "";
  result.note += out > kMuch * all ? "; the others have " + partOf(out) : "";
  result.note.insert(0, std::max(filledVolume, out) > kMuch * all ? "warning: " : "");
  return result;
}

} // namespace palp
