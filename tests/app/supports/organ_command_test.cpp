#include "data/shapes.h"
#include "haptics/units.h"
#include "tests/app/supports/slabs.h"
#include "tests/support/csv_table.h"
#include "tests/support/obj_file.h"
#include "tests/support/process.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>
#include <vector>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>

namespace palp
{
namespace
{

using namespace units::literals;

// the remark of each row
std::vector<std::string> remarks(const std::string& options)
{
  const test::Finished run = test::runCommand(
    PALP_PROGRAM " organ " PALP_SHARE "/meshes/block_50.vtp --cell 10mm " + options);
  EXPECT_EQ(run.code, 0) << run.err;
  std::vector<std::string> all;
  std::istringstream lines(run.out);
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line))
  {
    all.push_back(line.substr(line.rfind(',') + 1));
  }
  return all;
}

// the block of 100 x 100 x 50 mm, its top at z = 0
TEST(OrganCommand, RemarksWhatItCannotTell)
{
  const std::string below = "--support bonded:box:-60,-60,-55:60,60,-45 ";
  EXPECT_EQ(remarks(below + "--at 0,0,0 --depth 2:4:2mm"), std::vector<std::string>(2));
  const auto deep = remarks(below + "--at 0,0,0 --depth 10:70:30mm");
  ASSERT_EQ(deep.size(), 3U);
  EXPECT_EQ(deep.back(), "too deep");
  EXPECT_EQ(remarks(below + "--at 45,0,0 --depth 2:2:1mm").at(0), "edge");
  EXPECT_EQ(
    remarks(below + "--support bonded:box:-15,-15,-5:15,15,5 --at 0,0,0 --depth 1:1:1mm").at(0),
    "on a support");
}

// bonded plates against the law of a bonded layer, which is held against other formulas elsewhere:
// a row without a remark is within 3 %
TEST(OrganCommand, OfAThinPlateIsThatOfTheLayerOrSaysSo)
{
  const test::TemporaryFolder folder;
  const std::string common =
    " --tip sphere:6mm --young 10kPa --poisson 0.45 --depth 0.3:0.9:0.3mm ";
  int believed = 0;
  for (const int height : { 3, 5, 8, 15 })
  {
    const auto file = folder.path() / ("plate" + std::to_string(height) + ".obj");
    test::writeBox(file, { -30.0, -25.0, -1.0 * height }, { 30.0, 25.0, 0.0 });
    std::istringstream forces(
      test::runCommand(PALP_PROGRAM " force --law corrected --material linear" + common +
        "--thickness " + std::to_string(height) + "mm")
        .out);
    const test::CsvTable layer = test::parseCsv(forces);
    for (const int cell : { 4, 2 })
    {
      const test::Finished run = test::runCommand(PALP_PROGRAM " organ " + file.string() +
        " --unit mm --support bonded:direction:0,0,-1:60deg --at 0,0,0" + common + "--cell " +
        std::to_string(cell) + "mm");
      ASSERT_EQ(run.code, 0) << run.err;
      std::istringstream lines(run.out);
      std::string line;
      std::getline(lines, line);
      for (std::size_t i = 0; std::getline(lines, line); ++i)
      {
        std::istringstream cells(line);
        std::vector<std::string> row;
        for (std::string text; std::getline(cells, text, ',');)
        {
          row.push_back(text);
        }
        row.resize(10); // an empty remark is none
        const double exact = layer["force_N"].at(i);
        if (row[9].empty())
        {
          ++believed;
          EXPECT_NEAR(std::stod(row[6]), exact, 0.03 * exact) << height << " mm, " << line;
        }
      }
    }
  }
  EXPECT_GE(believed, 12);
}

// 10 mm cells of the block, from the folder
std::string blockFile(const std::filesystem::path& file)
{
  return PALP_PROGRAM " organ " PALP_SHARE "/meshes/block_50.vtp --cell 10mm --poisson 0.45 "
                      "--support bonded:box:-60,-60,-55:60,60,-45 --out " +
    file.string();
}

