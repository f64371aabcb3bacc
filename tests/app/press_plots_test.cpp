#include "app/press_plots.h"

#include "haptics/error.h"
#include "tests/support/csv_table.h"

#include <gtest/gtest.h>

namespace palp
{
namespace
{

TEST(PressPlots, ReadACurveHoweverItsLinesEnd)
{
  for (const char* end : { "\n", "\r\n" })
  {
    const std::string e = end;
    const ReferenceCurve curve = readForceCurve(
      test::writtenCsv("# mine" + e + "depth_mm,force_N" + e + "1,0.25" + e + "4,2" + e));
    EXPECT_EQ(curve.name, "ReadACurveHoweverItsLinesEnd");
    EXPECT_EQ(curve.x, (std::vector<double>{ 0.001, 0.004 }));
    EXPECT_EQ(curve.y, (std::vector<double>{ 0.25, 2.0 }));
  }
}

TEST(PressPlots, RefuseACurveWithoutItsHeader)
{
  try
  {
    (void)readForceCurve(test::writtenCsv("1,0.25\n4,2\n"));
    ADD_FAILURE() << "accepted";
  }
  catch (const Error& error)
  {
    EXPECT_EQ(error.code(), ErrorCode::BadFile);
    EXPECT_NE(std::string(error.what()).find("begin with depth_mm,force_N"), std::string::npos);
  }
}

} // namespace
} // namespace palp
