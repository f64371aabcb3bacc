#include "haptics/surface/closest_point.h"
#include "haptics/surface/sampling/deviation.h"
#include "haptics/units.h"
#include "pipeline/health/mesh_health.h"
#include "pipeline/model/poly_data.h"
#include "pipeline/surface_io/surface_io.h"
#include "tests/support/csv_table.h"
#include "tests/support/process.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>
#include <vtkPolyData.h>

namespace palp::test
{
namespace
{

using namespace units::literals;
using Eigen::Vector3d;

class Phantoms : public testing::Test
{
protected:
  std::filesystem::path make(const std::string& arguments, const std::string& name = "phantom")
  {
    const std::filesystem::path folder = folder_.path() / name;
    const Finished finished =
      runCommand(PALP_PROGRAM " phantom " + arguments + " --out " + folder.string());
    EXPECT_EQ(finished.code, 0) << finished.err;
    table_ = finished.out;
    return folder;
  }

  // [ml] of labels, by name, or of surfaces
  [[nodiscard]] std::map<std::string, double> volumes(bool isOfSurfaces = false) const
  {
    std::map<std::string, double> result;
    std::istringstream lines(table_);
    std::string line;
    for (std::getline(lines, line); std::getline(lines, line);)
    {
      std::istringstream words(line);
      std::array<std::string, 6> cells; // label, name, voxels, label_ml, file, surface_ml
      std::ranges::for_each(cells, [&](std::string& cell) { std::getline(words, cell, ','); });
      result[cells[1]] = std::stod(cells[isOfSurfaces ? 5 : 3]);
    }
    return result;
  }

  static Surface surfaceOf(const std::filesystem::path& file)
  {
    const auto mesh = readSurface(file).mesh;
    return { pointsOf(*mesh), trianglesOf(*mesh) };
  }

  // with seed 7, made once
  static const std::filesystem::path& theLiver()
  {
    static const TemporaryFolder folder;
    static const std::filesystem::path made = [&]
    {
      const std::filesystem::path out = folder.path() / "liver";
      const Finished finished =
        runCommand(PALP_PROGRAM " phantom liver --seed 7 --voxel 1.2mm --out " + out.string());
      EXPECT_EQ(finished.code, 0) << finished.err;
      return out;
    }();
    return made;
  }

  TemporaryFolder folder_;
  std::string table_;
};

// a MetaImage of bytes, as its header says
struct Image
{
  explicit Image(const std::filesystem::path& file)
    : bytes(readAll(file))
  {
    std::istringstream lines(bytes.substr(0, 2000));
    for (std::string line; std::getline(lines, line) && !line.starts_with("ElementDataFile");)
    {
      const std::size_t equals = line.find('=');
      std::istringstream values(line.substr(equals + 1));
      if (Eigen::Vector3d three; values >> three.x() >> three.y() >> three.z())
      {
        fields[line.substr(0, equals - 1)] = three;
      }
    }
    const Vector3d& n = fields.at("DimSize");
    bytes.erase(0, bytes.size() - static_cast<std::size_t>(n.prod()));
  }

  // at a place [m]
  [[nodiscard]] int label(const Vector3d& place) const
  {
    const Vector3d i = (1e3 * place - fields.at("Offset"))
                         .cwiseQuotient(fields.at("ElementSpacing"))
                         .array()
                         .round();
    const Vector3d& n = fields.at("DimSize");
    return bytes[static_cast<std::size_t>(i.x() + n.x() * (i.y() + n.y() * i.z()))];
  }

