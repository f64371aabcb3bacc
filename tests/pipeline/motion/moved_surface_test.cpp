#include "pipeline/motion/moved_surface.h"

#include "haptics/units.h"
#include "pipeline/deform/press_of.h"
#include "pipeline/deform/tool_body.h"
#include "pipeline/deform/vtkPalpDeformFilter.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <gtest/gtest.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSphereSource.h>

namespace palp
{
namespace
{

using namespace units::literals;
using Eigen::Vector3d;

constexpr double kMovedRadius = 50.0_mm;
const Tip kBall{ SphereTip{ 10.0_mm } };
const Vector3d kHinge(-60.0_mm, 0.0, 0.0);

// a stiff ball that turns about a hinge at its side, by every load that presses it down
Vector3d turnedBy(const Vector3d& place)
{
  return 1e4 * Vector3d::UnitY().cross(place - kHinge);
}

std::shared_ptr<const OrganMotion> hinged()
{
  OrganMotionModes modes{ .radius = 40.0_mm };
  constexpr int kPlaces = 400;
  modes.loads = Eigen::MatrixXf::Ones(1, kPlaces);
  modes.modes.resize(3L * kPlaces, 1);
  for (int i = 0; i < kPlaces; ++i)
  {
    // by the golden angle
    const double up = 1.0 - (2.0 * i + 1.0) / kPlaces;
    const double angle = 2.399963229728653 * i;
    const double wide = std::sqrt(1.0 - up * up);
    const Vector3d normal(wide * std::cos(angle), wide * std::sin(angle), up);
    modes.places.push_back({ kMovedRadius * normal, normal, true });
    modes.modes.col(0).segment<3>(3L * i) = turnedBy(kMovedRadius * normal).cast<float>();
  }
  return std::make_shared<const OrganMotion>(modes);
}

Sample pressedTo(double depth)
{
  Sample sample;
  sample.pose = { .apex = { 0.0, 0.0, kMovedRadius - depth }, .axis = -Vector3d::UnitZ() };
  sample.contact.depth = depth;
  sample.contact.center = { 0.0, 0.0, kMovedRadius };
  sample.contact.normal = Vector3d::UnitZ();
  sample.response.contactRadius = std::sqrt(8.0_mm * depth);
  return sample;
}

Vector3d vectorAt(vtkDataArray* array, vtkIdType i)
{
  return Vector3d(array->GetTuple3(i));
}

class HingedBall : public testing::Test
{
protected:
  void SetUp() override
  {
    source_->SetRadius(kMovedRadius);
    source_->SetThetaResolution(120);
    source_->SetPhiResolution(90);
    style_.motion = hinged();
    filter_->SetInputConnection(source_->GetOutputPort());
    filter_->GeneratePatchOn();
  }

  // turned down by as much at the top, the rest is its dent
  void press(double depth, double down, const std::vector<OrganLoad>& others = {})
  {
    style_.loads = [=](const Sample& sample, double)
    {
      const double force = down / turnedBy(sample.contact.center).norm();
      const double wide = 8.0 / (3.0 * std::numbers::pi * 40.0_mm) * force;
      const double level = -turnedBy(sample.contact.center).z() * force;
      std::vector<OrganLoad> loads{ { sample.contact.center, sample.contact.normal, force,
        level - wide } };
      loads.insert(loads.end(), others.begin(), others.end());
      return loads;
    };
    sample_ = pressedTo(depth);
    filter_->SetPress(pressOf(sample_, kBall, 15.0_mm, style_));
    filter_->Update();
    output_ = filter_->GetOutput();
  }

  // how far the drawn surface is in the tool at most; less than 0: it does not touch [m]
  [[nodiscard]] double deepestInTool(vtkPolyData& surface) const
  {
    const ToolBody tool(kBall, sample_.pose);
    double deepest = -1.0;
    for (vtkIdType i = 0; i < surface.GetNumberOfPoints(); ++i)
    {
      deepest = std::max(deepest, tool.inside(Vector3d(surface.GetPoint(i))));
    }
    return deepest;
  }

