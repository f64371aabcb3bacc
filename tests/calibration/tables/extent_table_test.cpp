#include "calibration/tables/extent_table.h"

#include "haptics/error.h"
#include "haptics/units.h"
#include "tests/haptics/force/reference_table.h"
#include "tests/support/csv_table.h"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <limits>

namespace palp
{
namespace
{

using namespace units::literals;
using Extent = ExtentTable::Extent;

// the message of the error that reading the text gives; empty when it can be read
std::string refusal(const std::string& text)
{
  try
  {
    (void)ExtentTable::read(test::writtenCsv(text));
  }
  catch (const Error& error)
  {
    EXPECT_EQ(error.code(), ErrorCode::BadFile);
    return error.what();
  }
  return {};
}

constexpr auto kHeader = "# how it was made\ndepth_mm,extent_radius_mm,force_N,contact_radius_mm\n";

TEST(ExtentTable, ReadsMillimetersAsMeters)
{
  const auto table =
    ExtentTable::read(test::writtenCsv(kHeader + std::string("1,3,0.25,2\n2,7,0.5,4\n")));
  ASSERT_EQ(table.rows().size(), 2U);
  EXPECT_DOUBLE_EQ(table.rows()[1].depth, 2.0_mm);
  EXPECT_DOUBLE_EQ(table.rows()[1].extentRadius, 7.0_mm);
  EXPECT_DOUBLE_EQ(table.rows()[1].force, 0.5);
  EXPECT_DOUBLE_EQ(table.rows()[1].contactRadius, 4.0_mm);
}

TEST(ExtentTable, IsLinearBetweenRowsAndConstantBeyond)
{
  const ExtentTable table({ Extent{ 1.0_mm, 3.0_mm, 0, 0 }, Extent{ 2.0_mm, 7.0_mm, 0, 0 } });
  EXPECT_DOUBLE_EQ(table.extentRadius(0.5_mm), 1.5_mm); // on the line to (0, 0)
  EXPECT_DOUBLE_EQ(table.extentRadius(1.25_mm), 4.0_mm);
  EXPECT_DOUBLE_EQ(table.extentRadius(2.0_mm), 7.0_mm);
  EXPECT_DOUBLE_EQ(table.extentRadius(1.0), 7.0_mm);
}

TEST(ExtentTable, IsZeroOutOfContact)
{
  const ExtentTable table({ Extent{ 1.0_mm, 3.0_mm, 0, 0 }, Extent{ 2.0_mm, 7.0_mm, 0, 0 } });
  EXPECT_EQ(table.extentRadius(0.0), 0.0);
  EXPECT_EQ(table.extentRadius(-1.0_mm), 0.0);
  EXPECT_EQ(table.extentRadius(std::numeric_limits<double>::quiet_NaN()), 0.0);
}

TEST(ExtentTable, RefusesBadFilesAndNamesTheLine)
{
  EXPECT_NE(
    refusal(kHeader + std::string("1,3,0.25,2\n2,seven,0.5,4\n")).find(":4:"), std::string::npos);
  EXPECT_NE(refusal(kHeader + std::string("1,3,0.25,2\n1,7,0.5,4\n")).find("increasing"),
    std::string::npos);
  EXPECT_NE(refusal(kHeader + std::string("1,3,0.25\n")).find(":3:"), std::string::npos);
  EXPECT_NE(refusal(kHeader + std::string("1,3,0.25,2\n")).find("two rows"), std::string::npos);
  EXPECT_NE(refusal("").find("two rows"), std::string::npos);
}

// the first row of numbers must not be taken for the names of the columns
TEST(ExtentTable, RefusesAFileWithoutItsHeader)
{
  EXPECT_NE(refusal("1,3,0.25,2\n2,7,0.5,4\n3,9,0.7,5\n").find(":1:"), std::string::npos);
  EXPECT_NE(refusal("depth_m,extent_radius_m,force_N,contact_radius_m\n1,3,0.25,2\n2,7,0.5,4\n")
              .find("depth_mm,extent_radius_mm,force_N,contact_radius_mm"),
    std::string::npos);
}

TEST(ExtentTable, ReadsLinesAsWindowsEndsThem)
{
  const auto table = ExtentTable::read(test::writtenCsv(
    "depth_mm,extent_radius_mm,force_N,contact_radius_mm\r\n1,3,0.25,2\r\n2,7,0.5,4\r\n"));
  ASSERT_EQ(table.rows().size(), 2U);
  EXPECT_DOUBLE_EQ(table.rows()[1].contactRadius, 4.0_mm);
}

TEST(ExtentTable, RefusesWhatIsNotFinite)
{
  EXPECT_NE(
    refusal(kHeader + std::string("1,3,0.25,2\n2,7,nan,4\n")).find(":4:"), std::string::npos);
  EXPECT_NE(
    refusal(kHeader + std::string("1,3,0.25,2\n2,inf,0.5,4\n")).find(":4:"), std::string::npos);
}

TEST(ExtentTable, RefusesWhatItCannotOpen)
{
  EXPECT_THROW((void)ExtentTable::read("no/such/table.csv"), Error);
}

TEST(ExtentTable, RefusesValuesThatAreNoTable)
{
  EXPECT_THROW(ExtentTable({ Extent{ 1.0_mm, 3.0_mm, 0, 0 } }), Error);
  EXPECT_THROW(
    ExtentTable({ Extent{ 2.0_mm, 3.0_mm, 0, 0 }, Extent{ 1.0_mm, 7.0_mm, 0, 0 } }), Error);
  EXPECT_THROW(ExtentTable({ Extent{ 0.0, 3.0_mm, 0, 0 }, Extent{ 1.0_mm, 7.0_mm, 0, 0 } }), Error);
}

struct Shipped
{
  const char* file;
  const char* reference;
};

class ShippedTable : public testing::TestWithParam<Shipped>
{
protected:
  static ExtentTable table()
  {
    return ExtentTable::read(
      std::filesystem::path(PALP_SOURCE_DIR) / "data/tables" / GetParam().file);
  }
};
INSTANTIATE_TEST_SUITE_P(ExtentTable, ShippedTable,
  testing::Values(Shipped{ "sphere_r10_h50.csv", "calib_sphere_R10__NH_h0.5" },
    Shipped{ "sphere_r6_h30.csv", "fig15_sphere_R6__NH_h0.25" },
    Shipped{ "cone45_r10_h50.csv", "calib_cone45__NH_h0.5" },
    Shipped{ "cone45_r6_h30.csv", "fig15_cone45__NH_h0.5" }));

// force within 3 % (5 % to 1 mm), R_d within the larger of 0.3 mm and 4 % (6 % beyond 6 mm)
TEST_P(ShippedTable, AgreesWithAnIndependentProgram)
{
  const auto rows = table().rows();
  const auto reference = test::referenceTable(GetParam().reference);
  ASSERT_GE(reference.size(), 10U);
  for (std::size_t i = 0; i < std::min(rows.size(), reference.size()); ++i)
  {
    ASSERT_NEAR(rows[i].depth, reference[i].number("delta_m"), 1e-9);
    const double force = reference[i].number("F_N");
    EXPECT_NEAR(rows[i].force, force, (rows[i].depth < 1.01_mm ? 0.05 : 0.03) * force);
    const double extent = reference[i].number("Rd05_def_m");
    const double fraction = rows[i].depth < 6.01_mm ? 0.04 : 0.06;
    EXPECT_NEAR(rows[i].extentRadius, extent, std::max(0.3_mm, fraction * extent));
    // the reference counts whole elements
    EXPECT_NEAR(rows[i].contactRadius, reference[i].number("a_def_m"), 0.3_mm);
  }
}

// deeper is wider; nothing sinks by 0.5 mm before the tool does; the contact lies inside
TEST_P(ShippedTable, GrowsWithTheDepth)
{
  const auto rows = table().rows();
  EXPECT_EQ(rows.front().depth, 0.5_mm);
  EXPECT_EQ(rows.front().extentRadius, 0.0);
  for (std::size_t i = 1; i < rows.size(); ++i)
  {
    EXPECT_NEAR(rows[i].depth - rows[i - 1].depth, 0.5_mm, 1e-12);
    EXPECT_GT(rows[i].extentRadius, rows[i - 1].extentRadius);
    EXPECT_GT(rows[i].force, rows[i - 1].force);
  }
  EXPECT_GT(rows.back().extentRadius, 1.2 * rows.back().contactRadius);
}

} // namespace
} // namespace palp
