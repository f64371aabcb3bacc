#include "pipeline/surface_io/surface_io.h"
#include "tests/pipeline/formats/ball_images.h"
#include "tests/support/deflated.h"

#include <bit>
#include <cstring>
#include <functional>
#include <numbers>
#include <sstream>

// NRRD as its definition has it (teem.sourceforge.net/nrrd/format.html), with the keys of 3D
// Slicer's segmentations, written here without a library

namespace palp::test
{
namespace
{

using Eigen::Matrix3d;
using Eigen::Vector3d;

// What an NRRD says of its place: columns of axes are the steps of the first, second, third index.
struct Grid
{
  std::string space; // as the header names it
  Matrix3d axes;     // [mm]
  Vector3d origin;   // [mm]
  std::array<int, 3> size;
};

// from the file's axes to left, back and head
Vector3d inLps(const Grid& grid, const Vector3d& p)
{
  const double right = grid.space.starts_with("right") ? -1.0 : 1.0;
  const double front = grid.space.find("anterior") != grid.space.npos ? -1.0 : 1.0;
  return { right * p.x(), front * p.y(), p.z() };
}

// balls in LPS [mm], each a layer or all in one
struct Ball
{
  Vector3d center;
  double radius;
  std::string name;
  int layer;
  int value;
};

template <typename Voxel>
std::string voxelsOf(const Grid& grid, const std::vector<Ball>& balls, int layers, bool big)
{
  std::vector<Voxel> voxels;
  for (int k = 0; k < grid.size[2]; ++k)
  {
    for (int j = 0; j < grid.size[1]; ++j)
    {
      for (int i = 0; i < grid.size[0]; ++i)
      {
        const Vector3d place = inLps(grid, grid.axes * Vector3d(i, j, k) + grid.origin);
        for (int layer = 0; layer < layers; ++layer)
        {
          int value = 0;
          for (const Ball& ball : balls)
          {
            const bool inside = (place - ball.center).norm() < ball.radius;
            value = inside && ball.layer == layer ? ball.value : value;
          }
          voxels.push_back(static_cast<Voxel>(value));
        }
      }
    }
  }
  std::string bytes(voxels.size() * sizeof(Voxel), '\0');
  std::memcpy(bytes.data(), voxels.data(), bytes.size());
  for (std::size_t i = 0; big && i < bytes.size(); i += sizeof(Voxel))
  {
    std::reverse(bytes.begin() + static_cast<std::ptrdiff_t>(i),
      bytes.begin() + static_cast<std::ptrdiff_t>(i + sizeof(Voxel)));
  }
  return bytes;
}

struct How
{
  std::string type = "uint8"; // or int16, float
  bool gzip = true;
  bool big = false;
  bool hasNames = true;
};

std::string nrrd(const Grid& grid, const std::vector<Ball>& balls, const How& how)
{
  int layers = 1;
  for (const Ball& ball : balls)
  {
    layers = std::max(layers, ball.layer + 1);
  }
  const auto vector = [](const Vector3d& v)
  {
    std::ostringstream text;
    text.precision(17);
    text << '(' << v.x() << ',' << v.y() << ',' << v.z() << ')';
    return text.str();
  };
  const bool layered = layers > 1;
  std::ostringstream text;
  text << "NRRD0005\n# Complete NRRD file format specification at:\ntype: " << how.type
       << "\ndimension: " << (layered ? 4 : 3) << "\nspace: " << grid.space << "\nsizes: ";
  layered ? text << layers << ' ' : text;
  text << grid.size[0] << ' ' << grid.size[1] << ' ' << grid.size[2]
       << "\nspace directions:" << (layered ? " none" : "");
  for (int axis = 0; axis < 3; ++axis)
  {
    text << ' ' << vector(grid.axes.col(axis));
  }
  text << "\nkinds:" << (layered ? " list" : "")
       << " domain domain domain\nendian: " << (how.big ? "big" : "little")
       << "\nencoding: " << (how.gzip ? "gzip" : "raw") << "\nspace origin: " << vector(grid.origin)
       << '\n';
  for (std::size_t i = 0; how.hasNames && i < balls.size(); ++i)
  {
    const std::string key = "Segment" + std::to_string(i) + "_";
    text << key << "ID:=s" << i << '\n'
         << key << "LabelValue:=" << balls[i].value << '\n'
         << key << "Layer:=" << balls[i].layer << '\n'
         << key << "Name:=" << balls[i].name << '\n';
  }
  const std::string bytes = how.type == "uint8" ? voxelsOf<std::uint8_t>(grid, balls, layers, false)
    : how.type == "int16" ? voxelsOf<std::int16_t>(grid, balls, layers, how.big)
                          : voxelsOf<float>(grid, balls, layers, how.big);
  return text.str() + '\n' + (how.gzip ? deflated(bytes, MAX_WBITS + 16) : bytes);
}

Vector3d centroidMm(vtkPolyData& mesh)
{
  const std::vector<Vector3d> points = pointsOf(mesh);
  Vector3d sum = Vector3d::Zero();
  double volume = 0.0;
  for (const Triangle& t : trianglesOf(mesh))
  {
    const Vector3d& a = points[at(t[0])];
    const Vector3d& b = points[at(t[1])];
    const Vector3d& c = points[at(t[2])];
    const double six = a.dot(b.cross(c));
    volume += six;
    sum += 0.25 * six * (a + b + c);
  }
  return 1e3 * sum / volume;
}

Matrix3d turned(double angle, const Vector3d& axis, const Vector3d& steps)
{
  return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix() * steps.asDiagonal();
}

const std::vector<Grid> kGrids{
  { "left-posterior-superior", Vector3d(2.0, 2.0, 2.0).asDiagonal(), { -31, 17, 205 },
    { 40, 44, 48 } },
  { "right-anterior-superior", Vector3d(1.5, 2.5, 2.0).asDiagonal(), { 12, -140, -33 },
    { 52, 40, 46 } },
  { "left-anterior-superior", turned(0.4, { 1, 2, 3 }, { 2.0, 1.8, 2.2 }), { -80, 5, 11 },
    { 44, 48, 42 } },
  { "left-posterior-superior", turned(-1.1, { 2, -1, 0.5 }, { -2.0, 2.0, 2.4 }), { 300, -50, 7 },
    { 44, 46, 40 } },
};
const Vector3d kMiddle = kGrids[0].axes * Vector3d(19, 21, 23) + kGrids[0].origin;

TEST_F(Images, AnNrrdIsTakenToItsPlaceFromWhateverAxes)
{
  int number = 0;
  for (const Grid& grid : kGrids)
  {
    const Vector3d middle = 0.5 * Vector3d(grid.size[0] - 1, grid.size[1] - 1, grid.size[2] - 1);
    const Vector3d center = inLps(grid, grid.axes * middle + grid.origin);
    const double steps = grid.axes.colwise().norm().maxCoeff();
    for (const How& how : { How{}, How{ "int16", false, true, true },
           How{ "float", true, false, false }, How{ "int16", true, true, false } })
    {
      const auto file = write("ball" + std::to_string(number++) + ".seg.nrrd",
        nrrd(grid,
          { { center + Vector3d(1.0, -2.0, 0.7), 30.0, "Liver", 0, 3 },
            { center + Vector3d(0.0, 0.0, 36.0), 4.0, "Cyst", 0, 7 } },
          how));
      const ImagePart part{ {}, { how.hasNames ? "liver" : "3" } };
      const LoadedSurface surface = readSurface(file, {}, part);
      EXPECT_TRUE(surface.closed);
      EXPECT_EQ(surface.unit, LengthUnit::Millimeter);
      const double exact = 4.0 / 3.0 * std::numbers::pi * std::pow(30.0, 3);
      EXPECT_NEAR(volumeMm3(*surface.mesh), exact, 0.01 * exact); // outward, in a mirror as well
      EXPECT_LT(
        (centroidMm(*surface.mesh) - center - Vector3d(1.0, -2.0, 0.7)).norm(), 0.1 * steps);
    }
  }
}

// the header a file of its own, and the voxels beside it
TEST_F(Images, AnNrrdInTwoFilesIsTakenToItsPlace)
{
  const Grid& grid = kGrids[2];
  const Vector3d center = inLps(grid, grid.axes * Vector3d(21.5, 23.5, 20.5) + grid.origin);
  const double exact = 4.0 / 3.0 * std::numbers::pi * std::pow(30.0, 3);
  for (const How& how : { How{}, How{ "int16", false, true, true } })
  {
    const std::string whole = nrrd(grid, { { center, 30.0, "Liver", 0, 3 } }, how);
    const std::size_t end = whole.find("\n\n");
    const auto header = [&](const std::string& data, const std::string& last = "\n\n")
    { return write("ball.nhdr", whole.substr(0, end) + "\ndata file: " + data + last); };
    write("ball.data", whole.substr(end + 2));
    for (const char* last : { "\n\n", "\n", "" })
    {
      const LoadedSurface surface = readSurface(header("ball.data", last), {}, { {}, { "3" } });
      EXPECT_NEAR(volumeMm3(*surface.mesh), exact, 0.01 * exact);
      EXPECT_LT((centroidMm(*surface.mesh) - center).norm(), 0.1 * 2.2);
    }
    for (const auto& [data, words] : std::vector<std::pair<std::string, std::string>>{
           { "none.data", "its data, 'none.data', are not beside it; copy both" },
           { "../ball.data", "its data are not beside it; put both into one folder" },
           { "/etc/passwd", "its data are not beside it; put both into one folder" },
           { "ball%03d.data 1 9 1", "or several; save it as one .nrrd" } })
    {
      const std::string why = refusal(header(data), { {}, { "3" } });
      EXPECT_NE(why.find(words), std::string::npos) << why;
    }
    write("ball.data", whole.substr(end + 2, 900));
    const std::string why = refusal(header("ball.data"), { {}, { "3" } });
    EXPECT_NE(why.find("cut off"), std::string::npos) << why;
  }
}

// layers may overlap: a tumor is in the liver, and both are whole
TEST_F(Images, LayersOfAnNrrdAreTakenByTheirNames)
{
  const Grid& grid = kGrids[0];
  const Vector3d middle = grid.axes * Vector3d(19.5, 21.5, 23.5) + grid.origin;
  const std::vector<Ball> balls{ { kMiddle, 30.0, "Liver", 0, 1 },
    { middle + Vector3d(8, 0, 4), 12.0, "Tumor, left", 1, 1 },
    { middle - Vector3d(0, 16, 0), 12.0, "Vein", 1, 2 } };
  const auto file = write("layers.seg.nrrd", nrrd(grid, balls, {}));
  for (const Ball& ball : balls)
  {
    if (ball.name.find(',') == ball.name.npos)
    {
      const LoadedSurface one = readSurface(file, {}, { {}, { ball.name } });
      const std::string counted = voxelsOf<std::uint8_t>(grid, { ball }, ball.layer + 1, false);
      const double exact =
        8.0 * static_cast<double>(std::ranges::count(counted, static_cast<char>(ball.value)));
      EXPECT_NEAR(volumeMm3(*one.mesh), exact, 0.01 * exact) << ball.name;
      EXPECT_LT((centroidMm(*one.mesh) - ball.center).norm(), 0.2) << ball.name;
    }
  }
  const std::string known = refusal(file, {});
  EXPECT_NE(known.find("1 Liver ("), std::string::npos) << known;
  EXPECT_NE(known.find("1 Tumor, left ("), std::string::npos) << known;
  EXPECT_NE(known.find("2 Vein ("), std::string::npos) << known;
  EXPECT_NE(known.find(" ml)"), std::string::npos) << known;
  EXPECT_NE(refusal(file, { {}, { "Spleen" } }).find("no label Spleen in it; its labels are 1 Li"),
    std::string::npos);
  EXPECT_NE(refusal(file, { 0.5, {} }).find("a label map"), std::string::npos);
  EXPECT_NE(refusal(file, { {}, { "1" } }).find("more than one label 1 in it; its labels are 1 Li"),
    std::string::npos)
    << "each layer has its own";
  const LoadedSurface once = readSurface(file, {}, { {}, { "Vein" } });
  const LoadedSurface twice = readSurface(file, {}, { {}, { "2", "Vein", "vein" } });
  EXPECT_EQ(pointsOf(*once.mesh), pointsOf(*twice.mesh)) << "by its value and by its name";
  std::vector<Ball> twins = balls;
  twins[2].name = "Liver";
  EXPECT_NE(refusal(write("twins.seg.nrrd", nrrd(grid, twins, {})), { {}, { "Liver" } })
              .find("more than one label Liver in it"),
    std::string::npos);
}

TEST_F(Images, SegmentsWithoutAVoxelAreTold)
{
  const auto file = write("empty.seg.nrrd",
    nrrd(kGrids[0], { { kMiddle, 30.0, "Liver", 0, 1 }, { kMiddle, 0.0, "Cyst", 0, 2 } }, {}));
  const std::string words = "1 segment has no voxel: 'Cyst'";
  const FileOrgans found = readFileOrgans(file, {}, true);
  EXPECT_EQ(std::ranges::count(found.notes, words), 1);
  EXPECT_EQ(found.organs.size(), 1U);
  const FileOrgans one = readFileOrgans(file, { {}, { "Liver" } }, true);
  EXPECT_EQ(std::ranges::count(one.notes, words), 0) << "nobody asked";
  const std::string why = refusal(file, { {}, { "Cyst" } });
  EXPECT_NE(why.find("no label Cyst in it"), std::string::npos) << why;
  EXPECT_NE(why.find(words), std::string::npos) << why;
}

TEST_F(Images, AnNrrdInThePatientsAxesWithoutAnOriginIsWarnedOf)
{
  std::string bytes = nrrd(kGrids[0], { { kMiddle, 30.0, "Liver", 0, 1 } }, {});
  const auto mentions = [&](const char* name)
  {
    const FileOrgans found = readFileOrgans(write(name, bytes), {}, true);
    return std::ranges::any_of(found.notes,
      [](const std::string& note) { return note.find("has no space origin") != note.npos; });
  };
  EXPECT_FALSE(mentions("with.nrrd"));
  bytes.replace(bytes.find("space origin"), 1, "#");
  EXPECT_TRUE(mentions("without.nrrd"));
}

// as teem writes a line break and a backslash in a key's value
TEST_F(Images, TheNameOfASegmentOfAnNrrdMayHaveEscapes)
{
  const auto file =
    write("escapes.seg.nrrd", nrrd(kGrids[0], { { kMiddle, 30.0, R"(a\\n\tb)", 0, 1 } }, {}));
  const FileOrgans found = readFileOrgans(file, {}, true);
  ASSERT_EQ(found.organs.size(), 1U);
  EXPECT_EQ(found.organs[0].name, R"(a\n\tb)");
}

TEST_F(Images, AnNrrdThatIsDamagedIsRefusedByItsFault)
{
  const std::vector<Ball> one{ { kMiddle, 30.0, "Liver", 0, 1 } };
  const std::string raw = nrrd(kGrids[0], one, { "int16", false, false, true });
  const std::string gzip = nrrd(kGrids[0], one, {});
  const auto changed = [](std::string text, const std::string& from, const std::string& to)
  { return text.replace(text.find(from), from.size(), to); };
  std::string flipped = gzip;
  flipped[flipped.size() - 3] ^= 4; // its length
  for (const auto& [bytes, words] :
    std::vector<std::pair<std::string, std::string>>{
      { raw.substr(0, raw.size() - 5), "cut off, its data have 168955 of 168960 bytes" },
      { raw + "12", "its data have 168962 bytes, more than the 168960 that its header claims" },
      { gzip.substr(0, gzip.size() - 40), "cut off, its compressed data end too early" },
      { gzip + "x", "more follows behind its compressed data" },
      { flipped, "its compressed data are damaged, by their checksum" },
      { raw.substr(0, 200), "cut off in its header" },
      { changed(raw, "encoding: raw", "encoding: bzip2"), "its encoding is 'bzip2'" },
      { changed(raw, "encoding: raw", "data file: ../a.raw\nencoding: raw"), "another file" },
      { changed(raw, "encoding: raw", "encoding: raw\nbyte skip: 7"), "a byte skip" },
      { changed(raw, "sizes: 40 44 48", "sizes: 40 44 48000"), "cut off, its data have" },
      { changed(raw, "dimension: 3", "dimension: 2"), "not as many as its dimension" },
      { changed(raw, "type: int16", "type: int99"), "its type is 'int99'" },
      { changed(raw, "space: left", "space: up"), "its space is 'up-posterior-superior'" },
      { changed(raw, "endian: little", "endian: middle"), "its endian is 'middle'" },
      { changed(raw, "40 44 48", "40 44 -48"), "its sizes are '40 44 -48'" },
      { changed(raw, "sizes: 40 44 48", "sizes: 40000 44000 48000"), "of 168960000000000 bytes" },
      { changed(raw, "type: int16", "type: int16\ntype: uint8"), "has 'type' twice" },
      { changed(raw, "Layer:=0", "Layer:=2"), "its segment 'Liver' has the Layer '2', none of 1" },
      { changed(raw, "(0,2,0)", "(2,0,0)"), "do not span space" },
      { "NRRD0005\n\n", "its encoding is ''" } })
  {
    const auto file = write("damaged.nrrd", bytes);
    const std::string why = refusal(file, { {}, { "1" } });
    EXPECT_NE(why.find(words), std::string::npos) << words << ": " << why;
  }
}

} // namespace
} // namespace palp::test
