#include "pipeline/dent.h"
#include "pipeline/dent_patch.h"

#include "haptics/contact/contact.h"
#include "haptics/force/force_law.h"
#include "haptics/units.h"
#include "tests/pipeline/surfaces.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <random>
#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>

namespace palp
{
namespace
{

using namespace units::literals;
using test::DentedSurface;

DentedSurface read(const std::string& name)
{
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName((std::string(PALP_SHARE "/meshes/") + name).c_str());
  reader->Update();
  DentedSurface surface;
  for (vtkIdType i = 0; i < reader->GetOutput()->GetNumberOfPoints(); ++i)
  {
    Eigen::Vector3d point;
    reader->GetOutput()->GetPoint(i, point.data());
    surface.add(point.unaryExpr(&units::fromMillimetres));
  }
  vtkCellArray* polys = reader->GetOutput()->GetPolys();
  for (vtkIdType i = 0; i < polys->GetNumberOfCells(); ++i)
  {
    vtkIdType size = 0;
    const vtkIdType* ids = nullptr;
    polys->GetCellAtId(i, size, ids);
    surface.triangles.push_back(
      { static_cast<int>(ids[0]), static_cast<int>(ids[1]), static_cast<int>(ids[2]) });
  }
  surface.finish();
  return surface;
}

Surface hapticOf(const DentedSurface& surface)
{
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i < surface.count(); ++i)
  {
    points.push_back(DentedSurface::at(surface.rest, i));
  }
  return { points, surface.triangles };
}

enum class Of
{
  Liver,     // the bundled one, with its haptic mesh
  Lobe,      // a thin one made here
  Irregular, // triangles of all shapes on a body made here, as segmented images give
  Sheet,     // open, irregular, pressed up to its edge
};

// every point moved by up to a fifth of an edge
DentedSurface shaken(DentedSurface regular, double edge)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> by(-edge / 5.0, edge / 5.0);
  DentedSurface surface;
  for (std::size_t i = 0; i < regular.count(); ++i)
  {
    const Eigen::Vector3d point = DentedSurface::at(regular.rest, i);
    const Eigen::Vector3d normal = DentedSurface::at(regular.normals, i);
    const Eigen::Vector3d shift(by(random), by(random), by(random));
    surface.add(point + shift - 0.9 * shift.dot(normal) * normal);
  }
  surface.triangles = regular.triangles;
  surface.finish();
  return surface;
}

DentedSurface make(Of of)
{
  switch (of)
  {
    case Of::Liver:
      return read("liver.vtp");
    case Of::Lobe:
      return test::ellipsoid(6, { 60.0_mm, 40.0_mm, 6.0_mm });
    case Of::Irregular:
      return shaken(test::ellipsoid(6, { 80.0_mm, 60.0_mm, 35.0_mm }), 1.5_mm);
    case Of::Sheet:
      return shaken(test::plane(60, 1.5_mm), 1.5_mm);
  }
  return {};
}

struct Case
{
  const char* name;
  Of of;
};

class RandomPress : public ::testing::TestWithParam<Case>
{
protected:
  DentedSurface surface = make(GetParam().of);
  Surface haptic = hapticOf(GetParam().of == Of::Liver ? read("liver_haptic.vtp") : surface);
  std::vector<float> restNormals = surface.normals;
  std::mt19937 random{ 2024 };

  static bool isEdge(const Contact& contact)
  {
    return GetParam().of == Of::Lobe && std::abs(contact.normal.z()) < 0.7;
  }

  // a press at a random point: the tool tilted a little, at most 40 % of the local thickness deep;
  // if wanted not on a sharp edge, which no fitted surface follows
  Press next(int i, bool onEdges)
  {
    const std::array<Tip, 4> tips{ SphereTip{ 10.0_mm }, SphereTip{ 3.0_mm },
      ConeTip{ 45.0_deg, 10.0_mm }, ConeTip{ 60.0_deg, 6.0_mm } };
    std::uniform_int_distribution<std::size_t> vertex(0, surface.count() - 1);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (;;)
    {
      const std::size_t at = vertex(random);
      const Tip& tip = tips[static_cast<std::size_t>(i) % tips.size()];
      const Eigen::Vector3d normal = DentedSurface::at(restNormals, at);
      const double wanted = (0.1 + 0.5 * unit(random)) * baseRadius(tip);
      const Eigen::AngleAxisd tilt(0.25 * unit(random), normal.unitOrthogonal());
      const ToolPose pose{ .apex = DentedSurface::at(surface.rest, at) - wanted * normal,
        .axis = -(tilt * normal) };
      const Contact contact = findContact(haptic, tip, pose, ContactRule::Exact);
      if (!contact.touching() || contact.depth > 0.4 * contact.thickness ||
        contact.depth > 0.8 * baseRadius(tip) || contact.tilt > 30.0_deg ||
        (!onEdges && isEdge(contact)))
      {
        continue;
      }
      const ForceLaw law(tip, { .youngModulus = 50.0_kPa, .poissonRatio = 0.33 });
      const double r = law({ .depth = contact.depth }).contactRadius;
      return { .contact = contact,
        .pose = pose,
        .tip = tip,
        .contactRadius = r,
        .extentRadius = 3.7 * contact.depth };
    }
  }
};
INSTANTIATE_TEST_SUITE_P(Dent, RandomPress,
  ::testing::Values(Case{ "liver", Of::Liver }, Case{ "lobe", Of::Lobe },
    Case{ "irregular", Of::Irregular }, Case{ "sheet", Of::Sheet }),
  [](const auto& with) { return with.param.name; });

