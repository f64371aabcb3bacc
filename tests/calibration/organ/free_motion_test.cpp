#include "calibration/organ/organ_model.h"
#include "data/shapes.h"
#include "haptics/error.h"
#include "haptics/units.h"

#include <gtest/gtest.h>
#include <span>
#include <string>

namespace palp
{
namespace
{

using namespace units::literals;
using Eigen::Vector3d;

constexpr double kFreeYoung = 50e3;
constexpr double kFreePoisson = 0.45;

TEST(OrganModel, NamesAMotionThatItsSupportsLeaveFree)
{
  const Mesh box = makeBox({ 20.0_mm, 20.0_mm, 20.0_mm }, 5.0_mm);
  const auto refused = [&](const Mesh& mesh, double cell, const Support& support) -> std::string
  {
    try
    {
      const OrganModel model(
        { mesh.points, mesh.triangles }, cell, kFreeYoung, kFreePoisson, std::span(&support, 1));
    }
    catch (const Error& error)
    {
      return error.what();
    }
    return "";
  };
  const auto isBase = [](const Vector3d& x) { return x.z() < -19.9_mm; };
  const Support slides{ isBase, Vector3d::UnitZ() };
  EXPECT_NE(refused(box, 5.0_mm, slides).find("free to move along x, y and turn about z;"),
    std::string::npos)
    << refused(box, 5.0_mm, slides);
  // about the line that is held, wherever that is
  const Support hinge{ [&](const Vector3d& x) { return isBase(x) && x.y() > 8.9_mm; } };
  EXPECT_NE(refused(box, 5.0_mm, hinge).find("free to turn about x;"), std::string::npos)
    << refused(box, 5.0_mm, hinge);
  // by cells as large as the body a whole face is one place
  EXPECT_NE(refused(box, 20.0_mm, Support{ isBase }).find("in 1 cell, leave the body free to turn"),
    std::string::npos)
    << refused(box, 20.0_mm, Support{ isBase });
  EXPECT_EQ(refused(box, 5.0_mm, Support{ isBase }), "");
  Mesh two = box;
  for (const Vector3d& point : makeBox({ 10.0_mm, 10.0_mm, 10.0_mm }, 5.0_mm).points)
  {
    two.points.push_back(point + Vector3d(0.0, 0.0, -30.0_mm));
  }
  for (const Triangle& triangle : makeBox({ 10.0_mm, 10.0_mm, 10.0_mm }, 5.0_mm).triangles)
  {
    const int first = static_cast<int>(box.points.size());
    two.triangles.push_back({ triangle[0] + first, triangle[1] + first, triangle[2] + first });
  }
  const Support other{ [](const Vector3d& x) { return x.z() < -39.0_mm; } };
  EXPECT_NE(refused(two, 5.0_mm, other).find("on a piece of it"), std::string::npos)
    << refused(two, 5.0_mm, other);
}

} // namespace
} // namespace palp
