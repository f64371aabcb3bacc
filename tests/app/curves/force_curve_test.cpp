#include "app/curves/force_curve.h"

#include "haptics/error.h"
#include "tests/support/csv_table.h"

#include <gtest/gtest.h>

namespace palp
{
namespace
{

TEST(ForceCurve, IsReadHoweverItsLinesEnd)
{
  for (const char* end : { "\n", "\r\n" })
  {
    const std::string e = end;
    const ReferenceCurve curve = readForceCurve(
      test::writtenCsv("# mine" + e + "depth_mm,force_N" + e + "1,0.25" + e + "4,2" + e));
    EXPECT_EQ(curve.name, "table"); // as its file
    EXPECT_EQ(curve.x, (std::vector<double>{ 0.001, 0.004 }));
    EXPECT_EQ(curve.y, (std::vector<double>{ 0.25, 2.0 }));
  }
}

TEST(ForceCurve, IsRefusedWithoutItsHeader)
{
  try
  {
    (void)readForceCurve(test::writtenCsv("1,0.25\n4,2\n"));
    ADD_FAILURE() << "accepted";
  }
  catch (const Error& error)
  {
    EXPECT_EQ(error.code(), ErrorCode::BadFile);
    EXPECT_NE(std::string(error.what()).find("no column depth_mm"), std::string::npos);
  }
}

TEST(ForceCurve, IsFoundByItsColumnsAmongOthers)
{
  // the header of `palp force`
  const ReferenceCurve curve = readForceCurve(test::writtenCsv(
    "depth_mm,force_N,contact_radius_mm,stiffness_N_per_mm\n0,0,0,0\n2,0.5,4,0.3\n1,0.2,3,0.2\n"));
  EXPECT_EQ(curve.x, (std::vector<double>{ 0.0, 0.002, 0.001 }));
  EXPECT_EQ(curve.y, (std::vector<double>{ 0.0, 0.5, 0.2 }));
}

TEST(ForceCurve, IsFoundBesideWordsBlanksAndQuotes)
{
  for (const char* text : { "specimen,depth_mm,force_N\nliver A,1,0.25\n\"fat, skin\",4,2\n",
         "\"depth_mm\",\"force_N\"\n\"1\",0.25\n4,2\n", "depth_mm, force_N\n 1 ,\t0.25\n4, 2\n",
         "hand,depth_mm,force_N\nleft,1,0.25\nright,4,2\n",
         "depth_mm,force_N,hand\n1,0.25,2\n4,2,1\n" })
  {
    const ReferenceCurve curve = readForceCurve(test::writtenCsv(text));
    EXPECT_EQ(curve.x, (std::vector<double>{ 0.001, 0.004 })) << text;
    EXPECT_EQ(curve.y, (std::vector<double>{ 0.25, 2.0 })) << text;
  }
  EXPECT_THROW((void)readForceCurve(test::writtenCsv("depth_mm,force_N\n1,deep\n")), Error);
}

TEST(ForceCurve, OfARecordingIsItsLoadingPart)
{
  const ReferenceCurve curve = readForceCurve(test::writtenCsv(
    "time_s,force_N,depth_mm\n0,0,0\n1,0,0\n2,0.2,1\n3,0.5,2\n4,0.4,2\n5,0.1,1\n6,0,0\n"));
  EXPECT_EQ(curve.x, (std::vector<double>{ 0.0, 0.001, 0.002 }));
  EXPECT_EQ(curve.y, (std::vector<double>{ 0.0, 0.2, 0.5 }));
}

TEST(ForceCurve, WithoutARowIsRefused)
{
  EXPECT_THROW((void)readForceCurve(test::writtenCsv("depth_mm,force_N\n")), Error);
  EXPECT_THROW((void)readForceCurve(test::writtenCsv("")), Error);
}

} // namespace
} // namespace palp