TEST_P(RandomPress, LeavesNoPointInsideTheToolAndTurnsNoTriangleOver)
{
  DentPatch patch;
  int presses = 0;
  double deepest = -1.0;
  std::size_t turned = 0;
  for (int i = 0; i < 200; ++i)
  {
    const Press press = next(i, true);
    surface.press(press);
    const PressRegion& region = surface.dent.region();
    ASSERT_FALSE(region.points().empty()) << "press " << i;
    ++presses;
    const ToolBody body(press.tip, press.pose);
    for (std::size_t k = 0; k < region.points().size(); ++k)
    {
      const auto at = static_cast<std::size_t>(region.points()[k]);
      deepest = std::max(deepest, body.inside(DentedSurface::at(surface.points, at)));
    }
    patch.build(surface.dent, DentPatch::levelFor(surface.dent));
    for (const Eigen::Vector3f& point : patch.points)
    {
      deepest = std::max(deepest, body.inside(point.cast<double>()));
    }
    for (const auto& [a, b, c] : region.triangles())
    {
      const auto area = [&](const std::vector<float>& of)
      {
        const auto corner = [&](int k)
        {
          return DentedSurface::at(
            of, static_cast<std::size_t>(region.points()[static_cast<std::size_t>(k)]));
        };
        return Eigen::Vector3d((corner(b) - corner(a)).cross(corner(c) - corner(a)));
      };
      // a displacement along the normal keeps the order of what faces it; the others may fold
      const bool isSide = area(surface.rest).dot(region.normal()) <= 0.0;
      const bool isTurned = isSide ? area(surface.points).dot(area(surface.rest)) <= 0.0
                                   : area(surface.points).dot(region.normal()) <= 0.0;
      turned += isTurned ? 1 : 0;
    }
  }
  RecordProperty("deepest_um", std::to_string(deepest / 1.0_um));
  EXPECT_EQ(presses, 200);
  EXPECT_LE(deepest, 1.0_um);
  EXPECT_EQ(turned, 0U);
}

// beyond the edge of a sheet there is no surface to be smooth on
class SmoothPress : public RandomPress
{
};
INSTANTIATE_TEST_SUITE_P(Dent, SmoothPress,
  ::testing::Values(
    Case{ "liver", Of::Liver }, Case{ "lobe", Of::Lobe }, Case{ "irregular", Of::Irregular }),
  [](const auto& with) { return with.param.name; });

// the displacement field itself, on the surface that was fitted around the contact
TEST_P(SmoothPress, IsContinuousAtRdAndSmoothAtTheContact)
{
  double step = 0.0;
  double kink = 0.0;
  for (int i = 0; i < 200; ++i)
  {
    const Press press = next(i, false);
    surface.press(press);
    const PressRegion& region = surface.dent.region();
    const PressField& field = surface.dent.field();
    for (int k = 0; k < PressField::kDirections; ++k)
    {
      const auto [p0, p1, p2] = field.controlPoints(k, region);
      const Eigen::Vector3d center = region.toSurface(Eigen::Vector3d::Zero());
      const Eigen::Vector3d across = p2 - center;
      const Eigen::Vector3d outwards =
        (across - across.dot(region.normal()) * region.normal()).normalized();
      const double inner =
        (p0 - center - (p0 - center).dot(region.normal()) * region.normal()).norm();
      const auto sinkAt = [&](double radius)
      {
        const Eigen::Vector3d foot = region.placeInFront(center + radius * outwards).local;
        const Eigen::Vector3d point =
          region.toSurface({ foot.x(), foot.y(), field.surfaceHeight(foot.x(), foot.y()) });
        const Place place = region.placeInFront(point);
        return place.distance < region.outer() ? surface.dent.sinkAt(place, point).depth : 0.0;
      };
      // where the way along the surface is as long as R_d
      double low = inner;
      double high = region.outer();
      for (int n = 0; n < 50; ++n)
      {
        const double middle = 0.5 * (low + high);
        (sinkAt(middle) > 0.0 ? low : high) = middle;
      }
      step = std::max(step, sinkAt(low));
      const double h = 3e-5 * inner; // the ring turns sharply where P1 is close to P0
      const double inside = (sinkAt(inner - h) - sinkAt(inner - 2.0 * h)) / h;
      const double outside = (sinkAt(inner + 2.0 * h) - sinkAt(inner + h)) / h;
      kink = std::max(kink, std::abs(std::atan(inside) - std::atan(outside)));
    }
  }
  RecordProperty("kink_deg", std::to_string(units::toDegrees(kink)));
  EXPECT_LE(step, 1.0_um);
  EXPECT_LE(kink, 2.0_deg);
}

} // namespace
} // namespace palp
