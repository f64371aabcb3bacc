#include "app/commands/pressed_place.h"

namespace palp
{
namespace
{

StiffnessContact contactAt(const ContactGeometry& geometry)
{
  return { Eigen::Vector3d::Zero(), -Eigen::Vector3d::UnitZ(), geometry.depth,
    Eigen::Matrix3d::Zero() };
}

} // namespace

Response PressedPlace::response(const ContactGeometry& geometry) const
{
  Response response = law(geometry);
  if (stiffness != nullptr)
  {
    response = stiffness->at(contactAt(geometry), law, geometry)(response, geometry.depth);
  }
  if (nodules)
  {
    const NoduleResponse more = nodules->at(geometry.depth).response;
    response.force += more.force;
    response.stiffness += more.stiffness;
  }
  return response;
}

Eigen::Vector2d PressedPlace::aside(const ContactGeometry& geometry) const
{
  if (nodules)
  {
    return { nodules->at(geometry.depth).lateral, 0.0 };
  }
  if (stiffness == nullptr)
  {
    return Eigen::Vector2d::Zero();
  }
  return stiffness->at(contactAt(geometry), law, geometry)
    .lateral(law(geometry), Eigen::Vector3d::Zero(), geometry.depth)
    .head<2>();
}

std::vector<Rule> PressedPlace::rules(const ContactGeometry& geometry) const
{
  const Rules all = validity(geometry);
  std::vector<Rule> rules(all.begin(), all.end());
  if (nodules)
  {
    const NoduleRules more = nodules->rules(geometry.depth, law(geometry));
    rules.insert(rules.end(), more.begin(), more.end());
  }
  if (stiffness != nullptr)
  {
    rules.push_back(stiffness->rule(contactAt(geometry)));
  }
  return rules;
}

} // namespace palp