TEST(OrganCommand, MakesAFileThatARunFeels)
{
  const test::TemporaryFolder folder;
  const auto file = folder.path() / "block.organ";
  const test::Finished made = test::runCommand(blockFile(file));
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_NE(made.err.find("cannot answer for"), std::string::npos) << made.err;
  const auto time = std::filesystem::last_write_time(file);
  const test::Finished again = test::runCommand(blockFile(file));
  EXPECT_NE(again.err.find("already"), std::string::npos) << again.err;
  EXPECT_EQ(std::filesystem::last_write_time(file), time);

  const auto out = folder.path() / "pressed";
  const test::Finished run = test::runCommand(PALP_PROGRAM
    " run " PALP_SHARE "/meshes/block_50.vtp --at 10,5,0 --depth 4mm --law exact "
    "--poisson 0.45 --samples-only --out " +
    out.string() + " --organ " + file.string());
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(run.err.find("Poisson"), std::string::npos) << run.err;
  const test::Finished other = test::runCommand(PALP_PROGRAM
    " run " PALP_SHARE "/meshes/block_50.vtp --at 10,5,0 --depth 4mm --samples-only --out " +
    (folder.path() / "other").string() + " --organ " + file.string());
  EXPECT_NE(
    other.err.find("of a Poisson's ratio of 0.45, and the tissue of 0.33"), std::string::npos)
    << other.err;
  const test::CsvTable samples = test::readCsv(out / "samples.csv");
  // the row says of what its depth is made: Sneddon's sphere in series with the body
  const double modulus = 50e3 / (1.0 - 0.45 * 0.45);
  const double radius = 0.01;
  for (std::size_t i = 0; i < samples["depth_mm"].size(); i += 50)
  {
    const double a = 1e-3 * samples["contact_radius_mm"][i];
    const double local = 1e-3 * samples["local_depth_mm"][i];
    const double f = samples["force_N"][i] / modulus;
    const double slope = samples["organ_slope_per_m2"][i];
    const double edge = samples["organ_edge_per_m"][i];
    double aside = 0.0; // x (1 + x / D)^2 = R b f, by halving
    for (double step = radius; step > 1e-9; step *= 0.5)
    {
      const double next = aside + step;
      aside = next * std::pow(1.0 + edge * next, 2) < radius * slope * f ? next : aside;
    }
    aside = std::min(aside, 0.5 * a);
    const double depth = local +
      f *
        (samples["organ_constant_per_m"][i] +
          4.0 / 15.0 * samples["organ_bend_per_m3"][i] * a * a) -
      2.0 * f * slope * aside / (1.0 + edge * aside) + 0.5 * aside * aside / radius;
    EXPECT_NEAR(1e3 * depth, samples["depth_mm"][i], 2e-3 * samples["depth_mm"][i] + 1e-6);
    EXPECT_NEAR(0.5 * a * std::log((radius + a) / (radius - a)), local, 1e-4 * local + 1e-9);
  }
}

TEST(OrganCommand, ARunRefusesAFileThatIsNotOfWhatItPresses)
{
  const test::TemporaryFolder folder;
  const auto file = folder.path() / "block.organ";
  ASSERT_EQ(test::runCommand(blockFile(file)).code, 0);
  const auto refusal = [&](const std::string& pressed)
  {
    const test::Finished run =
      test::runCommand(PALP_PROGRAM " run " PALP_SHARE "/meshes/" + pressed +
        " --depth 4mm --out " + (folder.path() / "out").string() + " --organ " + file.string());
    EXPECT_EQ(run.code, 2) << run.err;
    return run.err;
  };
  const std::string block = "block_50.vtp --at 10,5,0 --law corrected ";
  for (const auto& [pressed, why] :
    { std::pair(std::string("block_30.vtp --at 0,0,0"), "another surface"),
      std::pair(block + "--stiffness formula:5", "of one modulus"),
      std::pair(block + "--base slip", "leave out --base and --coating"),
      std::pair(block + "--base bonded", "leave out --base and --coating") })
  {
    const std::string told = refusal(pressed);
    EXPECT_NE(told.find(why), std::string::npos) << told;
  }
}

