#include "calibration/organ/organ_compliance.h"

#include "data/shapes.h"
#include "haptics/error.h"
#include "haptics/units.h"

#include <Eigen/Geometry>
#include <array>
#include <gtest/gtest.h>
#include <string>
#include <tuple>
#include <vector>

namespace palp
{
namespace
{

using namespace units::literals;
using Eigen::Vector3d;

constexpr double kModelYoung = 50e3;
constexpr double kModelPoisson = 0.45;

// how far the top of a box of 20 mm by 20 mm sinks under a pascal [m/Pa]
double pressedEvenly(const OrganModel& model)
{
  Eigen::VectorXd load = Eigen::VectorXd::Zero(3 * model.nodes());
  OrganModel::Weights weights{};
  constexpr int parts = 40;
  const double part = 20.0_mm * 20.0_mm / (parts * parts); // of a pascal
  for (int i = 0; i < parts * parts; ++i)
  {
    const Vector3d place(20.0_mm * ((i % parts + 0.5) / parts - 0.5),
      20.0_mm * ((i / parts + 0.5) / parts - 0.5), 0.0);
    EXPECT_TRUE(model.weightsAt(place, Vector3d::UnitZ(), weights));
    for (std::size_t k = 0; k < weights.nodes.size(); ++k)
    {
      load[3 * weights.nodes[k] + 2] -= part * weights.values[k];
    }
  }
  const Eigen::MatrixXd moved = model.solve(load);
  EXPECT_TRUE(model.weightsAt({ 3.0_mm, -4.0_mm, 0.0 }, Vector3d::UnitZ(), weights));
  double down = 0.0;
  for (std::size_t k = 0; k < weights.nodes.size(); ++k)
  {
    down -= weights.values[k] * moved(3 * weights.nodes[k] + 2, 0);
  }
  return down;
}

// a column that slides on its base and two sides, under a pressure on its top: u = p h / E
TEST(OrganModel, ShortensAColumnByHookesLaw)
{
  const Mesh box = makeBox({ 20.0_mm, 20.0_mm, 40.0_mm }, 5.0_mm);
  const Surface surface(box.points, box.triangles);
  std::vector<Support> slides;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double low = axis == 2 ? -40.0_mm : -10.0_mm;
    slides.push_back(
      { [axis, low](const Vector3d& x) { return x[axis] < low + 0.1_mm; }, Vector3d::Unit(axis) });
  }
  const OrganModel model(surface, 5.0_mm, kModelYoung, kModelPoisson, slides);
  const double hooke = 40.0_mm / kModelYoung;
  EXPECT_NEAR(pressedEvenly(model), hooke, 2e-3 * hooke);
}

// of Hooke's law in series, also where the border runs through cells; a body as soft all over is as
// if it were made so
TEST(OrganModel, ABodyOfTwoModuliGivesWayAsBothInSeries)
{
  const Mesh box = makeBox({ 20.0_mm, 20.0_mm, 40.0_mm }, 5.0_mm);
  const Surface surface(box.points, box.triangles);
  const std::array<Support, 3> slides{ Support{ [](const Vector3d& x) { return x.z() < -39.99_mm; },
                                         Vector3d::UnitZ() },
    Support{ [](const Vector3d& x) { return x.x() < -9.99_mm; }, Vector3d::UnitX() },
    Support{ [](const Vector3d& x) { return x.y() < -9.99_mm; }, Vector3d::UnitY() } };
  for (const auto& [border, stiffer, limit] : { std::tuple{ -15.0_mm, 4.0, 2e-3 },
         std::tuple{ -25.0_mm, 0.25, 2e-3 }, std::tuple{ -17.5_mm, 4.0, 0.03 } })
  {
    const auto ratio = [&](const Vector3d& x) { return x.z() < border ? stiffer : 1.0; };
    constexpr double slender = 0.0; // else each would keep the other from spreading
    const OrganModel model(surface, 5.0_mm, kModelYoung, slender, slides, ratio);
    const double hooke = (-border + (40.0_mm + border) / stiffer) / kModelYoung;
    EXPECT_NEAR(pressedEvenly(model), hooke, limit * hooke) << border;
  }
  const auto third = [](const Vector3d&) { return 1.0 / 3.0; };
  const OrganModel soft(surface, 5.0_mm, kModelYoung, kModelPoisson, slides, third);
  const OrganModel same(surface, 5.0_mm, kModelYoung / 3.0, kModelPoisson, slides);
  const Vector3d place(1.0_mm, 2.0_mm, 0.0);
  const auto found = complianceAt(soft, surface, place, Vector3d::UnitZ());
  const auto wanted = complianceAt(same, surface, place, Vector3d::UnitZ());
  ASSERT_TRUE(found && wanted);
  EXPECT_NEAR(found->constant, wanted->constant, 1e-3 * std::abs(wanted->constant));
  EXPECT_NEAR(soft.moduli().around(place, 6.0_mm), 1.0 / 3.0, 1e-12);
}

// of which one is held: the other is a piece of its own, and a place on it is none of the model
TEST(OrganModel, OfTwoBoxesThatShareAnEdgeIsThatOfOne)
{
  Mesh boxes = makeBox({ 20.0_mm, 20.0_mm, 20.0_mm }, 5.0_mm);
  const Mesh one = boxes;
  const int shift = static_cast<int>(one.points.size());
  for (const Vector3d& point : one.points)
  {
    boxes.points.push_back(point + Vector3d(20.0_mm, 0.0, 20.0_mm));
  }
  for (const Triangle& t : one.triangles)
  {
    boxes.triangles.push_back({ t[0] + shift, t[1] + shift, t[2] + shift });
  }
  const Surface surface(boxes.points, boxes.triangles);
  const Support base{ [](const Vector3d& x) { return x.z() < -19.9_mm || x.z() > 19.9_mm; } };
  for (const double cell : { 2.0_mm, 3.0_mm, 4.0_mm, 5.0_mm, 6.0_mm, 10.0_mm })
  {
    const OrganModel model(surface, cell, kModelYoung, kModelPoisson, std::span(&base, 1));
    OrganModel::Weights weights{};
    int on = 0;
    for (const Vector3d& place : { Vector3d(0.0, 0.0, 0.0), Vector3d(20.0_mm, 0.0, 20.0_mm) })
    {
      const bool isOn = model.weightsAt(place, Vector3d::UnitZ(), weights);
      on += isOn ? 1 : 0;
      for (std::size_t i = 0; isOn && i < weights.nodes.size(); ++i)
      {
        EXPECT_GE(weights.nodes[i], 0) << cell;
        EXPECT_LT(weights.nodes[i], model.nodes()) << cell;
      }
    }
    EXPECT_GE(on, 1) << cell;
    EXPECT_NEAR(model.leftOut(), on == 1 ? 0.5 : 0.0, 0.01) << cell;
  }
}

// four million cubes: their factors would take 900 GB
TEST(OrganModel, RefusesCellsForWhichThereIsNoMemoryBeforeItFillsIt)
{
  const Mesh box = makeBox({ 20.0_mm, 20.0_mm, 20.0_mm }, 20.0_mm);
  const Surface surface(box.points, box.triangles);
  const Support base{ [](const Vector3d& x) { return x.z() < -19.9_mm; } };
  try
  {
    const OrganModel model(surface, 0.125_mm, kYoung, kPoisson, std::span(&base, 1));
    FAIL();
  }
  catch (const Error& error)
  {
    EXPECT_NE(std::string(error.what()).find("GB of memory"), std::string::npos) << error.what();
  }
}

} // namespace
} // namespace palp
