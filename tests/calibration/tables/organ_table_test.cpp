#include "calibration/tables/organ_table.h"

#include "haptics/error.h"

#include <chrono>
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>

namespace palp
{
namespace
{

std::filesystem::path fileOf(const std::string& name)
{
  return std::filesystem::path(testing::TempDir()) / name;
}

OrganTable tableOf(std::size_t places)
{
  OrganTable table;
  table.mesh = "SHA-256 abc, read in mm";
  table.supports = "bonded:direction:0,1,0:60deg";
  table.count = places;
  for (std::size_t i = 0; i < places; ++i)
  {
    const double x = 1e-4 * static_cast<double>(i);
    table.places.push_back({ .position = { x, 0.0123456789, -0.3 },
      .normal = Eigen::Vector3d(1.0, 2.0, -3.0).normalized(),
      .constant = -12.3456789 + x,
      .slope = { 1.0, x, -250.0 },
      .bend = 1e5 / 3.0,
      .edge = 40.0,
      .trust = i % 2 == 0 ? ComplianceTrust::Known : ComplianceTrust::Edge });
  }
  return table;
}

OrganMotionModes motionOf(std::size_t places, Eigen::Index modes)
{
  OrganMotionModes motion{ .radius = 30e-3 };
  for (std::size_t i = 0; i < places; ++i)
  {
    const double x = 1e-3 * static_cast<double>(i);
    motion.places.push_back(
      { { x, 0.0123, -0.3 }, Eigen::Vector3d(1.0, 2.0, -3.0).normalized(), i % 3 != 0 });
  }
  motion.loads = 1e3F * Eigen::MatrixXf::Random(modes, static_cast<Eigen::Index>(places));
  motion.modes = 0.01F * Eigen::MatrixXf::Random(3 * static_cast<Eigen::Index>(places), modes);
  return motion;
}

std::string refusalOf(const std::string& text)
{
  const auto file = fileOf("refused.organ");
  std::ofstream(file) << text;
  try
  {
    (void)readOrganOf(file, "SHA-256 abc, read in mm");
  }
  catch (const Error& error)
  {
    return error.what();
  }
  return "";
}

std::string textOf(const OrganTable& table)
{
  const auto file = fileOf("text.organ");
  writeOrganTable(file, table);
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

std::string replaced(std::string text, const std::string& from, const std::string& to)
{
  return text.replace(text.find(from), from.size(), to);
}

TEST(OrganTable, ReadsWhatItWroteSmallAndFast)
{
  OrganTable table = tableOf(2500);
  table.motion = motionOf(600, 24);
  const auto file = fileOf("liver.organ");
  writeOrganTable(file, table);
  EXPECT_LT(std::filesystem::file_size(file), 1'000'000U);
  const auto start = std::chrono::steady_clock::now();
  const OrganTable read = readOrganOf(file, table.mesh);
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
  RecordProperty("milliseconds", std::to_string(1e3 * time.count()));
  EXPECT_LT(time.count(), 0.2) << "of a machine that does other things, too";
  EXPECT_TRUE(read.continues(table));
  ASSERT_EQ(read.places.size(), table.places.size());
  for (const std::size_t i : { std::size_t{ 0 }, std::size_t{ 1777 } })
  {
    EXPECT_LT((read.places[i].position - table.places[i].position).norm(), 1e-8);
    EXPECT_LT((read.places[i].normal - table.places[i].normal).norm(), 1e-6);
    EXPECT_NEAR(read.places[i].constant, table.places[i].constant, 1e-5);
    EXPECT_NEAR(read.places[i].bend, table.places[i].bend, 0.1);
    EXPECT_EQ(read.places[i].edge, table.places[i].edge);
    EXPECT_EQ(read.places[i].trust, table.places[i].trust);
  }
  ASSERT_EQ(read.motion.places.size(), 600U);
  EXPECT_EQ(read.motion.radius, table.motion.radius);
  EXPECT_LT((read.motion.loads - table.motion.loads).norm(), 1e-4F * table.motion.loads.norm());
  EXPECT_LT((read.motion.modes - table.motion.modes).norm(), 1e-4F * table.motion.modes.norm());
  EXPECT_LT((read.motion.places[333].position - table.motion.places[333].position).norm(), 1e-6);
  EXPECT_FALSE(read.motion.places[333].isLoaded);
}

TEST(OrganTable, RefusesInOneSentence)
{
  OrganTable table = tableOf(3);
  table.motion = motionOf(2, 2);
  const std::string good = textOf(table);
  EXPECT_EQ(refusalOf(good), "");
  EXPECT_NE(refusalOf("").find("is no organ file"), std::string::npos);
  EXPECT_NE(refusalOf("x,y\n1,2\n").find("is no organ file"), std::string::npos);
  EXPECT_NE(refusalOf(replaced(good, "organ 3", "organ 7")).find("version '7'"), std::string::npos);
  // made before what is between two edges was told
  const std::string old = refusalOf(replaced(good, "organ 3", "organ 2"));
  EXPECT_NE(old.find("version '2'"), std::string::npos);
  EXPECT_NE(old.find("again by palp organ"), std::string::npos);
  EXPECT_NE(refusalOf(replaced(good, "motion_modes: 2", "motion_modes: 3")).find("damaged"),
    std::string::npos);
  EXPECT_NE(refusalOf(replaced(good, "motion 1 ", "motion x ")).find("damaged"), std::string::npos);
  EXPECT_NE(refusalOf(replaced(good, "abc", "abd")).find("another surface"), std::string::npos);
  EXPECT_NE(
    refusalOf(replaced(good, "places: 3", "places: 9")).find("not finished"), std::string::npos);
  EXPECT_NE(
    refusalOf(replaced(good, "places: 3", "places: 2")).find("more places"), std::string::npos);
  EXPECT_NE(refusalOf(replaced(good, "spacing_mm: 4", "spacing_mm: x")).find("spacing_mm"),
    std::string::npos);
  for (const char* poisson : { "0.5", "0.9", "-0.1", "nan", "soft" })
  {
    EXPECT_NE(refusalOf(replaced(good, "poisson: 0.45", std::string("poisson: ") + poisson))
                .find("'# poisson:'"),
      std::string::npos)
      << poisson;
  }
  EXPECT_EQ(refusalOf(replaced(good, "mesh: ", "mesh: , ")), "") << "as of an earlier program";
  EXPECT_NE(refusalOf(replaced(good, "-12.34568", "nan")), "");
  EXPECT_NE(refusalOf(replaced(good, "0.2672612", "7")).find("unit length"), std::string::npos);
  for (std::size_t cut = 0; cut < good.size(); cut += 7)
  {
    EXPECT_NE(refusalOf(good.substr(0, cut)), "") << cut;
  }
}

} // namespace
} // namespace palp
