#include "haptics/force/nodules/nodule_field.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace palp
{
namespace
{

constexpr double kDeepest = 1.5; // of the base radius; beyond the law's own limit of 1
constexpr double kFelt = 2.0;    // lateral distance over depth, to which a nodule counts for rules
constexpr double kUnfelt = 1e12; // square of a distance at which a nodule adds nothing [m^2]

Nodules energyOf(const ForceLaw& law, const std::vector<EmbeddedNodule>& nodules)
{
  const double deepest = kDeepest * baseRadius(law.tip());
  const HomogeneousPress reference(law, nodules.front().place, deepest);
  std::vector<NoduleTable> tables;
  tables.reserve(nodules.size());
  for (const EmbeddedNodule& one : nodules)
  {
    tables.emplace_back(
      HomogeneousPress(law, one.place, deepest), checkedNodule(one.below()), reference);
  }
  return { reference, std::move(tables) };
}

} // namespace

NoduleField::NoduleField(const ForceLaw& law, std::vector<EmbeddedNodule> nodules)
  : nodules_(std::move(nodules))
  , height_(std::holds_alternative<SphereTip>(law.tip()) ? baseRadius(law.tip()) : 0.0)
  , constitution_(law.settings().constitution)
  , energy_(energyOf(law, nodules_))
{
}

Eigen::Vector3d NoduleField::aside(
  const EmbeddedNodule& nodule, const NoduleContact& at) const noexcept
{
  const double height = height_ - at.depth;
  const Eigen::Vector3d reference = at.center + height * at.normal;
  return reference - nodule.nodule.center - (nodule.depth + height) * at.normal;
}

NoduleField::Squares NoduleField::squaresAt(const NoduleContact& at) const noexcept
{
  Squares squares{};
  const double height = height_ - at.depth;
  const Eigen::Vector3d reference = at.center + height * at.normal;
  for (std::size_t i = 0; i < nodules_.size(); ++i)
  {
    const double above = nodules_[i].depth + height;
    squares[i] =
      std::max(0.0, (reference - nodules_[i].nodule.center).squaredNorm() - above * above);
  }
  return squares;
}

NoduleField::Local::Local(const NoduleField& field, const NoduleContact& at) noexcept
  : field_(&field)
  , contact_(at)
  , place_(field.energy_.at(field.squaresAt(at)))
{
}

Eigen::Vector3d NoduleField::Local::lateral(double depth) const noexcept
{
  const Nodules::Answer answer = field_->energy_(depth, place_);
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < field_->nodules_.size(); ++i)
  {
    force += answer.repulsion[i] * field_->aside(field_->nodules_[i], contact_);
  }
  return force;
}

std::vector<double> NoduleField::contrasts(const NoduleContact& at, const Response& plain) const
{
  const Squares here = squaresAt(at);
  std::vector<double> contrasts;
  for (std::size_t i = 0; i < nodules_.size(); ++i)
  {
    Squares alone{};
    alone.fill(kUnfelt);
    alone[i] = here[i];
    const double added = energy_(at.depth, std::span(alone).first(nodules_.size())).response.force;
    contrasts.push_back(plain.force > 0.0 ? added / plain.force : 0.0);
  }
  return contrasts;
}

double NoduleField::extentRadius(
  const NoduleContact& at, const Response& plain, double extent) const
{
  constexpr double kFar = 1.0 / 3.0; // exponents of the force with the nodule over that without
  constexpr double kNear = -0.5;
  constexpr double kSlope = 0.7; // from the one to the other, by extent over distance
  const Squares squares = squaresAt(at);
  const std::vector<double> more = contrasts(at, plain);
  double radius = extent;
  for (std::size_t i = 0; i < nodules_.size(); ++i)
  {
    const double distance = std::sqrt(squares[i] + nodules_[i].depth * nodules_[i].depth);
    radius *= std::pow(1.0 + more[i], std::min(kFar, kNear + kSlope * extent / distance));
  }
  return radius;
}

NoduleRules NoduleField::rules(const NoduleContact& at, const Response& plain) const
{
  const Squares squares = squaresAt(at);
  std::vector<Nodule> felt;
  NodulePress press{ .depth = at.depth, .contactRadius = plain.contactRadius };
  for (std::size_t i = 0; i < nodules_.size(); ++i)
  {
    const EmbeddedNodule& one = nodules_[i];
    if (at.depth > 0.0 && squares[i] < std::pow(kFelt * one.depth, 2.0))
    {
      felt.push_back(one.below());
      press.thickness = std::min(press.thickness, one.place.thickness);
      const double depth = (at.center - one.nodule.center).dot(at.normal);
      press.bend = std::max(press.bend, std::abs(depth / one.depth - 1.0));
    }
  }
  const double added = energy_(at.depth, squares).response.force;
  const double force = plain.force + added;
  press.added = force > 0.0 ? added / force : 0.0;
  return noduleRules(felt, press, constitution_);
}

} // namespace palp
