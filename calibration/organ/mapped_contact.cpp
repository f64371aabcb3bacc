#include "calibration/organ/mapped_contact.h"

#include "haptics/force/force_law.h"
#include "haptics/force/nodules/homogeneous_press.h"

#include <cmath>

namespace palp
{
namespace
{

constexpr double kSphere = 4.0; // radius over that of the pressure
constexpr double kNarrow = 0.8; // contact radii over that of the pressure
constexpr double kWide = 1.3;

} // namespace

MappedContact::MappedContact(double radius, double poisson)
{
  const double sphere = kSphere * radius;
  const ForceLaw law(SphereTip{ sphere }, makeMaterial(1.0, poisson),
    { .mode = LawMode::Corrected, .constitution = ConstitutiveModel::Linear });
  const HomogeneousPress press(law, {}, kWide * kWide * radius * radius / sphere);
  const auto nearest = [&](double wanted)
  {
    Contact found;
    for (std::size_t k = 0; k < press.knots().size(); ++k)
    {
      const double here = press.knots()[k].radius;
      found =
        std::abs(here - wanted) < std::abs(found.radius - wanted) ? Contact{ k, here } : found;
    }
    return found;
  };
  narrow_ = nearest(kNarrow * radius);
  wide_ = nearest(kWide * radius);
  weights_.emplace(press);
}

// By d = d(a) + F (G0 + 4/15 a^2 tr A) at a force that is m times as much: without the map the
// radius would be a m^(1/3), and d - d(a) is 3 F / (4 a) times what m makes of both.
MappedContact::Beyond MappedContact::operator()(
  const std::function<double(const Eigen::Vector3d&)>& ratio) const
{
  const EnergyWeights::Means means = weights_->means(ratio);
  struct Told
  {
    double given;  // [1/m]
    double square; // of the radius [m^2]
  };
  const auto told = [&](const Contact& contact)
  {
    const double third = std::exp(means.logs[contact.knot] / 3.0);
    const double radius = contact.radius * third;
    return Told{ 0.75 / radius * (1.0 / (third * third) - 1.0), radius * radius };
  };
  const Told narrow = told(narrow_);
  const Told wide = told(wide_);
  const double steep = (wide.given - narrow.given) / (wide.square - narrow.square);
  return { .constant = narrow.given - steep * narrow.square, .bend = 15.0 / 4.0 * steep };
}

} // namespace palp
