#include "app/bench/bench.h"
#include "app/bench/bench_dome.h"
#include "app/bench/bench_work.h"
#include "pipeline/motion/moved_surface.h"

namespace palp
{
namespace
{

using namespace units::literals;

constexpr int kFrames = 1000;
constexpr int kFramesAside = 20; // frames of the tool's way to one side

// the times of a frame, once what it needs has been seen
template <typename Frame>
BenchRow benchFrames(const char* work, std::size_t vertices, const char* mode, Frame frame)
{
  for (int i = 0; i < kFramesAside; ++i)
  {
    frame(i);
  }
  return benchRow(work, vertices, mode,
    timed(
      kFrames, [](int) {}, frame));
}

// the dent alone: as many displaced points as wanted, a twentieth of its radius on from frame to
// frame or, on a jump, anywhere
BenchRow benchDent(
  DrawnSurface& drawn, const BenchDome& dome, double touched, const char* mode, bool jump = false)
{
  const double outer = dome.radiusOf(touched);
  const double step = jump ? dome.size / 40.0 : outer / 20.0;
  constexpr int kMiddle = kFramesAside / 2;
  const auto frame = [&](int i)
  { drawn.press(dome.press(outer, step * ((jump ? 7 * i : i) % kFramesAside - kMiddle))); };
  return benchFrames("dent", drawn.zone.size(), mode, frame);
}

// a body that moves as a whole, by as many places and modes as an organ file has
OrganMotionModes motionOn(const Mesh& mesh)
{
  constexpr std::size_t kPlaces = 600;
  constexpr Eigen::Index kModes = 24;
  OrganMotionModes modes{ .radius = 30.0_mm };
  for (std::size_t i = 0; i < kPlaces; ++i)
  {
    modes.places.push_back(
      { mesh.points[i * mesh.points.size() / kPlaces], Eigen::Vector3d::UnitZ(), true });
  }
  modes.loads = Eigen::MatrixXf::Constant(kModes, kPlaces, 1.0F);
  modes.modes = Eigen::MatrixXf::Constant(3 * kPlaces, kModes, 1.0F);
  return modes;
}

// every point and normal of a surface, on top of a dent, which is not counted
BenchRow benchMotion(int n)
{
  const BenchDome dome{ n, kBenchSide };
  const Mesh mesh = dome.mesh();
  DrawnSurface drawn(mesh);
  drawn.press(dome.press(dome.radiusOf(500), 0.0));
  MovedSurface moved(std::make_shared<const OrganMotion>(motionOn(mesh)), drawn.rest);
  DrawnSurface all(mesh);
  const MovedArrays to{ all.points.data(), all.normals.data(), all.displacement.data() };
  const auto frame = [&](int i)
  {
    const OrganLoad load{ .center = mesh.points[static_cast<std::size_t>(100 + i)],
      .normal = Eigen::Vector3d::UnitZ(),
      .force = 1e-6 };
    moved.load({ &load, 1 });
    moved.move(drawn.displacement.data(), drawn.normals.data(), to);
  };
  return benchFrames("motion", mesh.points.size(), "all", frame);
}

} // namespace

std::vector<BenchRow> benchUpdate(std::size_t most)
{
  std::vector<BenchRow> rows;
  const auto vertices = [](int n)
  { return static_cast<std::size_t>(n) * static_cast<std::size_t>(n); };
  for (const int n : { 40, 50, 60, 70, 80, 90, 100 })
  {
    if (vertices(n) <= most)
    {
      VisualUpdate update(n);
      // 2 mm from frame to frame
      rows.push_back(benchFrames(
        "update", vertices(n), "moving", [&](int i) { update(benchPose(20.0_ms * i)); }));
    }
  }
  constexpr int kTwentyThousand = 141;
  if (vertices(kTwentyThousand) <= most)
  {
    rows.push_back(benchMotion(kTwentyThousand));
  }
  for (const int n : { 100, 1000 })
  {
    if (vertices(n) <= most)
    {
      const BenchDome dome{ n, kBenchSide };
      DrawnSurface drawn(dome.mesh());
      rows.push_back(benchDent(drawn, dome, 500, "500"));
      rows.push_back(benchDent(drawn, dome, 2300, "2300"));
      if (n == 1000)
      {
        rows.push_back(benchDent(drawn, dome, 500, "jump", true));
        rows.push_back(benchDent(drawn, dome, 22'800, "22800"));
        rows.push_back(benchDent(drawn, dome, 126'000, "126000"));
      }
    }
  }
  return rows;
}

} // namespace palp