// what is painted anew is solved anew, and what is pressed says on what it rests
TEST(OrganCommand, AFileIsOfTheSupportsThatWerePainted)
{
  const test::TemporaryFolder folder;
  const auto paint = [&](double most)
  {
    std::ofstream out(folder.path() / "rest.csv");
    out << "x_mm,y_mm,z_mm\n";
    for (double x = -49.0; x < most; x += 1.0)
    {
      for (double y = -49.0; y < 50.0; y += 1.0)
      {
        out << x << ',' << y << ",-50\n";
      }
    }
  };
  const std::string support = " --support bonded:points:" + (folder.path() / "rest.csv").string();
  const std::string organ = (folder.path() / "block.organ").string();
  const auto make = [&](const std::string& more = "")
  {
    return test::runCommand(PALP_PROGRAM " organ " PALP_SHARE
                                         "/meshes/block_50.vtp --poisson 0.45 --cell 16mm" +
      support + " --out " + organ + more);
  };
  const auto run = [&](const std::string& more)
  {
    return test::runCommand(PALP_PROGRAM " run " PALP_SHARE "/meshes/block_50.vtp --at 10,5,0 "
                                         "--law exact --poisson 0.45 --samples-only --out " +
      test::freshFolder().string() + more);
  };
  paint(50.0);
  ASSERT_EQ(make().code, 0);
  EXPECT_NE(make().err.find("already"), std::string::npos);
  EXPECT_EQ(run(" --organ " + organ + support).code, 0);
  const test::Finished other = run(" --organ " + organ + " --support posterior");
  EXPECT_EQ(other.code, 2);
  EXPECT_NE(other.err.find("rests on bonded:points:rest.csv"), std::string::npos) << other.err;
  EXPECT_NE(run(support).err.find("not in the force"), std::string::npos);
  paint(0.0);
  EXPECT_EQ(run(" --organ " + organ + support).code, 2) << "other points than it was made of";
  const test::Finished kept = make();
  EXPECT_EQ(kept.code, 2);
  EXPECT_NE(kept.err.find("--overwrite"), std::string::npos) << kept.err;
  const test::Finished anew = make(" --overwrite");
  EXPECT_EQ(anew.err.find("already"), std::string::npos) << anew.err;
  EXPECT_EQ(anew.code, 0) << anew.err;
  EXPECT_EQ(run(" --organ " + organ + support).code, 0);
}

// how far points of a pressed surface went down, by x [mm]
std::vector<std::pair<double, double>> sunk(const std::filesystem::path& file)
{
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  vtkPolyData* mesh = reader->GetOutput();
  vtkDataArray* moved = mesh->GetPointData()->GetArray("Displacement");
  std::vector<std::pair<double, double>> all;
  for (vtkIdType i = 0; moved != nullptr && i < mesh->GetNumberOfPoints(); ++i)
  {
    const double down = -moved->GetComponent(i, 2);
    all.emplace_back(mesh->GetPoint(i)[0] - moved->GetComponent(i, 0), down);
  }
  return all;
}

