#include "app/check/panel/surface_check.h"

#include "app/check/check_text.h"
#include "app/check/checked_surface.h"
#include "app/check/panel/check_panel.h"

#include <algorithm>
#include <utility>

namespace palp
{
namespace
{

constexpr double kLift = 0.003; // of the body's diagonal, as it may be shown coarser

// so many that nobody misses the rest
std::vector<FaultMarks::Corners> cornersOf(const std::vector<const Finding*>& findings,
  const CheckedSurface& checked, const Eigen::Isometry3d& frame)
{
  constexpr std::size_t kMost = 20'000;
  std::size_t count = 0;
  for (const Finding* finding : findings)
  {
    count += finding->triangles.size();
  }
  const std::size_t step = count / kMost + 1;
  std::vector<FaultMarks::Corners> corners;
  for (const Finding* finding : findings)
  {
    for (std::size_t i = 0; i < finding->triangles.size(); i += step)
    {
      FaultMarks::Corners& of = corners.emplace_back();
      const Triangle& triangle = checked.triangles[at(finding->triangles[i])];
      for (std::size_t k = 0; k < of.size(); ++k)
      {
        of.at(k) = frame * checked.points[at(triangle.at(k))];
      }
    }
  }
  return corners;
}

} // namespace

SurfaceCheck::SurfaceCheck(vtkRenderer& renderer, CheckPanel& panel, std::function<void()> changed)
  : panel_(panel)
  , changed_(std::move(changed))
  , marks_(renderer)
{
  QObject::connect(&panel, &CheckPanel::chosenChanged, &panel, [this] { draw(); });
}

void SurfaceCheck::open(std::shared_ptr<const CheckedSurface> checked,
  std::shared_ptr<const Surface> felt, const Eigen::Isometry3d& frame)
{
  checked_ = std::move(checked);
  felt_ = std::move(felt);
  frame_ = frame;
  const MeshHealth& health = checked_->health;
  QStringList measures;
  for (const std::string& line : measuresOf(health, checked_->file))
  {
    measures << QString::fromStdString(line);
  }
  panel_.show(
    QString::fromStdString(verdictOf(health)), measures.join('\n'), faultTable(health, frame));
  draw();
}

void SurfaceCheck::close()
{
  checked_.reset();
  panel_.show(CheckPanel::tr("Nothing is checked: Edit > Check surface does it"), {}, {});
  draw();
}

void SurfaceCheck::setVisible(bool shown)
{
  isShown_ = shown;
  draw();
}

std::vector<const Finding*> SurfaceCheck::marked() const
{
  std::vector<const Finding*> findings;
  const std::vector<Finding> none;
  const std::vector<Finding>& all = checked_ ? checked_->health.findings : none;
  const std::optional<std::size_t> chosen = panel_.chosen();
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    const bool isMarked = chosen ? i == *chosen : disturbs(all[i].fault);
    isMarked ? findings.push_back(&all[i]) : void();
  }
  return findings;
}

// of all triangles near there, as that of the fault itself may face anywhere
Eigen::Vector3d SurfaceCheck::outwardAt(const Eigen::Vector3d& place) const
{
  const double reach = std::max(2.0 * felt_->edgeLength(), 0.01 * diagonal());
  const BoxTree& tree = felt_->tree();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  tree.search([&](const BoxTree::Node& box) { return squaredDistance(box, place) < reach * reach; },
    [&](int facet)
    {
      const auto& [p, q, r] = tree.facets()[at(facet)].corners;
      sum += (q - p).cross(r - p);
    });
  return sum.norm() > 0.0 ? sum.normalized().eval() : Eigen::Vector3d::UnitZ();
}

std::optional<SurfacePoint> SurfaceCheck::place() const
{
  const std::vector<const Finding*> findings = marked();
  if (findings.empty())
  {
    return std::nullopt;
  }
  const Eigen::Vector3d place = frame_ * findings.front()->place;
  return SurfacePoint{ place, outwardAt(place) };
}

double SurfaceCheck::diagonal() const
{
  return (checked_->health.high - checked_->health.low).norm();
}

void SurfaceCheck::draw()
{
  const std::vector<const Finding*> findings = marked();
  const double lift = findings.empty() ? 0.0 : kLift * diagonal();
  std::vector<Eigen::Vector3d> places;
  places.reserve(findings.size());
  for (const Finding* finding : findings)
  {
    places.emplace_back(frame_ * finding->place);
  }
  isShown_ && !findings.empty() ? marks_.show(cornersOf(findings, *checked_, frame_), places, lift)
                                : marks_.show({}, {}, lift);
  panel_.showLegend(findings.empty() ? QString()
      : panel_.chosen() ? QString::fromStdString(std::string(nameOf(findings.front()->fault)))
                        : CheckPanel::tr("all that disturbs a press"));
  changed_();
}

} // namespace palp
