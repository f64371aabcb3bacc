#include "pipeline/color/even_map.h"
#include "pipeline/view/appearance.h"
#include "tests/app/plots/figure_rig.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>

namespace palp
{
namespace
{

using test::PressFigure;

// of a map, whatever tool is in use by now
TEST_F(PressFigure, CaptionOfAMapTellsWhatItWasPressedBy)
{
  const SurfaceMap map{ .origin = "stiffness by cone:45deg:10mm, 2 mm deep" };
  moment_.map = &map;
  const std::string pressed = captionOf(moment_);
  EXPECT_EQ(pressed.find("ball, stiffness by cone:45deg:10mm, 2 mm deep\npressed by sphere"), 0U);
  const Sample apart;
  const PressMoment seen{ body_, law_, calibration_, apart, &map };
  EXPECT_EQ(captionOf(seen), "ball, stiffness by cone:45deg:10mm, 2 mm deep");
}

// in each light, where the body faces the eye; elsewhere darker, and nothing else
TEST_F(PressFigure, ColorsOfAMapAreThoseOfItsBar)
{
  vtkNew<vtkFloatArray> values;
  values->SetName("Stiffness");
  values->SetNumberOfValues(ball_.surface->GetNumberOfPoints());
  values->FillValue(0.5F);
  const SurfaceMap map{ .values = values.Get(), .title = "stiffness", .low = 0.0, .high = 1.0 };
  moment_.map = &map;
  const auto middle = color::evenMap(appearance::kLeast, 0.5); // of a bar from 0 to 1
  const Eigen::Vector3d expected = 255.0 * Eigen::Vector3d(middle[0], middle[1], middle[2]);
  for (const bool isRealistic : { false, true })
  {
    const auto image = figure({ .isRealistic = isRealistic });
    const auto pixel = [&](int x, int y)
    {
      return Eigen::Vector3d(image->GetScalarComponentAsDouble(x, y, 0, 0),
        image->GetScalarComponentAsDouble(x, y, 0, 1),
        image->GetScalarComponentAsDouble(x, y, 0, 2));
    };
    double onBar = HUGE_VAL; // how far the bar is off the color, at least
    for (int y = 0; y < 360; ++y)
    {
      for (int x = 400; x < 480; ++x)
      {
        onBar = std::min(onBar, (pixel(x, y) - expected).cwiseAbs().maxCoeff());
      }
    }
    EXPECT_LE(onBar, 2.0);
    double nearest = HUGE_VAL;
    for (int y = 100; y < 180; ++y) // front of the ball
    {
      for (int x = 140; x < 260; ++x)
      {
        const Eigen::Vector3d seen = pixel(x, y);
        const double share = seen.dot(expected) / expected.squaredNorm();
        nearest = std::min(nearest, std::abs(share - 1.0));
        EXPECT_GT(share, 0.6) << isRealistic << ' ' << x << ' ' << y;
        EXPECT_LT((seen - share * expected).cwiseAbs().maxCoeff(), 12.0)
          << isRealistic << ' ' << x << ' ' << y;
      }
    }
    EXPECT_LT(nearest, 0.05) << isRealistic;
  }
}

} // namespace
} // namespace palp