  vtkNew<vtkSphereSource> source_;
  vtkNew<vtkPalpDeformFilter> filter_;
  vtkPolyData* output_ = nullptr;
  DentStyle style_;
  Sample sample_;
};

TEST_F(HingedBall, GoesAlongEverywhereAndSaysSo)
{
  press(6.0_mm, 4.0_mm);
  const double force = 4.0_mm / turnedBy({ 0.0, 0.0, kMovedRadius }).norm();
  vtkPolyData* rest = source_->GetOutput();
  vtkDataArray* moved = output_->GetPointData()->GetArray("Displacement");
  vtkDataArray* zone = output_->GetPointData()->GetArray("Zone");
  int far = 0;
  for (vtkIdType i = 0; i < rest->GetNumberOfPoints(); ++i)
  {
    const Vector3d from(rest->GetPoint(i));
    EXPECT_LT((Vector3d(output_->GetPoint(i)) - from - vectorAt(moved, i)).norm(), 1e-7);
    if (zone->GetTuple1(i) == 0.0)
    {
      ++far;
      EXPECT_LT((vectorAt(moved, i) - force * turnedBy(from)).norm(), 0.02 * 4.0_mm);
      // a rigid turn takes normals along
      const Vector3d normal = from / kMovedRadius;
      const Vector3d turned = normal + force * 1e4 * Vector3d::UnitY().cross(normal);
      EXPECT_LT(
        (vectorAt(output_->GetPointData()->GetNormals(), i) - turned.normalized()).norm(), 0.02);
    }
  }
  EXPECT_GT(far, rest->GetNumberOfPoints() / 2);
  EXPECT_EQ(output_->GetFieldData()->GetArray("TouchedPoints")->GetNumberOfTuples(),
    rest->GetNumberOfPoints());
}

// the tool is where the hand is, the surface around it on the tool
TEST_F(HingedBall, TheToolStillTouchesItAndNoMore)
{
  for (const double down : { 1.0_mm, 4.0_mm, 5.5_mm })
  {
    press(6.0_mm, down);
    for (vtkPolyData* surface :
      { output_, vtkPolyData::SafeDownCast(filter_->GetOutputDataObject(1)) })
    {
      const double deepest = deepestInTool(*surface);
      EXPECT_LT(deepest, 0.1_mm) << down;
      EXPECT_GT(deepest, -0.1_mm) << down;
    }
  }
}

// no gap between the surface and the finer dent
TEST_F(HingedBall, TheFinerDentEndsOnTheSurface)
{
  press(6.0_mm, 4.0_mm);
  auto* patch = vtkPolyData::SafeDownCast(filter_->GetOutputDataObject(1));
  const auto points = filter_->GetDent().region().points();
  ASSERT_GT(points.size(), 100U);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const Vector3d on(patch->GetPoint(static_cast<vtkIdType>(i)));
    EXPECT_LT((on - Vector3d(output_->GetPoint(points[i]))).norm(), 1e-7);
  }
}

// another tool that turns the ball farther leaves this one less of a dent
TEST_F(HingedBall, TwoToolsActOnEachOther)
{
  press(6.0_mm, 2.0_mm);
  const double alone = filter_->GetPress().contact.depth;
  const OrganLoad other{ .center = { 0.0, kMovedRadius, 0.0 },
    .normal = Vector3d::UnitY(),
    .force = 1.0_mm / turnedBy({ 0.0, 0.0, kMovedRadius }).norm() };
  press(6.0_mm, 2.0_mm, { other });
  const double down = -turnedBy({ 0.0, 0.0, kMovedRadius }).z() * other.force;
  EXPECT_NEAR(filter_->GetPress().contact.depth, alone - down, 0.05_mm);
  EXPECT_LT(deepestInTool(*output_), 0.1_mm);
  EXPECT_GT(deepestInTool(*output_), -0.1_mm);
}

TEST_F(HingedBall, ComesBackToRestAsTheToolIsLifted)
{
  press(6.0_mm, 4.0_mm);
  filter_->SetPress(pressOf(Sample{}, kBall, 15.0_mm, style_));
  filter_->Update();
  for (vtkIdType i = 0; i < output_->GetNumberOfPoints(); ++i)
  {
    EXPECT_EQ(
      Vector3d(filter_->GetOutput()->GetPoint(i)), Vector3d(source_->GetOutput()->GetPoint(i)));
  }
}

} // namespace
} // namespace palp
