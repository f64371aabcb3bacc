#include "haptics/files/csv_text.h"
#include "haptics/units.h"
#include "pipeline/model/poly_data.h"
#include "pipeline/surface_io/surface_io.h"
#include "tests/support/dicom_series.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>
#include <vtkPolyData.h>
#include <zlib.h>

namespace palp
{
namespace
{

using namespace units::literals;
using Eigen::Vector3d;

// The commands of the README from scans to presses, as they stand there.
std::string commandsOfReadme()
{
  std::istringstream in(test::readAll(PALP_SOURCE_DIR "/README.md"));
  std::string commands;
  for (std::string line; std::getline(in, line);)
  {
    const bool isWalk = line.starts_with("    palp import ") || !commands.empty();
    if (isWalk && !line.starts_with("    "))
    {
      break;
    }
    commands += isWalk ? line + "\n" : "";
  }
  return commands;
}

// of two balls, in voxels that go to the right, the head and the front, in NIfTI's axes
void writeLabelMap(const std::filesystem::path& file)
{
  constexpr std::array<short, 3> kSize{ 100, 60, 66 };
  constexpr float kSide = 1.5F;
  std::string bytes(352, '\0');
  const auto put = [&](std::size_t at, const auto& value)
  { std::memcpy(bytes.data() + at, &value, sizeof value); };
  put(0, 348);
  put(40, short{ 3 });
  for (std::size_t k = 0; k < 3; ++k)
  {
    put(42 + 2 * k, kSize[k]);
    put(80 + 4 * k, kSide);
  }
  put(70, short{ 2 });
  put(72, short{ 8 });
  put(108, 352.0F);
  put(123, char{ 2 });
  put(254, short{ 1 });
  const std::array<float, 12> form{ kSide, 0, 0, -40.0F, 0, 0, kSide, -40.0F, 0, kSide, 0, -5.0F };
  put(280, form);
  std::memcpy(bytes.data() + 344, "n+1", 4);
  for (int i = 0; i < kSize[0] * kSize[1] * kSize[2]; ++i)
  {
    const int x = i % kSize[0];
    const int y = i / kSize[0] % kSize[1];
    const int z = i / kSize[0] / kSize[1];
    const Vector3d ras = 1.5 * Vector3d(x, z, y) - Vector3d(40.0, 40.0, 5.0);
    const Vector3d lps(-ras.x(), -ras.y(), ras.z());
    const bool isLiver = (lps - Vector3d(-50.0, 0.0, 40.0)).norm() < 38.0;
    const bool isKidney = (lps - Vector3d(15.0, -10.0, 40.0)).norm() < 20.0;
    bytes += static_cast<char>(isLiver ? 5 : isKidney ? 2 : 0);
  }
  gzFile out = gzopen(file.c_str(), "wb");
  gzwrite(out, bytes.data(), static_cast<unsigned>(bytes.size()));
  gzclose(out);
}

// the point of a pressed surface that is nearest to the middle of the ball that it was
Vector3d deepest(const std::filesystem::path& folder, const Vector3d& middle)
{
  const LoadedSurface pressed = readSurface(folder / "deformed.vtp");
  EXPECT_EQ(pressed.space, "LPS");
  const std::vector<Vector3d> points = pointsOf(*pressed.mesh);
  return *std::ranges::min_element(
    points, {}, [&](const Vector3d& point) { return (point - middle).norm(); });
}

// of the sample that is the deepest: the tool's apex [m]
Vector3d apexOf(const std::filesystem::path& folder)
{
  std::ifstream in(folder / "samples.csv");
  std::vector<std::string> names;
  double most = -1.0;
  Vector3d apex = Vector3d::Zero();
  for (std::string line; std::getline(in, line);)
  {
    const std::vector<std::string> cells = csvFields(line);
    if (line.starts_with('#') || names.empty())
    {
      names = line.starts_with('#') ? names : cells;
      continue;
    }
    const auto number = [&](const char* name)
    {
      const auto at = std::ranges::find(names, name) - names.begin();
      return csvNumber(cells.at(static_cast<std::size_t>(at))).value_or(0.0);
    };
    if (number("depth_mm") > most)
    {
      most = number("depth_mm");
      apex = 1e-3 * Vector3d(number("tool_x_mm"), number("tool_y_mm"), number("tool_z_mm"));
    }
  }
  return apex;
}

// where a tool that is pressed into a ball comes to: along its radius, by the depth
void expectAt(const std::filesystem::path& folder, const Vector3d& middle, const Vector3d& place,
  double depth, double off)
{
  const Vector3d goal = place + depth * (middle - place).normalized();
  const Vector3d lowest = deepest(folder, middle);
  EXPECT_LT((lowest - goal).norm(), 1.5_mm) << lowest.transpose() << ", not " << goal.transpose();
  EXPECT_NEAR((lowest - middle).norm(), (goal - middle).norm(), off);
  EXPECT_LT((apexOf(folder) - goal).norm(), off) << apexOf(folder).transpose();
}

TEST(Walk, FromScansToPressesByTheReadmeAlone)
{
  const test::TemporaryFolder folder;
  const Vector3d toLeft = Vector3d(0.8, 0.6, 0.0);
  const Vector3d down = Vector3d(0.0, 0.0, -1.0);
  const Vector3d middle(-20.0, -160.0, 900.0);
  const Vector3d first =
    middle - 0.5 * 39.0 * toLeft - 0.5 * 37.0 * down - 0.5 * 19.0 * 1.6 * toLeft.cross(down);
  const test::DicomGrid grid{ 40, 38, 20, first, toLeft, down, 1.0, 1.0, 1.6 };
  test::writeDicom(folder.path(), "ct", grid, "--write-xfer-little");
  writeLabelMap(folder.path() / "abdomen.nii.gz");
  std::ofstream(folder.path() / "names.ctbl")
    << "2 kidney_right 185 102 83 255\n5 liver 221 130 101 255\n";

  const std::string commands = commandsOfReadme();
  ASSERT_NE(commands.find("palp run"), std::string::npos) << commands;
  const std::string bin = std::filesystem::path(PALP_PROGRAM).parent_path().string();
  std::ofstream(folder.path() / "walk.sh") << commands;
  const test::Finished finished = test::runCommand(
    "cd " + folder.path().string() + " && PATH=" + bin + ":$PATH bash -eu walk.sh");
  ASSERT_EQ(finished.code, 0) << finished.err;

  // what the README asks for: --at -20,-172,900 by 3 mm, and --at -50,-22.8,70.4 by 5 mm
  expectAt(folder.path() / "pressed_scan", 1e-3 * middle, { -20.0_mm, -172.0_mm, 900.0_mm }, 3.0_mm,
    0.2_mm);
  expectAt(folder.path() / "pressed", { -50.0_mm, 0.0, 40.0_mm }, { -50.0_mm, -22.8_mm, 70.4_mm },
    5.0_mm, 0.75_mm); // half a voxel
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "organs/kidney_right.vtp"));
}

} // namespace
} // namespace palp
