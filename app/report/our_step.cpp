#include "app/report/our_step.h"

#include "app/report/references.h"
#include "haptics/servo/servo_step.h"

namespace palp::report
{
namespace
{

constexpr double kWidth = 0.1; // of the plane [m], Sec. 3.3.2

} // namespace

OurStep::OurStep(int n, const Tip& tip, ExtentTable extents, std::optional<FittedSurfaces> fitted)
  : extents_(std::move(extents))
  , fitted_(std::move(fitted))
{
  const Mesh mesh = makeGrid(n, kWidth);
  scene_.surface = std::make_shared<const Surface>(mesh.points, mesh.triangles);
  scene_.law = ForceLaw(tip, kTissue);
  for (const Eigen::Vector3d& point : mesh.points)
  {
    for (const double x : point)
    {
      rest_.push_back(static_cast<float>(x));
    }
  }
  points_ = normals_ = displacement_ = rest_;
  zone_.resize(mesh.points.size());
  dent_ = Dent(rest_, mesh.triangles);
  dent_.reset(arrays());
}

void OurStep::operator()(const Eigen::Vector3d& apex)
{
  const ToolPose pose{
    .apex = apex, .axis = -Eigen::Vector3d::UnitZ(), .velocity = Eigen::Vector3d::Zero()
  };
  const Sample sample = step(scene_, pose);
  const double depth = sample.contact.depth;
  dent_.update({ .contact = sample.contact,
                 .pose = pose,
                 .tip = scene_.law.tip(),
                 .contactRadius = sample.response.contactRadius,
                 .extentRadius = extents_.extentRadius(depth),
                 .fitted = fitted_ ? fitted_->at(depth) : std::nullopt },
    arrays());
}

} // namespace palp::report
