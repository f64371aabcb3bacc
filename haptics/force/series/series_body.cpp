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
    const Eigen::Vector3d normal = place.normal + place.turning * step; // which is square to it
    spots[static_cast<std::size_t>(k)] = { place.tool + step - height * normal, normal, height };
  }
  const std::array<ComplianceField::Local, 4> told = field->atFour(spots);
  return { told[0].body, { told[1].body, told[2].body, told[3].body } };
}

Eigen::Vector3d SeriesBody::lateral(const Below& body, const SeriesLaw::Loaded& load) const noexcept
{
  return law.lateral(body.here, body.aside, kStep, load);
}

std::shared_ptr<const SeriesBody> seriesBodyOf(
  std::shared_ptr<const ComplianceField> field, const ForceLaw& law)
{
  if (field == nullptr)
  {
    return nullptr;
  }
  // of a map the law's own modulus says nothing
  const double young = field->youngModulus();
  const Material& tissue = law.material();
  const double modulus =
    makeMaterial(young > 0.0 ? young : tissue.youngModulus, tissue.poissonRatio).contactModulus();
  return std::make_shared<const SeriesBody>(
    SeriesBody{ .field = std::move(field), .law = SeriesLaw(law.tip(), modulus) });
}

Rule seriesRule(const SeriesBody& body, const ForceLaw& law, const SeriesContact& contact) noexcept
{
  const double other = kWidest * body.otherPoisson(law) / SeriesBody::kOtherPoisson;
  if (other > kWidest)
  {
    return { "organ", "-", other, kWidest,
      "the organ file is of another Poisson's ratio than the tissue: forces are off by some "
      "percent; palp organ --poisson makes one of it" };
  }
  const ComplianceField::Local local = body.field->at(contact.center, contact.normal);
  return { "organ", "-", std::max(local.doubtful, contact.width(body.law, local.body)), kWidest,
    "an edge, a thin place or a support is too near for the cells of the organ file or for so wide "
    "a contact, or the file leaves this piece out" };
}

} // namespace palp