// a lobe that is clamped at one end goes down beyond the tool as Timoshenko's beam does there
TEST(OrganCommand, WhatIsFarFromTheToolMovesAsTheBodyDoes)
{
  const test::TemporaryFolder folder;
  const Eigen::Vector3d size(100.0_mm, 30.0_mm, 16.0_mm);
  const Mesh box = makeBox(size, 4.0_mm);
  const auto file = folder.path() / "lobe.obj";
  test::writeObj(file, box.points, box.triangles);
  const std::string organ = " --organ " + (folder.path() / "lobe.organ").string();
  const test::Finished made = test::runCommand(PALP_PROGRAM " organ " + file.string() +
    " --unit mm --cell 5mm --poisson 0.3 --support bonded:box:-60,-60,-60:-49.9,60,60 --out" +
    organ.substr(8));
  ASSERT_EQ(made.code, 0) << made.err;
  for (const bool isOrgan : { false, true })
  {
    const auto out = folder.path() / (isOrgan ? "lobe" : "half_space");
    const test::Finished run = test::runCommand(PALP_PROGRAM " run " + file.string() +
      " --unit mm --at 20,0,0 --depth 3mm --law exact --young 50kPa --poisson 0.3 --no-picture "
      "--out " +
      out.string() + (isOrgan ? organ : ""));
    ASSERT_EQ(run.code, 0) << run.err;
    const double force = std::ranges::max(test::readCsv(out / "samples.csv")["force_N"]);
    const double bend = 50.0_kPa * size.y() * std::pow(size.z(), 3) / 12.0;
    const double shear = 5.0 / 6.0 * 50.0_kPa / 2.6 * size.y() * size.z();
    const double arm = 70.0_mm;
    for (const auto& [x, down] : sunk(out / "deformed.vtp"))
    {
      const double beyond = 1e-3 * (x + 50.0) - arm;
      const double beam =
        force * arm * arm * (arm / 3.0 + 0.5 * beyond) / bend + force * arm / shear;
      if (x > 45.0) // where the beam is straight
      {
        EXPECT_NEAR(1e-3 * down, isOrgan ? beam : 0.0, isOrgan ? 0.1 * beam : 1e-12) << x;
      }
      EXPECT_TRUE(x > -49.0 || std::abs(down) < (isOrgan ? 0.05 : 1e-12)) << x << ' ' << down;
    }
  }
}

// at a corner a tool slides off; in the middle the answer is what it is alone
TEST(OrganCommand, APlaceWithoutAnAnswerKeepsNoOtherFromIts)
{
  const std::string organ = PALP_PROGRAM " organ " PALP_SHARE "/meshes/block_50.vtp --cell 10mm "
                                         "--support bonded:box:-60,-60,-55:60,60,-45 ";
  const test::Finished alone = test::runCommand(organ + "--at 0,0,0");
  const test::Finished both = test::runCommand(organ + "--at 49.9,49.9,0 --at 0,0,0");
  EXPECT_EQ(alone.code, 0) << alone.err;
  EXPECT_EQ(both.code, 2);
  EXPECT_EQ(both.out, alone.out);
  EXPECT_NE(both.err.find("49.9,49.9,0 mm"), std::string::npos) << both.err;
}

TEST(OrganCommand, RefusesInOneSentence)
{
  const std::string block = PALP_PROGRAM " organ " PALP_SHARE "/meshes/block_50.vtp --cell 10mm ";
  const auto refusal = [](const std::string& command)
  {
    const test::Finished run = test::runCommand(command);
    EXPECT_NE(run.code, 0) << command;
    EXPECT_EQ(test::sentences(run).size(), 2U) << run.err; // what was read, and why
    return run.err;
  };
  const std::string out = " --out " + (test::freshFolder() / "x.organ").string();
  EXPECT_NE(refusal(block + "--support sliding:box:-60,-60,-55:60,60,-45" + out).find("free to"),
    std::string::npos);
  EXPECT_NE(
    test::runCommand(block + "--support bonded:box:-60,-60,-55:60,60,-45 --young nan" + out).code,
    0);
  EXPECT_FALSE(std::filesystem::exists(out.substr(7)));
  EXPECT_NE(test::runCommand(block + "--support posterior --at 0,0,0 --depth -3:1:1mm")
              .err.find("begins above the surface"),
    std::string::npos);
}

} // namespace
} // namespace palp
