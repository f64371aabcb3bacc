#include "haptics/units.h"
#include "pipeline/charts/comparison.h"
#include "tests/pipeline/charts/columns.h"
#include "tests/pipeline/surfaces.h"

#include <cmath>
#include <gtest/gtest.h>
#include <vtkNew.h>
#include <vtkPlaneSource.h>
#include <vtkSphereSource.h>
#include <vtkTransform.h>
#include <vtkTransformPolyDataFilter.h>
#include <vtkTriangleFilter.h>

namespace palp
{
namespace
{

using namespace units::literals;
using test::column;

// a sphere in a plane, as if elements had found a hyperbola outside the contact
class PlaneSection : public ::testing::Test
{
protected:
  PlaneSection()
  {
    vtkNew<vtkPlaneSource> source;
    source->SetOrigin(-30.0_mm, -30.0_mm, 0.0);
    source->SetPoint1(30.0_mm, -30.0_mm, 0.0);
    source->SetPoint2(-30.0_mm, 30.0_mm, 0.0);
    source->SetResolution(60, 60);
    vtkNew<vtkTriangleFilter> triangles;
    triangles->SetInputConnection(source->GetOutputPort());
    filter->SetInputConnection(triangles->GetOutputPort());
    filter->GeneratePatchOn();
    filter->SetPatchLevel(2);
    filter->SetPress(press);
    plot = sectionPlot(*filter, Eigen::Vector3d(1.0, 0.05, 0.0), elements);
  }

  [[nodiscard]] std::vector<double> x(std::size_t curve) const
  {
    return column(*plot->tables().at(curve), 0);
  }
  [[nodiscard]] std::vector<double> height(std::size_t curve) const
  {
    return column(*plot->tables().at(curve), 1);
  }

