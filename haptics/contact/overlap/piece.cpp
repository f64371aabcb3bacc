#include "haptics/contact/overlap/piece.h"

namespace palp
{
namespace
{

bool isIn(const ToolSolid::Layer& layer, const Piece& piece) noexcept
{
  for (std::size_t k = 0; k < piece.size(); ++k)
  {
    const Eigen::Vector3d& x = piece[k];
    const double radius = layer.radiusAt(x.z());
    if (!(x.z() >= layer.low && x.z() <= layer.high &&
          x.head<2>().squaredNorm() <= radius * radius))
    {
      return false;
    }
  }
  return true;
}

} // namespace

void clipTo(const ToolSolid::Layer& layer, Piece& piece) noexcept
{
  if (isIn(layer, piece))
  {
    return;
  }
  piece.clip([&](const auto& x) { return layer.low - x.z(); }, codeOf(Bound::Bottom));
  piece.clip([&](const auto& x) { return x.z() - layer.high; }, codeOf(Bound::Top));
  using Sides = ToolSolid::Sides;
  Sides most = Sides::Constant(-1.0); // over each side, of the corners
  Sides least = Sides::Constant(1.0);
  for (std::size_t k = 0; k < piece.size(); ++k)
  {
    const Eigen::Vector3d& x = piece[k];
    const Sides over =
      ToolSolid::outwardX() * x.x() + ToolSolid::outwardY() * x.y() - layer.radiusAt(x.z());
    most = most.max(over);
    least = least.min(over);
  }
  if (least.maxCoeff() >= 0.0)
  {
    piece.clear();
    return;
  }
  for (std::size_t k = 0; k < ToolSolid::kSides; ++k)
  {
    if (most[static_cast<Eigen::Index>(k)] > 0.0)
    {
      const Eigen::Vector2d to = ToolSolid::outward(k);
      const auto over = [&](const auto& x)
      { return to.dot(x.template head<2>()) - layer.radiusAt(x.z()); };
      piece.clip(over, codeOf(Bound::Side, k));
    }
  }
}

} // namespace palp