  std::string bytes;
  std::map<std::string, Vector3d> fields;
};

TEST_F(Phantoms, HaveTheVolumesOfTheirFormulas)
{
  for (const char* side : { "1mm", "2mm" }) // at 2 mm faces go through the middles of voxels
  {
    make("block --voxel " + std::string(side), "block" + std::string(side));
    EXPECT_NEAR(volumes()["block"], 500.0, 1e-6) << side;
  }
  make("slab", "slab");
  EXPECT_NEAR(volumes()["skin"], 28.8, 1e-6);
  EXPECT_NEAR(volumes()["fat"], 144.0, 1e-6);
  EXPECT_NEAR(volumes()["liver"], 720.0, 1e-6);
  EXPECT_NEAR(volumes(true)["skin"], 892.8, 1e-6) << "with all that lies below";
  make("sphere --voxel 0.7mm", "sphere");
  const double ball = 4.0 / 3.0 * std::numbers::pi * 27.0;
  EXPECT_NEAR(volumes()["sphere"], ball, 0.003 * ball);
}

TEST_F(Phantoms, HaveSurfacesWithoutAFault)
{
  for (const char* name : { "block", "slab", "sphere", "liver" })
  {
    const bool isLiver = std::string_view(name) == "liver";
    for (const auto& entry :
      std::filesystem::directory_iterator(isLiver ? theLiver() : make(name, name)))
    {
      if (entry.path().extension() == ".vtp")
      {
        const FileSurface read = readFileSurface(entry.path());
        const MeshHealth health = healthOf(read.points, read.triangles);
        EXPECT_TRUE(health.findings.empty()) << entry.path();
        EXPECT_TRUE(health.pieces.front().closed) << entry.path();
      }
    }
  }
}

TEST_F(Phantoms, OfTheLiverIsTheSameInSurfaceImageAndScene)
{
  const std::filesystem::path& folder = theLiver();
  const Image image(folder / "liver.mha");
  const Surface liver = surfaceOf(folder / "liver.vtp");
  const LoadedSurface labeled =
    readSurface(folder / "liver.mha", LengthUnit::Millimeter, { {}, { "1", "2", "3" } });
  const Surface voxels(pointsOf(*labeled.mesh), trianglesOf(*labeled.mesh));
  EXPECT_LT(deviation(liver, voxels).largest, 1.2_mm);

  const auto scene = nlohmann::json::parse(readAll(folder / "scene.json"));
  const auto millimeters = [](const nlohmann::json& text)
  { return 1e-3 * std::stod(text.get<std::string>()); };
  double milliliters = 0.0;
  const auto& nodules = scene.at("meshes").at(0).at("nodules");
  EXPECT_EQ(nodules.size(), 5U);
  for (const auto& nodule : nodules)
  {
    const Vector3d center(millimeters(nodule.at("center").at(0)),
      millimeters(nodule.at("center").at(1)), millimeters(nodule.at("center").at(2)));
    const double radius = millimeters(nodule.at("radius"));
    milliliters += 4.0 / 3.0 * std::numbers::pi * std::pow(1e2 * radius, 3);
    EXPECT_EQ(image.label(center), 3);
    for (int axis = 0; axis < 3; ++axis)
    {
      EXPECT_EQ(image.label(center + 0.85 * radius * Vector3d::Unit(axis)), 3);
      EXPECT_NE(image.label(center - (radius + 1.3_mm) * Vector3d::Unit(axis)), 0);
    }
    const double cover = -findClosestPoint(liver, center, 1.0).distance - radius;
    EXPECT_GT(cover, 3.5_mm);
    EXPECT_LT(cover, 13.0_mm);
  }
  const auto voxelsOfThem = std::ranges::count(image.bytes, '\3');
  EXPECT_NEAR(
    1e-3 * std::pow(1.2, 3) * static_cast<double>(voxelsOfThem), milliliters, 0.03 * milliliters);
}

// a ball of 60 mm, which could be one of 600 mm in cm
TEST_F(Phantoms, HaveLabelMapsThatNameTheirUnit)
{
  const std::filesystem::path folder = make("sphere --voxel 2mm", "sphere");
  const LoadedSurface ball = readSurface(folder / "sphere.mha", {}, { {}, { "1" } });
  double box[6];
  ball.mesh->GetBounds(box);
  EXPECT_NEAR(box[1] - box[0], 60.0_mm, 2.0_mm);
}

TEST_F(Phantoms, FollowTheirSeed)
{
  const std::string seven = readAll(theLiver() / "scene.json");
  EXPECT_EQ(readAll(make("liver --voxel 5mm --seed 7", "again") / "scene.json"), seven);
  EXPECT_NE(readAll(make("liver --voxel 5mm --seed 8", "other") / "scene.json"), seven);
}

TEST_F(Phantoms, RefuseWhatTheyAreNot)
{
  for (const char* arguments : { "kidney", "liver --seed 1.5", "block --voxel 0.01mm", "" })
  {
    const Finished finished = runCommand(
      PALP_PROGRAM " phantom " + std::string(arguments) + " --out " + folder_.path().string());
    EXPECT_EQ(finished.code, 2) << arguments;
  }
}

} // namespace
} // namespace palp::test