  const Press press = test::pressAt(
    Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ(), SphereTip{ 10.0_mm }, 4.0_mm, 18.0_mm);
  const SurfaceProfile elements{ .inner = 7.0_mm,
    .outer = 40.0_mm,
    .sink = 2.0_mm,
    .slope = 0.5,
    .control = { 1.0_mm, 1.0_mm } };
  const double r = press.contactRadius;
  const double sink = 4.0_mm - tipHeight(press.tip, r);
  const double slope = tipSlope(press.tip, r);
  vtkNew<vtkPalpDeformFilter> filter;
  std::unique_ptr<Plot> plot;
};

TEST_F(PlaneSection, CutsAPlaneAlongTheCurveOfEquationEight)
{
  ASSERT_EQ(plot->tables().size(), 8U); // the curve and the elements on either side
  const RingCurve ring = makeRingCurve(r, sink, slope, 18.0_mm);
  const auto along = x(2);
  const auto z = height(2);
  EXPECT_GT(along.size(), 100U);
  for (std::size_t i = 0; i < along.size(); ++i)
  {
    const double radius = std::abs(units::fromMillimeters(along[i]));
    const double expected =
      radius < r ? 4.0_mm - tipHeight(press.tip, radius) : ring.sinkAt(radius);
    EXPECT_NEAR(units::fromMillimeters(z[i]), -expected, 10.0_um) << along[i];
  }
  for (const double atRest : height(1))
  {
    EXPECT_NEAR(atRest, 0.0, 1e-4);
  }
}

// Fig. 5(b): P0 on the tool, P1 where its tangent meets the surface, P2 at R_d
TEST_F(PlaneSection, MarksTheControlPointsOnEitherSide)
{
  const auto controlX = x(5);
  const auto controlZ = height(5);
  const std::vector<std::pair<double, double>> control{ { r, -sink }, { r + sink / slope, 0.0 },
    { 18.0_mm, 0.0 } };
  ASSERT_EQ(controlX.size(), 6U);
  for (std::size_t i = 0; i < 6; ++i)
  {
    const double side = i < 3 ? 1.0 : -1.0;
    EXPECT_NEAR(units::fromMillimeters(controlX[i]), side * control[i % 3].first, 10.0_um);
    EXPECT_NEAR(units::fromMillimeters(controlZ[i]), control[i % 3].second, 10.0_um);
  }
}

TEST_F(PlaneSection, LaysElementsBelowTheSurfaceAtRest)
{
  for (const std::size_t side : { 6U, 7U })
  {
    const auto radius = x(side);
    const auto z = height(side);
    EXPECT_GT(radius.size(), 20U);
    for (std::size_t i = 0; i < radius.size(); ++i)
    {
      const double at = std::abs(units::fromMillimeters(radius[i]));
      EXPECT_NEAR(units::fromMillimeters(z[i]), -elements.sinkAt(at), 1.0_um);
    }
  }
}

// Near the rim of a thin lobe the plane meets the body above and below the same place.
TEST(SectionPlot, RunsAroundTheRimOfALobe)
{
  constexpr double kWide = 20.0_mm;
  constexpr double kHalf = 4.0_mm;
  vtkNew<vtkSphereSource> ball;
  ball->SetRadius(1.0);
  ball->SetThetaResolution(121);
  ball->SetPhiResolution(121);
  vtkNew<vtkTransform> flat;
  flat->Scale(kWide, kWide, kHalf);
  vtkNew<vtkTransformPolyDataFilter> lobe;
  lobe->SetTransform(flat);
  lobe->SetInputConnection(ball->GetOutputPort());
  const double side = 15.0_mm;
  const Eigen::Vector3d position(side, 0.0, kHalf * std::sqrt(1.0 - std::pow(side / kWide, 2)));
  const Eigen::Vector3d up =
    Eigen::Vector3d(position.x() / (kWide * kWide), 0.0, position.z() / (kHalf * kHalf))
      .normalized();
  vtkNew<vtkPalpDeformFilter> filter;
  filter->SetInputConnection(lobe->GetOutputPort());
  filter->GeneratePatchOn();
  filter->SetPress(test::pressAt(position, up, SphereTip{ 6.0_mm }, 2.0_mm, 14.0_mm));
  filter->Update();

  const Eigen::Vector3d along = Eigen::Vector3d::UnitY().cross(up);
  const auto plot = sectionPlot(*filter, along);
  vtkTable& rest = *plot->tables()[1];
  const auto x = column(rest, 0);
  const auto z = column(rest, 1);
  ASSERT_GT(x.size(), 50U);
  double least = kWide; // [m]
  for (std::size_t i = 0; i < x.size(); ++i)
  {
    const Eigen::Vector3d at =
      position + units::fromMillimeters(x[i]) * along + units::fromMillimeters(z[i]) * up;
    EXPECT_NEAR(std::hypot(at.x() / kWide, at.z() / kHalf), 1.0, 0.01) << at.transpose();
    least = std::min(least, at.z());
    if (i > 0)
    {
      EXPECT_LT(std::hypot(x[i] - x[i - 1], z[i] - z[i - 1]), 2.0) << x[i]; // mm, as its triangles
    }
  }
  EXPECT_LT(least, 0.0); // the lower side is in the cut, too
}

// 3 mm beside the middle of one of 5 mm: a circle of 4
TEST_F(PlaneSection, HasNodulesThatTheCutMeets)
{
  const std::vector<PlacedNodule> nodules{
    { .center = { 0.0, 8.0_mm, -12.0_mm }, .radius = 5.0_mm, .ratio = 10.0 },
    { .center = { 5.0_mm, -3.0_mm, -12.0_mm }, .radius = 5.0_mm, .ratio = 10.0 },
  };
  const auto with = sectionPlot(*filter, Eigen::Vector3d(1.0, 0.05, 0.0), elements, nodules);
  ASSERT_EQ(with->tables().size(), plot->tables().size() + 1);
  vtkTable& circle = *with->tables().back();
  EXPECT_STREQ(circle.GetColumnName(1), "nodule, at rest");
  const auto along = column(circle, 0);
  const auto up = column(circle, 1);
  ASSERT_GT(along.size(), 50U);
  double lowest = 0.0;
  for (std::size_t i = 0; i < along.size(); ++i)
  {
    EXPECT_NEAR(std::hypot(along[i] - 5.0, up[i] + 12.0), 4.0, 1e-3);
    lowest = std::min(lowest, up[i]);
  }
  EXPECT_NEAR(lowest, -16.0, 0.01);
}

} // namespace
} // namespace palp
