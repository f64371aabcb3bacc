#include "haptics/force/series/series_body.h"

#include "haptics/tip/tip.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace palp
{
namespace
{

constexpr double kStep = 10e-6; // [m] to the side, for slopes: far less than places are apart

} // namespace

SeriesBody::Below SeriesBody::at(const SeriesPlace& place) const noexcept
{
  std::array<ComplianceField::Spot, 4> spots;
  for (Eigen::Index k = 0; k < 4; ++k)
  {
    Eigen::Vector3d step = Eigen::Vector3d::Zero();
    step[std::max<Eigen::Index>(k - 1, 0)] = k > 0 ? kStep : 0.0;
    const double height = place.height + place.rising.dot(step);
    const Eigen::Vector3d normal = (place.normal + place.turning * step).normalized();
    spots[static_cast<std::size_t>(k)] = { place.tool + step - height * normal, normal, height };
  }
  std::array<ComplianceField::Local, 4> told = field->atFour(spots);
  std::ranges::for_each(told, [this](ComplianceField::Local& one) { one *= softer; });
  return { told[0].body, { told[1].body, told[2].body, told[3].body } };
}

Eigen::Vector3d SeriesBody::lateral(const Below& body, double force) const noexcept
{
  return law.lateral(body.here, body.aside, kStep, force);
}

std::shared_ptr<const SeriesBody> seriesBodyOf(
  std::shared_ptr<const ComplianceField> field, const ForceLaw& law)
{
  if (field == nullptr)
  {
    return nullptr;
  }
  const double young = field->youngModulus();
  return std::make_shared<const SeriesBody>(SeriesBody{ .field = std::move(field),
    .law = SeriesLaw(law),
    .softer = young > 0.0 ? law.material().youngModulus / young : 1.0 });
}

Rule seriesRule(const SeriesBody& body, const ForceLaw& law, const SeriesContact& contact) noexcept
{
  constexpr double kPoisson = 0.1; // by which E* G0 of a layer changes by some percent
  const double other =
    std::abs(law.material().poissonRatio - body.field->poissonRatio()) / kPoisson;
  ComplianceField::Local local = body.field->at(contact.center, contact.normal);
  local *= body.softer;
  return { "organ", "-",
    std::max({ local.doubtful, kWidest * other, contact.width(body.law, local.body) }), kWidest,
    "an edge, a thin place or a support is too near for the cells of the organ file or for so wide "
    "a contact, or that is of another Poisson's ratio" };
}

} // namespace palp
