#include "pipeline/figure/other_hand.h"

#include "tests/pipeline/picture.h"
#include "tests/pipeline/view/press_pictures.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <gtest/gtest.h>
#include <limits>
#include <memory>
#include <utility>
#include <vector>
#include <vtkDataArray.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

namespace palp
{
namespace
{

using namespace test;
using namespace units::literals;

Specimen aside(Specimen body, double x)
{
  body.position.x() += x;
  return body;
}

struct HandsView : View
{
  explicit HandsView(const std::vector<Overlay>& overlays = { Overlay::DisplacementColors })
    : View(block(), kSphere)
    , other(*renderer, view)
  {
    view.setVisible(overlays);
    view.setLook({ .tool = ToolLook::Outlined });
  }

  vtkSmartPointer<vtkImageData> pictureOf(const Sample& first, const Sample* second)
  {
    other.show(first, second);
    lookAt(body);
    return imageOf(*window);
  }

  Specimen body = block();
  OtherHand other;
};

const double kApart = 24.0_mm;

Sample left(double x = kApart)
{
  return pressed(aside(block(), -x), kSphere, 3.0_mm);
}

Sample right(double x = kApart)
{
  return pressed(aside(block(), x), kSphere, 5.0_mm);
}

// a body that turns about a hinge below its left side, by a part of how deep a tool is
DentStyle hinged(vtkPolyData& surface)
{
  const Eigen::Vector3d hinge(-100.0_mm, 0.0, -50.0_mm);
  OrganMotionModes modes{ .radius = 30.0_mm };
  const vtkIdType count = surface.GetNumberOfPoints();
  modes.loads = Eigen::MatrixXf::Ones(1, count);
  modes.modes.resize(3 * count, 1);
  for (vtkIdType i = 0; i < count; ++i)
  {
    const Eigen::Vector3d place(surface.GetPoint(i));
    modes.places.push_back({ place, Eigen::Vector3d::UnitZ(), true });
    modes.modes.col(0).segment<3>(3 * i) =
      (1e4 * Eigen::Vector3d::UnitY().cross(place - hinge)).cast<float>();
  }
  DentStyle style;
  style.motion = std::make_shared<const OrganMotion>(modes);
  style.loads = [](const Sample& sample, double depth)
  {
    return std::vector{ OrganLoad{ .center = sample.contact.center,
      .normal = sample.contact.normal,
      .force = 0.4 * depth / (1e4 * 0.1), // as far from the hinge as the middle
      .given = 0.4 * depth } };
  };
  return style;
}

// of each point, as it is drawn
struct Moved
{
  explicit Moved(vtkPalpDeformFilter& press)
  {
    vtkPointData* data = press.GetOutput()->GetPointData();
    for (vtkIdType i = 0; i < press.GetOutput()->GetNumberOfPoints(); ++i)
    {
      by.emplace_back(data->GetArray("Displacement")->GetTuple3(i));
      isDented.push_back(data->GetArray("Zone")->GetTuple1(i) != 0.0);
    }
  }

  std::vector<Eigen::Vector3d> by; // [m]
  std::vector<bool> isDented;
};

// loads of one linear body: what each moves alone, together
TEST(OtherHand, BendsABodyByTheSumOfBothLoads)
{
  HandsView view{ std::vector<Overlay>{} };
  vtkPalpDeformFilter& press = view.view.press();
  view.view.setStyle(hinged(*vtkPolyData::SafeDownCast(press.GetInput())));
  const Sample one = left();
  const Sample two = right();
  view.other.show(one, nullptr);
  const Moved first(press);
  view.other.show(two, nullptr);
  const Moved second(press);
  view.other.show(one, &two);
  const Moved both(press);
  Sample lifted = one;
  lifted.contact = {};
  view.other.show(lifted, &two);
  const Moved last(press);
  double most = 0.0;
  for (std::size_t i = 0; i < both.by.size(); ++i)
  {
    EXPECT_LT((last.by[i] - second.by[i]).norm(), 1e-6) << i;
    if (!first.isDented[i] && !second.isDented[i])
    {
      EXPECT_LT((both.by[i] - first.by[i] - second.by[i]).norm(), 1e-6) << i;
      most = std::max(most, both.by[i].norm());
    }
  }
  EXPECT_GT(most, 2.0_mm);
  EXPECT_GT(std::ranges::count(both.isDented, true), std::ranges::count(first.isDented, true));
}

// nobody can tell which hand is the first: tools, dents and what their colors mean
TEST(OtherHand, IsSeenAsTheFirstWouldBe)
{
  for (const double x : { kApart, 12.0_mm }) // apart, and where the dents meet
  {
    HandsView view;
    const Sample one = left(x);
    const Sample two = right(x);
    const auto both = view.pictureOf(one, &two);
    HandsView swapped;
    const auto again = swapped.pictureOf(two, &one);
    const Difference difference = differenceOf(*both, *again);
    EXPECT_LT(difference.mean, 0.5) << x;
    EXPECT_LT(difference.changed, 0.005) << x;
    const auto alone = view.pictureOf(one, nullptr);
    EXPECT_GT(differenceOf(*both, *alone).changed, 0.02) << "its tool and dent are there";
  }
}

TEST(OtherHand, ThatLiftsOrGoesLeavesThePictureOfTheFirst)
{
  HandsView plain;
  const auto alone = plain.pictureOf(left(), nullptr);
  HandsView view;
  const Sample two = right();
  (void)view.pictureOf(left(), &two);
  EXPECT_NE(view.other.shown(), nullptr);
  EXPECT_EQ(differenceOf(*view.pictureOf(left(), nullptr), *alone).mean, 0.0);
  EXPECT_EQ(view.other.shown(), nullptr);
  Sample lifted = right();
  lifted.contact = {};
  lifted.pose.apex.setConstant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(differenceOf(*view.pictureOf(left(), &lifted), *alone).mean, 0.0);
}

TEST(OtherHand, OfAnotherOrganDentsNothingHere)
{
  HandsView view{ std::vector<Overlay>{} };
  Sample two = right();
  two.organ = 1;
  (void)view.pictureOf(left(), &two);
  EXPECT_TRUE(view.view.press().GetDent().deepened().empty());
  two.organ = 0;
  (void)view.pictureOf(left(), &two);
  EXPECT_FALSE(view.view.press().GetDent().deepened().empty());
}

} // namespace
} // namespace palp
