#include "haptics/contact/overlap/section.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace palp
{
namespace
{

constexpr double kCoplanar = 1e-9; // [-] sine between two planes that are one

// One face of the tool after the other, with what of it is below the plane.
class Cut
{
public:
  Cut(const Eigen::Vector3d& normal, double height) noexcept
    : normal_(normal)
    , height_(height)
    , foot_(height * normal)
  {
  }

  // @param corners  of the face, counter-clockwise from outside
  template <std::size_t N>
  void add(const std::array<Eigen::Vector3d, N>& corners, const Eigen::Vector3d& outward) noexcept
  {
    Eigen::Vector3d first = Eigen::Vector3d::Zero(); // of the part that is below
    Eigen::Vector3d last = first;
    Eigen::Vector3d leaving = first;
    Eigen::Vector3d entering = first;
    double area = 0.0;
    bool isAny = false;
    bool isCut = false;
    const auto take = [&](const Eigen::Vector3d& place)
    {
      if (!isAny)
      {
        first = place;
      }
      else
      {
        area += 0.5 * outward.dot((last - first).cross(place - first));
      }
      last = place;
      isAny = true;
    };
    double over = normal_.dot(corners[0]) - height_;
    for (std::size_t k = 0; k < N; ++k)
    {
      const Eigen::Vector3d& here = corners[k];
      const Eigen::Vector3d& next = corners[(k + 1) % N];
      const double overNext = normal_.dot(next) - height_;
      if (over <= 0.0)
      {
        take(here);
      }
      if ((over <= 0.0) != (overNext <= 0.0))
      {
        const Eigen::Vector3d place = here + over / (over - overNext) * (next - here);
        take(place);
        (over <= 0.0 ? leaving : entering) = place;
        isCut = true;
      }
      over = overNext;
    }
    if (!isAny)
    {
      return;
    }
    sum_.volume += area * outward.dot(first - foot_) / 3.0;
    if (isCut)
    {
      border(entering - foot_, leaving - foot_, outward);
    }
  }

  [[nodiscard]] const Section& sum() const noexcept
  {
    return sum_;
  }

private:
  // of the section, whose sense is the opposite of that of the face
  void border(
    const Eigen::Vector3d& from, const Eigen::Vector3d& to, const Eigen::Vector3d& outward) noexcept
  {
    const double area = 0.5 * normal_.dot(from.cross(to));
    sum_.area += area;
    sum_.moment += area / 3.0 * (from + to);
    const double sine = std::max(kCoplanar, outward.cross(normal_).norm());
    const double growth = -(to - from).norm() * outward.dot(normal_) / sine;
    sum_.growth += growth;
    sum_.growing += 0.5 * growth * (from + to);
  }

  Eigen::Vector3d normal_;
  double height_;
  Eigen::Vector3d foot_;
  Section sum_;
};

// The layer of which a plane cuts all corners' edges; null where it cuts a ring between two.
const ToolSolid::Layer* wholeLayer(
  const ToolSolid& solid, const Eigen::Vector3d& normal, double height) noexcept
{
  const double lean = normal.head<2>().norm() * ToolSolid::outerPart();
  for (const ToolSolid::Layer& layer : solid.layers())
  {
    const double below = layer.low * normal.z() + lean * layer.radius;
    const double above = layer.high * normal.z() - lean * layer.radiusAt(layer.high);
    if (below < height && height < above)
    {
      return &layer;
    }
  }
  return nullptr;
}

// Where the edges to the corners meet the plane, about the foot.
Section sectionWithin(
  const ToolSolid::Layer& layer, const Eigen::Vector3d& normal, double height) noexcept
{
  const double over = height - normal.z() * layer.pole; // the plane over the pole
  const Eigen::Vector3d foot = height * normal;
  const auto meet = [&](std::size_t k)
  {
    const Eigen::Vector2d& to = ToolSolid::corners()[k];
    const double across = normal.x() * to.x() + normal.y() * to.y();
    const double radius =
      layer.isShaft() ? layer.radius : layer.slope * over / (normal.z() + layer.slope * across);
    const double z =
      layer.isShaft() ? (height - radius * across) / normal.z() : layer.pole + radius / layer.slope;
    return Eigen::Vector3d(radius * to.x() - foot.x(), radius * to.y() - foot.y(), z - foot.z());
  };
  Section section;
  const Eigen::Vector3d first = meet(0);
  Eigen::Vector3d from = first;
  for (std::size_t k = 1; k <= ToolSolid::kSides; ++k)
  {
    const Eigen::Vector3d to = k < ToolSolid::kSides ? meet(k) : first;
    const double area = 0.5 * normal.dot(from.cross(to));
    section.area += area;
    section.moment += area / 3.0 * (from + to);
    from = to;
  }
  if (layer.isShaft())
  {
    const double area = ToolSolid::crossArea(layer.radius);
    section.volume = layer.below + area * (height / normal.z() - layer.low);
    section.growing = section.area / normal.z() * Eigen::Vector3d::UnitZ();
  }
  else
  {
    // a pyramid from the pole: its volume is a third of the area by the height
    const double area = ToolSolid::crossArea(layer.radius);
    section.volume = layer.below + (section.area * over - area * (layer.low - layer.pole)) / 3.0;
    section.growth = 2.0 * section.area / over;
    section.growing =
      (3.0 * section.moment - section.area * layer.pole * Eigen::Vector3d::UnitZ()) / over;
  }
  section.growing -= section.growing.dot(normal) * normal;
  return section;
}

} // namespace

Section sectionOf(const ToolSolid& solid, const Eigen::Vector3d& normal, double height) noexcept
{
  if (const ToolSolid::Layer* whole = wholeLayer(solid, normal, height); whole != nullptr)
  {
    return sectionWithin(*whole, normal, height);
  }
  constexpr std::size_t sides = ToolSolid::kSides;
  Cut cut(normal, height);
  std::array<Eigen::Vector3d, sides> ring;
  const ToolSolid::Layer& lowest = solid.layers().front();
  for (std::size_t k = 0; k < sides; ++k)
  {
    ring[k] = ToolSolid::corner(lowest, lowest.low, k);
  }
  if (solid.flatRadius() > 0.0)
  {
    std::array<Eigen::Vector3d, sides> fromBelow;
    std::reverse_copy(ring.begin(), ring.end(), fromBelow.begin());
    cut.add(fromBelow, -Eigen::Vector3d::UnitZ());
  }
  for (const ToolSolid::Layer& layer : solid.layers())
  {
    if (height < layer.low * normal.z() - solid.outerRadius() * normal.head<2>().norm())
    {
      break;
    }
    std::array<Eigen::Vector3d, sides> above;
    for (std::size_t k = 0; k < sides; ++k)
    {
      above[k] = ToolSolid::corner(layer, layer.high, k);
    }
    for (std::size_t k = 0; k < sides; ++k)
    {
      const std::size_t next = (k + 1) % sides;
      const Eigen::Vector2d to = ToolSolid::outward(k);
      const Eigen::Vector3d outward =
        layer.perSquare * Eigen::Vector3d(to.x(), to.y(), -layer.slope);
      cut.add(std::array{ ring[k], ring[next], above[next], above[k] }, outward);
    }
    ring = above;
  }
  return cut.sum();
}

} // namespace palp
