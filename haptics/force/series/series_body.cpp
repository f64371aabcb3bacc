#include "haptics/force/series/series_body.h"

#include "haptics/tip/tip.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace palp
{

std::shared_ptr<const SeriesBody> seriesBodyOf(
  std::shared_ptr<const ComplianceField> field, const ForceLaw& law)
{
  if (field == nullptr)
  {
    return nullptr;
  }
  const bool isSphere = std::holds_alternative<SphereTip>(law.tip());
  const double young = field->youngModulus();
  return std::make_shared<const SeriesBody>(SeriesBody{ .field = std::move(field),
    .law = SeriesLaw(law),
    .height = isSphere ? baseRadius(law.tip()) : 0.0,
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
