#include "calibration/study/mesh_check.h"
#include "tests/calibration/indentation_case.h"
#include <cstdio>
namespace palp::fem
{
namespace
{
TEST(X, Y)
{
  struct T
  {
    const char* n;
    Tip tip;
    double deepest;
  };
  const T tools[] = { { "cone30", withCap(ConeTip{ 30.0_deg, 8.0_mm }, 0.3_mm), 2.0_mm },
    { "cone20", withCap(ConeTip{ 20.0_deg, 8.0_mm }, 0.3_mm), 2.0_mm },
    { "cone45", withCap(ConeTip{ 45.0_deg, 8.0_mm }, 0.3_mm), 2.0_mm },
    { "cone60", withCap(ConeTip{ 60.0_deg, 8.0_mm }, 0.3_mm), 2.0_mm },
    { "sphere4", SphereTip{ 4.0_mm }, 2.0_mm },
    { "trunc30", withCap(TruncatedConeTip{ 30.0_deg, 1.0_mm, 8.0_mm }, 0.3_mm), 2.0_mm } };
  for (const T& t : tools)
    for (double nu : { 0.0, 0.33, 0.49 })
    {
      std::vector<std::vector<IndentationStep>> all;
      for (double h : { 0.4_mm, 0.2_mm, 0.1_mm, 0.05_mm })
      {
        Case study{ .name = "x",
          .width = 60.0_mm,
          .length = 60.0_mm,
          .height = 30.0_mm,
          .tip = t.tip,
          .material = { 50.0_kPa, nu },
          .depths = depthRange(0.25 * t.deepest, t.deepest, 0.25 * t.deepest),
          .elementSize = h };
        try
        {
          all.push_back(calibrate(study).steps);
        }
        catch (const std::exception& e)
        {
          printf("%s %g h %g: %s\n", t.n, nu, h, e.what());
          all.push_back({});
        }
      }
      for (std::size_t i = 0; i < 4; ++i)
      {
        printf(
          "%-8s nu %.2f d %.2f:", t.n, nu, 0.25 * t.deepest * static_cast<double>(i + 1) * 1e3);
        for (std::size_t k = 0; k + 1 < all.size(); ++k)
          if (all[k].size() > i && all[k + 1].size() > i)
            printf("  h%.2f a/h %.1f change %+.4f", 0.4 / static_cast<double>(1 << k),
              all[k][i].contactRadius / (0.4e-3 / static_cast<double>(1 << k)),
              all[k + 1][i].force / all[k][i].force - 1.0);
        printf("\n");
        fflush(stdout);
      }
    }
}
}
}
