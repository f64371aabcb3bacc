#include "haptics/servo/tissue_memory.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace palp
{

void TissueMemory::forget(const Scene& scene, int organ) noexcept
{
  contact_ = {};
  friction_ = {};
  rows_ = *scene.law.rows();
  version_ = scene.version;
  organ_ = organ;
  touched_ = false;
  radius_ = 0.0;
}

// the tool touches again: elsewhere the tissue is fresh
void TissueMemory::returnTo(const Contact& contact) noexcept
{
  const Eigen::Vector3d away = apex_ - left_;
  const double distance = (away - away.dot(contact.normal) * contact.normal).norm();
  contact_.fade(radius_ > 0.0 ? 1.0 - distance / radius_ : 0.0);
  radius_ = contact_.surfaceDepth() > 0.0 ? radius_ : 0.0;
}

Response TissueMemory::elastic(double depth) const noexcept
{
  return (*tissue_)(depth);
}

bool TissueMemory::begin(const Scene& scene, const Sample& sample, double dt) noexcept
{
  tissue_.emplace(scene, sample.contact);
  if (scene.law.rows() == nullptr)
  {
    rows_.reset();
    return false;
  }
  const Eigen::Vector3d& apex = sample.pose.apex;
  const Eigen::Vector3d before = apex_;
  apex_ = apex.allFinite() ? apex : before;
  if (!rows_ || version_ != scene.version || organ_ != sample.organ)
  {
    forget(scene, sample.organ);
  }
  law_ = &scene.law;
  const bool touching = sample.contact.touching();
  moved_ = touched_ && touching ? Eigen::Vector3d(apex_ - before) : Eigen::Vector3d::Zero();
  if (touching && !touched_)
  {
    returnTo(sample.contact);
  }
  touched_ = touching;
  contact_.predict(scene.law.settings().relaxation, dt);
  if (touching)
  {
    left_ = apex_;
    rows_->adapt(*scene.law.rows(), sample.contact.depth,
      [&](double depth) noexcept
      {
        const Response at = elastic(depth);
        return ElasticForce{ at.force, at.stiffness };
      });
  }
  return true;
}

Response TissueMemory::at(double depth) const noexcept
{
  if (law_->settings().relaxation.empty())
  {
    return elastic(depth); // friction alone changes nothing along the normal
  }
  const ElasticForce answer = contact_.at(*rows_, depth);
  return { .force = answer.force, .contactRadius = 0.0, .stiffness = answer.stiffness };
}

// of the tool on the tissue, by the force that is felt, no stiffer than may be rendered
Eigen::Vector3d TissueMemory::drag(
  const Rendered& felt, double stiffest, const Eigen::Vector3d& normal) noexcept
{
  std::span<const double> loads = contact_.loads();
  const double load = std::reduce(loads.begin(), loads.end());
  FrictionRows::Tissue tissue{ .coefficient = law_->settings().friction,
    .poissonRatio = law_->material().poissonRatio };
  if (!(load > 0.0 && felt.force > 0.0 && stiffest > 0.0))
  {
    loads = {};
  }
  else
  {
    tissue.coefficient *= felt.force / load;
    const double sticking = tangentialRatio(tissue.poissonRatio) * rows_->total[loads.size()];
    tissue.softer = std::min(1.0, stiffest / sticking);
  }
  return friction_.drag(*rows_, loads, tissue, normal, moved_);
}

Eigen::Vector3d TissueMemory::settle(const Rendered& felt, double stiffest, Sample& sample) noexcept
{
  const Contact& contact = sample.contact;
  sample.response.contactRadius =
    touched_ ? elastic(contact_.contactDepth(*rows_, contact.depth)).contactRadius : 0.0;
  radius_ = std::max(radius_, sample.response.contactRadius);
  contact_.settle(*rows_, touched_ ? felt.proxyDepth : 0.0);
  sample.surfaceDepth = contact_.surfaceDepth();

  sample.friction = -drag(felt, stiffest, contact.normal);
  return sample.friction;
}

} // namespace palp
