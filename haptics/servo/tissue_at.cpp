#include "haptics/servo/tissue_at.h"

#include "haptics/contact/contact_geometry_of.h"
#include "haptics/contact/embed_nodules.h"
#include "haptics/contact/embed_stiffness.h"
#include "haptics/force/energy_slopes.h"
#include "haptics/servo/coupling.h"

#include <algorithm>
#include <limits>

namespace palp
{

TissueAt::TissueAt(const Scene& scene, const Contact& contact) noexcept
  : scene_(&scene)
  , contact_(&contact)
  , geometry_(contactGeometryOf(contact))
  , askedDepth_(contact.depth)
{
  if (scene.series != nullptr)
  {
    // what is below is in the body's compliance
    geometry_.thickness = std::numeric_limits<double>::infinity();
  }
  if (scene.stiffness != nullptr)
  {
    stiffness_ = scene.stiffness->at(stiffnessContactOf(contact), scene.law, geometry_);
  }
  if (!contact.touching())
  {
    return;
  }
  if (scene.nodules != nullptr)
  {
    nodules_ = scene.nodules->at(noduleContactOf(contact));
  }
  if (scene.series != nullptr)
  {
    body_ = scene.series->at(seriesPlaceOf(contact));
  }
  plain_ = scene.law(geometry_);
  asked_ = find(contact.depth);
}

bool TissueAt::pushesAside(const Scene& scene) noexcept
{
  return scene.law.settings().mode == LawMode::Corrected || scene.nodules != nullptr ||
    scene.stiffness != nullptr || scene.series != nullptr;
}

Response TissueAt::plain(double depth) const noexcept
{
  if (depth == geometry_.depth)
  {
    return plain_;
  }
  ContactGeometry geometry = geometry_;
  geometry.depth = depth;
  return scene_->law(geometry);
}

Response TissueAt::local(double depth) const noexcept
{
  Response response = plain(depth);
  if (stiffness_)
  {
    response = (*stiffness_)(response, depth);
  }
  if (nodules_)
  {
    const NoduleResponse more = (*nodules_)(depth);
    response.force += more.force;
    response.stiffness += more.stiffness;
  }
  return response;
}

SeriesResponse TissueAt::find(double depth) const noexcept
{
  return body_
    ? scene_->series->law([this](double at) noexcept { return local(at); }, body_->here, depth)
    : SeriesResponse{ local(depth), depth, false };
}

const SeriesLaw::Loaded& TissueAt::load(double force) const noexcept
{
  if (force != loadedForce_)
  {
    loadedForce_ = force;
    loaded_ = scene_->series->law.load(body_->here, force);
  }
  return loaded_;
}

// in series: of the contact by itself, and of the body by its complementary energy
double TissueAt::energy(double depth) const noexcept
{
  const SeriesResponse at = answer(depth);
  if (!body_ || at.isBeyond)
  {
    return energyTo(*this, depth);
  }
  const double force = at.felt.force;
  return energyTo([this](double deep) noexcept { return local(deep); }, at.local) +
    force * (depth - at.local) - scene_->series->law.energy(body_->here, load(force));
}

// of how the shape below changes aside
Eigen::Vector3d TissueAt::lateralOfShape(const SeriesResponse& answer) const noexcept
{
  // beside a thin rim, where one side's normal cancels the other's, slopes are without end
  constexpr double kMost = 3.0; // of the force
  const double most = kMost * answer.felt.force;
  if (scene_->law.settings().mode != LawMode::Corrected || !(most > 0.0))
  {
    return Eigen::Vector3d::Zero();
  }
  ContactGeometry geometry = geometry_;
  geometry.depth = answer.local;
  const EnergySlopes slopes = energySlopes(scene_->law, geometry);
  const Eigen::Vector3d force =
    -(slopes.curvature * contact_->curvatureSlope + slopes.spread * contact_->spreadSlope +
      slopes.thickness * contact_->thicknessSlope + slopes.tilt * contact_->tiltSlope);
  return force / std::sqrt(std::hypot(1.0, force.squaredNorm() / (most * most)));
}

Eigen::Vector3d TissueAt::lateral(const SeriesResponse& answer) const noexcept
{
  Eigen::Vector3d force = lateralOfShape(answer);
  if (stiffness_)
  {
    force = stiffness_->lateral(plain(answer.local), force, answer.local);
  }
  if (nodules_)
  {
    force += nodules_->lateral(answer.local);
  }
  if (body_)
  {
    const Eigen::Vector3d more = scene_->series->lateral(*body_, load(answer.felt.force));
    // no round tool without friction is pushed more sideways than up; values that leap between
    // places, as over a thin rim beside a support, would say so
    force += std::min(1.0, answer.felt.force / more.norm()) * more;
  }
  return force;
}

} // namespace palp
