#include "calibration/organ/cubes/cut_grid.h"
#include "data/shapes.h"
#include "haptics/units.h"

#include <gtest/gtest.h>

namespace palp
{
namespace
{

using namespace units::literals;

// second moments about the middle, which a plate bends by
TEST(CutGrid, HoldsTheSecondMomentOfAPlateThatItsCubesDoNotDivide)
{
  const double side = 6.0_mm;
  for (const double height : { 13.0_mm, 14.0_mm, 16.0_mm, 20.0_mm })
  {
    const Mesh plate = makeBox({ 25.0_mm, 31.0_mm, height }, 5.0_mm);
    const CutGrid grid({ plate.points, plate.triangles }, side);
    double sum = 0.0;
    const Cube& size = grid.size();
    for (int cube = 0; cube < size[0] * size[1] * size[2]; ++cube)
    {
      const int layer = cube / (size[0] * size[1]);
      const CubePoints& points = grid.inside({ cube % size[0], cube / size[0] % size[1], layer });
      for (std::size_t i = 0; i < CubePoints::size(); ++i)
      {
        const double z = side * (layer + static_cast<double>(points.middle[i].z())) - 0.5 * height;
        sum += static_cast<double>(points.part[i]) * z * z * side * side * side / 64.0;
      }
    }
    const double moment = 25.0_mm * 31.0_mm * height * height * height / 12.0;
    EXPECT_NEAR(sum, moment, 0.015 * moment) << height;
  }
}

} // namespace
} // namespace palp
