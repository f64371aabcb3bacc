#include "haptics/servo/tissue_at.h"

#include "haptics/contact/contact_geometry_of.h"
#include "haptics/contact/embed_nodules.h"
#include "haptics/contact/embed_stiffness.h"

#include <algorithm>
#include <limits>

namespace palp
{

TissueAt::TissueAt(const Scene& scene, const Contact& contact) noexcept
  : scene_(&scene)
  , contact_(&contact)
  , geometry_(contactGeometryOf(contact))
{
  if (scene.stiffness != nullptr)
  {
    stiffness_ = scene.stiffness->at(stiffnessContactOf(contact), scene.law, geometry_);
  }
  if (scene.series != nullptr && contact.touching())
  {
    body_ = scene.series->field->at(contact.center, contact.normal);
    // what is below is in the body's compliance
    geometry_.thickness = std::numeric_limits<double>::infinity();
  }
}

Response TissueAt::plain(double depth) const noexcept
{
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
  if (scene_->nodules != nullptr)
  {
    const NoduleResponse more = (*scene_->nodules)(noduleContactOf(*contact_), depth).response;
    response.force += more.force;
    response.stiffness += more.stiffness;
  }
  return response;
}

SeriesResponse TissueAt::answer(double depth) const noexcept
{
  return body_
    ? scene_->series->law([this](double at) noexcept { return local(at); }, body_->body, depth)
    : SeriesResponse{ local(depth), depth, false };
}

Eigen::Vector3d TissueAt::lateral(const SeriesResponse& answer) const noexcept
{
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  if (stiffness_)
  {
    force += stiffness_->lateral(plain(answer.local), answer.local);
  }
  if (scene_->nodules != nullptr)
  {
    force += (*scene_->nodules)(noduleContactOf(*contact_), answer.local).lateral;
  }
  if (body_)
  {
    // a place that is pressed moves by less than a tool on a convex surface
    constexpr double kLeastTurn = 0.3;
    const double turn = std::max(
      kLeastTurn, 1.0 + contact_->surfaceCurvature * (scene_->series->height - contact_->depth));
    force += scene_->series->law.lateral(*body_, answer.felt.force) / turn;
  }
  return force;
}

} // namespace palp
