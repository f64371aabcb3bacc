// Whatever is loaded and however a tool meets it, the servo answers with numbers and never pulls.

#include "haptics/contact/embed_nodules.h"
#include "haptics/contact/embed_stiffness.h"
#include "haptics/error.h"
#include "haptics/servo/servo_step.h"
#include "tests/haptics/servo/odd_worlds.h"
#include "tests/support/sampled.h"

#include <array>
#include <gtest/gtest.h>
#include <optional>
#include <random>

namespace palp
{
namespace
{

using namespace units::literals;
using Eigen::Vector3d;
using Random = std::mt19937;

#ifdef PALP_SLOW
constexpr int kPoses = 200;
#else
constexpr int kPoses = test::kSanitized ? 4 : 8;
#endif

double anyOf(Random& random, std::initializer_list<double> values)
{
  return std::data(values)[random() % values.size()];
}

Vector3d anyWay(Random& random)
{
  std::normal_distribution<double> normal;
  return Vector3d(normal(random), normal(random), normal(random)).normalized();
}

Vector3d placeOn(const Facet& facet, double u, double v)
{
  const auto& [a, b, c] = facet.corners;
  return a + u * (b - a) + v * (c - a);
}

// at the middle of a triangle, within it, on a side or at a corner; touching, deep, far beyond the
// body or off it; upright, tilted, along the surface or from behind
ToolPose anyPose(Random& random, const Surface& surface, double base)
{
  const auto facets = surface.tree().facets();
  const Facet& facet = facets[random() % facets.size()];
  std::uniform_real_distribution<double> share;
  const double u = anyOf(random, { 0.0, 1.0 / 3.0, 0.5, share(random) });
  const double v = (1.0 - u) * anyOf(random, { 0.0, 0.5, 1.0, share(random) });
  const double edge = surface.edgeLength();
  const double depth = anyOf(random, { 1.0, 1.0, 1.0, -1.0 }) *
    anyOf(random,
      { 0.0, 1e-12, 1e-6, 0.01 * base, 0.1 * base, 0.5 * base, base, 3.0 * base, 0.1 * edge, edge,
        5.0 * edge, 100.0 * edge, base * share(random) });
  const double tilt = anyOf(random, { 0.0, 0.0, 0.3, 1.0, 89.0_deg, 180.0_deg, share(random) });
  const Vector3d aside = anyWay(random).cross(facet.normal).normalized();
  const Vector3d axis = (std::sin(tilt) * aside - std::cos(tilt) * facet.normal).normalized();
  const Vector3d down = random() % 2 == 0 ? Vector3d(-facet.normal) : axis;
  return { .apex = placeOn(facet, u, v) + depth * down,
    .axis = axis,
    .velocity = anyOf(random, { 0.0, 0.1, 10.0 }) * anyWay(random) };
}

const char* wrongIn(const Contact& contact)
{
  const Vector3d values(contact.depth, contact.tilt, contact.surfaceCurvature);
  const Vector3d more(contact.curvatureSpread, contact.hollow, contact.normalSpread);
  if (!values.allFinite() || !more.allFinite() || !std::isfinite(contact.slope) ||
    !contact.normal.allFinite() || !contact.center.allFinite() ||
    !contact.curvatureSlope.allFinite() || !contact.spreadSlope.allFinite() ||
    !contact.thicknessSlope.allFinite())
  {
    return "a contact that is not finite";
  }
  if (!(contact.thickness > 0.0) || !(contact.edgeDistance >= 0.0)) // both may be infinite
  {
    return "a thickness or a distance that is none";
  }
  const double length = contact.touching() ? 1.0 : 0.0;
  return contact.depth >= 0.0 && std::abs(contact.normal.norm() - length) < 1e-9
    ? nullptr
    : "a normal that is not of unit length";
}

// a press that a body could bear: no deeper than it is thick, by no more than the end of the tool
bool isShallow(const Sample& sample, const Scene& scene)
{
  const double base = baseRadius(scene.law.tip());
  return sample.contact.depth < std::min(sample.contact.thickness, base) &&
    base < 10.0 * scene.surface->edgeLength();
}

const char* wrongIn(const Sample& sample, const Scene& scene)
{
  const Response& response = sample.response;
  const Vector3d felt(response.force, response.contactRadius, response.stiffness);
  const Vector3d depths(sample.localDepth, sample.proxyDepth, sample.surfaceDepth);
  if (!felt.allFinite() || !depths.allFinite() || !sample.lateral.allFinite() ||
    !sample.force.allFinite() || !sample.friction.allFinite() ||
    (sample.flags & static_cast<std::uint32_t>(Flag::NotFinite)) != 0)
  {
    return "what is not a number";
  }
  if (response.force < 0.0 || response.contactRadius < 0.0 ||
    sample.force.dot(sample.contact.normal) < -1e-9)
  {
    return "a force that pulls";
  }
  if (sample.force.norm() > scene.forceLimit * (1.0 + 1e-12))
  {
    return "a force beyond the limit";
  }
  // micronewtons of a pin that touches a corner do not count
  if (isShallow(sample, scene) && response.force > 1e-6)
  {
    const bool isGiven = scene.series != nullptr; // by tables that are none of a body
    constexpr double kSteepest = 6.0; // 2 as a height may change, and 4 as a far wall may come in
    return sample.contact.slope > kSteepest                       ? "a slope of rounding"
      : !isGiven && sample.lateral.norm() > 10.0 * response.force ? "a tool thrown aside"
                                                                  : wrongIn(sample.contact);
  }
  return wrongIn(sample.contact);
}

// an arm that renders all that it is told
SafetyChain strongArm()
{
  return SafetyChain({ .model = "arm", .maxForce = 1e3, .damping = 1e4 },
    { .slewRate = 1e9, .softSlewRate = 1e8, .softStart = 1e-6, .decay = 1e-6, .fastest = 1e15 });
}

// in jumps, by each way to step; stops at the first that is wrong
void tryPoses(const Scene& scene, Random& random)
{
  TissueMemory memory;
  TissueMemory felt;
  SafetyChain chain = strongArm();
  const auto check = [&](const Sample& sample, const char* how)
  {
    const char* wrong = wrongIn(sample, scene);
    const Eigen::IOFormat exact(Eigen::FullPrecision, 0, ", ", ", ");
    EXPECT_EQ(wrong, nullptr) << how << ": " << wrong << " at " << sample.pose.apex.format(exact)
                              << " along " << sample.pose.axis.format(exact) << ", "
                              << sample.contact.depth << " deep, slope " << sample.contact.slope
                              << ", " << sample.response.force << " N, aside "
                              << sample.lateral.norm();
    return wrong == nullptr;
  };
  for (int i = 0; i < kPoses; ++i)
  {
    const ToolPose pose = anyPose(random, *scene.surface, baseRadius(scene.law.tip()));
    const double dt = anyOf(random, { 0.0, 1e-6, 1.0_ms, 1.0 });
    bool isGood =
      check(step(scene, pose), "a step") && check(step(scene, memory, pose, dt), "with a memory");
    for (const bool armed : { false, true, true }) // a fault is forgiven
    {
      isGood = isGood &&
        check(step(scene, felt, chain, pose, {}, { .armed = armed }, dt), "behind a chain");
    }
    if (!isGood)
    {
      return;
    }
  }
}

// none where the law cannot be had for the tip
std::optional<ForceLaw> lawOf(const Tip& tip, double poisson, const LawSettings& settings)
{
  try
  {
    return ForceLaw(tip, makeMaterial(20.0_kPa, poisson), settings);
  }
  catch (const Error&)
  {
    return {};
  }
}

TEST(AnyScene, EverySurfaceTipAndLawGivesNumbers)
{
  const auto surfaces = test::oddSurfaces();
  Random random(1);
  test::Sampled samples(5);
  for (const auto& [tipName, tip] : test::allTips())
  {
    for (const auto& [lawName, settings] : test::allLaws())
    {
      const auto law = lawOf(tip, anyOf(random, { 0.0, 0.3, 0.45, 0.5 }), settings);
      for (const auto& [surfaceName, surface] : surfaces)
      {
        for (const ContactRule rule : { ContactRule::Exact, ContactRule::Paper })
        {
          if (!samples.takes())
          {
            continue;
          }
          Scene scene{ .surface = surface, .rule = rule };
          scene.law = law.value_or(scene.law);
          scene.damping = anyOf(random, { 0.0, 1.0, 100.0 });
          SCOPED_TRACE(testing::Message() << surfaceName << ", " << tipName << ", " << lawName
                                          << (rule == ContactRule::Exact ? "" : ", by points"));
          tryPoses(scene, random);
        }
      }
    }
  }
}

Vector3d belowAFace(const Scene& scene, double depth)
{
  const Facet& facet = scene.surface->tree().facets().front();
  return placeOn(facet, 1.0 / 3.0, 1.0 / 3.0) - depth * facet.normal;
}

void addNodule(Scene& scene)
{
  const std::array nodules{ PlacedNodule{ belowAFace(scene, 8.0_mm), 4.0_mm, 20.0 } };
  scene.nodules = embedNodules(*scene.surface, scene.law, nodules);
}

void addCompliance(Scene& scene)
{
  std::vector<PlacedCompliance> places;
  const auto facets = scene.surface->tree().facets();
  for (std::size_t i = 0; i < facets.size(); i += 1 + facets.size() / 50)
  {
    places.push_back({ .position = placeOn(facets[i], 1.0 / 3.0, 1.0 / 3.0),
      .normal = facets[i].normal,
      .constant = 50.0,
      .slope = 300.0 * facets[i].normal.unitOrthogonal(),
      .bend = -2e4,
      .edge = i % 3 == 0 ? 50.0 : 0.0 });
  }
  scene.series = seriesBodyOf(
    std::make_shared<const ComplianceField>(places, 20.0_mm, scene.law.material().poissonRatio),
    scene.law);
}

[[maybe_unused]] void addMap(Scene& scene)
{
  const double middle = belowAFace(scene, 0.0).x();
  scene.stiffness = embedStiffness(*scene.surface, scene.law,
    [middle](const Vector3d& x)
    { return 20.0_kPa * (1.5 + std::tanh((x.x() - middle) / 5.0_mm)); });
}

TEST(AnyScene, WhateverLiesInABodyGivesNumbers)
{
  std::vector<test::Named<void (*)(Scene&)>> extras{ { "compliance", addCompliance },
    { "nodule and compliance",
      [](Scene& scene)
      {
        addNodule(scene);
        addCompliance(scene);
      } } };
#ifdef PALP_SLOW // seconds each
  extras.push_back({ "nodule", addNodule });
  extras.push_back({ "map", addMap });
#endif
  Random random(2);
  const auto tips = test::allTips();
  const auto laws = test::allLaws();
  for (const auto& [surfaceName, surface] : test::oddSurfaces())
  {
    for (const auto& [extraName, add] : extras)
    {
      const auto& [tipName, tip] = tips[random() % tips.size()];
      const auto& [lawName, settings] = laws[random() % laws.size()];
      Scene scene{ .surface = surface };
      scene.law = lawOf(tip, 0.45, settings).value_or(scene.law);
      try
      {
        add(scene);
      }
      catch (const Error&)
      {
        continue; // nodules and maps are for some laws and bodies only
      }
      SCOPED_TRACE(testing::Message()
        << surfaceName << ", " << tipName << ", " << lawName << ", " << extraName);
      tryPoses(scene, random);
    }
  }
}

} // namespace
} // namespace palp
