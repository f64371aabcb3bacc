#include "calibration/organ/mapped_contact.h"

#include "haptics/contact/contact_geometry_of.h"
#include "haptics/contact/embed_stiffness.h"
#include "haptics/force/force_law.h"
#include "haptics/force/nodules/homogeneous_press.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace palp
{
namespace
{

constexpr double kSphere = 4.0; // radius over that of the pressure
constexpr double kNarrow = 0.8; // contact radii over that of the pressure
constexpr double kWide = 1.3;

} // namespace

MappedContact::MappedContact(const OrganModel& model, const Surface& surface, double radius)
  : model_(model)
  , surface_(surface)
  , radius_(radius)
{
  const double sphere = kSphere * radius;
  const ForceLaw law(SphereTip{ sphere }, makeMaterial(1.0, model.poissonRatio()),
    { .mode = LawMode::Corrected, .constitution = ConstitutiveModel::Linear });
  const HomogeneousPress press(law, {}, kWide * kWide * radius * radius / sphere);
  const auto nearest = [&](double wanted)
  {
    Contact found{ .knot = 0, .radius = press.knots().front().radius };
    for (std::size_t k = 1; k < press.knots().size(); ++k)
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

std::optional<MappedContact> mappedContactOf(
  const OrganModel& model, const Surface& surface, double radius)
{
  return model.moduli().ratios().empty()
    ? std::nullopt
    : std::optional<MappedContact>(std::in_place, model, surface, radius);
}

// By d = d(a) + F (G0 + 4/15 a^2 tr A) at a force that is m times as much: without the map the
// radius would be a m^(1/3), and d - d(a) is 3 F / (4 a) times what m makes of both.
MappedContact::Beyond MappedContact::beyond(
  const std::function<double(const Eigen::Vector3d&)>& ratio) const
{
  const EnergyWeights::Means means = weights_->means(ratio);
  struct Given
  {
    double depth;  // over force, times E* [1/m]
    double square; // of the radius [m^2]
  };
  const auto given = [&](const Contact& contact)
  {
    const double third = std::exp(means.logs[contact.knot] / 3.0);
    const double radius = contact.radius * third;
    return Given{ 0.75 / radius * (1.0 / (third * third) - 1.0), radius * radius };
  };
  const Given narrow = given(narrow_);
  const Given wide = given(wide_);
  const double steep = (wide.depth - narrow.depth) / (wide.square - narrow.square);
  return { .constant = narrow.depth - steep * narrow.square, .bend = 15.0 / 4.0 * steep };
}

// by three places around, of which half of the constant's gradient is the slope
MappedContact::Told MappedContact::operator()(const TangentPlane& plane, double near) const
{
  const SurfacePoint place{ .position = plane.place(), .normal = plane.outward() };
  const double curvature = geometryAt(surface_, SphereTip{ radius_ }, place).surfaceCurvature;
  const double perModulus = 1.0 / (near * model_.contactModulus());
  constexpr int around = 3;
  const double step = 0.5 * radius_;
  Told told{ .isAtBorder = isAtBorder(plane) };
  for (int i = 0; i < around; ++i)
  {
    const double angle = 2.0 * std::numbers::pi * i / around;
    const Eigen::Vector3d way = plane.vector({ std::cos(angle), std::sin(angle) });
    const auto [constant, bend] = beyond(
      [&](const Eigen::Vector3d& in)
      {
        const Eigen::Vector3d below = plane.outside(belowCurved(in, curvature));
        return model_.ratio()(plane.place() + step * way + below) / near;
      });
    told.constant += perModulus * constant / around;
    told.bend += perModulus * bend / around;
    told.slope += perModulus * constant / (around * step) * way;
  }
  return told;
}

bool MappedContact::isAtBorder(const TangentPlane& plane) const
{
  constexpr double kReach = 2.0; // radii of the pressure
  constexpr double kAlike = 1.5; // times as stiff
  constexpr int around = 16;
  double least = std::numeric_limits<double>::infinity();
  double most = 0.0;
  for (double distance = 0.0; distance <= kReach; distance += 0.5)
  {
    for (int i = 0; i < around; ++i)
    {
      const double angle = 2.0 * std::numbers::pi * i / around;
      const Eigen::Vector3d aside =
        plane.vector({ distance * std::cos(angle), distance * std::sin(angle) });
      const double ratio =
        model_.ratio()(plane.place() + radius_ * aside - 0.5 * radius_ * plane.outward());
      least = ratio > 0.0 ? std::min(least, ratio) : least; // what is not known does not count
      most = ratio > 0.0 ? std::max(most, ratio) : most;
    }
  }
  return most > kAlike * least;
}

} // namespace palp
