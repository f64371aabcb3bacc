#include "tests/calibration/organ/body_scene.h"

// Tops so narrow that the edges on both sides of a place count.

namespace palp
{
namespace
{

using namespace units::literals;
using Eigen::Vector3d;
using test::at;

// stands 20 mm high on the middle of a slab of 100 x 100 x 30 mm, bonded below; its top at z = 0
struct Ridge
{
  const char* name;
  double width;          // along x [m]
  double length;         // along y [m]
  double force;          // 5 mm deep in its middle, by elements of 0.8 mm [N]
  double limit;          // of the force [-]
  std::vector<double> y; // where it is pressed [m]
};

Mesh meshOf(const Ridge& ridge)
{
  const auto across = [](double width)
  {
    return width < 100.0_mm
      ? test::divided({ -50.0_mm, -0.5 * width, 0.5 * width, 50.0_mm }, 4.0_mm)
      : test::divided({ -50.0_mm, 50.0_mm }, 4.0_mm);
  };
  const std::array planes{ across(ridge.width), across(ridge.length),
    test::divided({ -50.0_mm, -20.0_mm, 0.0 }, 4.0_mm) };
  const auto middle = [&](std::size_t axis, int cell)
  { return 0.5 * (planes.at(axis)[palp::at(cell)] + planes.at(axis)[palp::at(cell + 1)]); };
  return test::cells(planes,
    [&](const std::array<int, 3>& cell)
    {
      return middle(2, cell[2]) < -20.0_mm ||
        (std::abs(middle(0, cell[0])) < 0.5 * ridge.width &&
          std::abs(middle(1, cell[1])) < 0.5 * ridge.length);
    });
}

class OrganRidge : public testing::TestWithParam<Ridge>
{
};

// Elements with contact, by a program of another hand (B-bar, sides of 1 and 0.8 mm, which agree to
// 0.2 %). A tool that presses in the plane of symmetry is pushed nowhere.
TEST_P(OrganRidge, IsFeltAsByFiniteElementsAllAlongItsMiddle)
{
  const Ridge& ridge = GetParam();
  Scene scene = test::halfSpace(meshOf(ridge), SphereTip{ 10.0_mm });
  const test::Held held{ .support{ [](const Vector3d& x) { return x.z() < -49.9_mm; } } };
  test::addOrgan(scene, held, Vector3d::Zero(), 34.0_mm);
  for (const double y : ridge.y)
  {
    const Sample felt = step(scene, at(0.0, 5.0_mm, y));
    EXPECT_NEAR(felt.response.force, ridge.force, ridge.limit * ridge.force) << y;
    EXPECT_LT(std::abs(felt.force.x()), 0.05 * ridge.force) << y;
  }
}

INSTANTIATE_TEST_SUITE_P(Tops, OrganRidge,
  testing::Values(
    Ridge{ "Wall17", 17.0_mm, 100.0_mm, 2.286, 0.05,
      { -18.0_mm, -13.0_mm, -7.0_mm, -2.0_mm, 0.0, 3.0_mm, 8.0_mm, 12.0_mm, 17.0_mm } },
    Ridge{ "Wall20", 20.0_mm, 100.0_mm, 2.489, 0.05,
      { -18.0_mm, -13.0_mm, -7.0_mm, -2.0_mm, 0.0, 3.0_mm, 8.0_mm, 12.0_mm, 17.0_mm } },
    Ridge{ "Post20", 20.0_mm, 20.0_mm, 2.002, 0.08, { 0.0 } }),
  [](const auto& ridge) { return ridge.param.name; });

} // namespace
} // namespace palp
