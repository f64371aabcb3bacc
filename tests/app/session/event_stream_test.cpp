#include "app/press/body.h"
#include "haptics/surface/ray.h"
#include "haptics/units.h"
#include "tests/app/session/pointer_bench.h"
#include "tests/app/session/pressed_bodies.h"
#include "tests/support/surfaces.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <gtest/gtest.h>
#include <random>
#include <string>
#include <vector>

namespace palp
{
namespace
{

using namespace test;
using namespace units::literals;

Vector3d onSphere(const Vector3d& p)
{
  return Vector3d((p.array() * (EIGEN_PI / 4.0)).tan()).normalized();
}

// 8 mm thick in its middle, nothing at its rim
Shared thinLobe()
{
  return shared(test::cubeMap(24,
    [](const Vector3d& p)
    { return Vector3d(onSphere(p).cwiseProduct(Vector3d(60.0_mm, 40.0_mm, 4.0_mm))); }));
}

// hills and hollows that the larger tools do not fit into
Shared irregular()
{
  return shared(test::cubeMap(30,
    [](const Vector3d& p)
    {
      const Vector3d n = onSphere(p);
      const double hills = std::sin(5.0 * n.x() + 1.0) * std::cos(6.0 * n.y());
      return Vector3d(50.0_mm * (1.0 + 0.25 * hills + 0.1 * std::sin(11.0 * n.z() * n.x())) * n);
    }));
}

Shared liver()
{
  setenv("PALP_DATA", PALP_SHARE, 1);
  static const Shared surface = loadBody({ { .bundled = "liver" } }, false).haptic;
  return surface;
}

// a hand on a mouse: strokes, jumps, presses, notches, at a rate from a busy to a fast machine
void play(test::PointerBench& bench, double rate, unsigned seed, double duration)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> fraction(0.0, 1.0);
  const auto pixel = [&] { return 100.0 + 600.0 * fraction(random); };
  PointerTool& pointer = bench.pointer;
  Eigen::Vector2d at(400, 400);
  Eigen::Vector2d speed(0, 0); // [pixels/s]
  int down = -1;               // y of the button
  while (bench.now < duration)
  {
    bench.runTo(
      bench.now - std::log(1.0 - fraction(random)) / rate, fraction(random) < 0.02 ? 0.02 : 1e-3);
    const double what = fraction(random);
    speed = fraction(random) < 0.1 ? Eigen::Vector2d(2000 * fraction(random) - 1000, pixel() - 400)
                                   : speed;
    at += speed / rate;
    at = fraction(random) < 0.03 || (at.array() - 400).abs().maxCoeff() > 350
      ? Eigen::Vector2d(pixel(), pixel())
      : at;
    const int x = static_cast<int>(at.x());
    const int y = static_cast<int>(at.y());
    if (what < 0.06 && down < 0)
    {
      down = y;
      pointer.press(x, y, bench.now);
    }
    else if (what < 0.12 && down >= 0)
    {
      down = -1;
      pointer.release(bench.now);
    }
    else if (what > 0.99)
    {
      pointer.letGo();
    }
    else if (what > 0.85)
    {
      pointer.wheel(what > 0.88 ? 1 : -1);
    }
    else if (down >= 0)
    {
      pointer.drag(down - y);
    }
    else
    {
      pointer.hover(x, y);
    }
  }
}

// One line of a recorded minute of a person at a mouse.
struct MouseEvent
{
  double time; // [s]
  std::string what;
  Eigen::Vector2d at; // [pixels], from the bottom left
};

std::vector<MouseEvent> recorded(const std::string& user)
{
  std::ifstream in(std::string(PALP_SOURCE_DIR) + "/data/reference/mouse_" + user + ".csv");
  std::vector<MouseEvent> events;
  for (std::string line; std::getline(in, line);)
  {
    double x = 0.0;
    double y = 0.0;
    double time = 0.0;
    std::array<char, 16> button{};
    std::array<char, 16> state{};
    if (std::sscanf(line.c_str(), "%lf,%15[^,],%15[^,],%lf,%lf", &time, button.data(), state.data(),
          &x, &y) == 5)
    {
      events.push_back({ time, std::string(button.data()) + ' ' + state.data(), { x, -y } });
    }
  }
  return events;
}

// the recorded minute over the middle of the view, so many times as fast
void replay(test::PointerBench& bench, const std::vector<MouseEvent>& events, double speed)
{
  Eigen::AlignedBox2d box;
  for (const MouseEvent& event : events)
  {
    box.extend(event.at);
  }
  const double scale = 600.0 / box.sizes().maxCoeff();
  int down = 0; // y of the button
  for (const auto& [time, what, at] : events)
  {
    bench.runTo(time / speed);
    const int x = static_cast<int>(400.0 + scale * (at.x() - box.center().x()));
    const int y = static_cast<int>(400.0 + scale * (at.y() - box.center().y()));
    if (what == "Left Pressed")
    {
      down = y;
      bench.pointer.press(x, y, bench.now);
    }
    else if (what == "Left Released")
    {
      bench.pointer.release(bench.now);
    }
    else if (what == "NoButton Drag")
    {
      bench.pointer.drag(down - y);
    }
    else if (what == "Scroll Up" || what == "Scroll Down")
    {
      bench.pointer.wheel(what == "Scroll Up" ? 1 : -1);
    }
    else
    {
      bench.pointer.hover(x, y);
    }
  }
}

// no deeper than asked for, nor than half the thickness; number of samples that touch
int expectSound(const test::PointerBench& bench, const Surface& surface, const std::string& where)
{
  int touching = 0;
  EXPECT_LT(bench.excess(), kAllowed) << where;
  testing::Test::RecordProperty(
    "excess_mm " + where.substr(0, 40), std::to_string(units::toMillimeters(bench.excess())));
  for (std::size_t i = 1; i < bench.ticks.size(); ++i)
  {
    const Contact& contact = bench.ticks[i].sample.contact;
    touching += contact.touching() ? 1 : 0;
    if (contact.depth > bench.ticks[i - 1].sample.contact.depth)
    {
      const double below = rayExit(surface.tree(), contact.center, -contact.normal).distance;
      // it presses, with its end
      const bool isSound = contact.depth < 0.5 * below + kAllowed && contact.tilt < 65.0_deg;
      EXPECT_TRUE(isSound) << where << " at " << bench.ticks[i].time;
      if (!isSound)
      {
        break;
      }
    }
  }
  return touching;
}

struct Stream
{
  std::string name;
  Shared (*surface)();
  double rate; // [1/s]
};

class EventStream : public ::testing::TestWithParam<Stream>
{
};

TEST_P(EventStream, RecordsNoSampleDeeperThanAskedForOrThanHalfTheThickness)
{
  const Shared surface = GetParam().surface();
  const std::vector<Tip> tips{ SphereTip{ 10.0_mm }, SphereTip{ 3.0_mm }, ConeTip{ 0.7, 10.0_mm },
    ConeTip{ 0.7, 5.0_mm }, PunchTip{ 5.0_mm } };
  std::mt19937 random(7);
  std::normal_distribution<double> component;
  unsigned seed = 0;
  int touching = 0;
  for (const Tip& tip : tips)
  {
    test::PointerBench bench(
      surface, tip, Vector3d(component(random), component(random), component(random)));
    play(bench, GetParam().rate, ++seed, 6.0);
    touching += expectSound(
      bench, *surface, "tip " + std::to_string(tip.index()) + ", seed " + std::to_string(seed));
    for (std::size_t i = 1; i < bench.ticks.size(); ++i)
    {
      const Contact& contact = bench.ticks[i].sample.contact;
      if (contact.depth > bench.ticks[i - 1].sample.contact.depth)
      {
        ASSERT_LT(contact.depth, 0.5 * contact.thickness + kAllowed) << bench.ticks[i].time;
      }
    }
  }
  EXPECT_GT(touching, 1000);
}

INSTANTIATE_TEST_SUITE_P(All, EventStream,
  ::testing::Values(Stream{ "LiverSlow", liver, 5.0 }, Stream{ "Liver", liver, 60.0 },
    Stream{ "LiverFast", liver, 200.0 }, Stream{ "LobeSlow", thinLobe, 5.0 },
    Stream{ "Lobe", thinLobe, 60.0 }, Stream{ "BlockSlow", block, 8.0 },
    Stream{ "BlockFast", block, 200.0 }, Stream{ "IrregularSlow", irregular, 5.0 },
    Stream{ "Irregular", irregular, 60.0 }),
  [](const auto& each) { return each.param.name; });

// people at a mouse, at 6 and 32 events/s on average, a third, and six times as many
TEST(Person, RecordsNoSampleDeeperThanAskedFor)
{
  int touching = 0;
  for (const char* user : { "user15", "user9" })
  {
    const std::vector<MouseEvent> events = recorded(user);
    ASSERT_GT(events.size(), 300U);
    for (const auto& surface : { liver(), thinLobe(), irregular() })
    {
      for (const double speed : { 1.0 / 3.0, 1.0, 6.0 })
      {
        test::PointerBench bench(surface, SphereTip{ 5.0_mm }, Vector3d(0.3, 0.2, 1.0));
        replay(bench, events, speed);
        touching += expectSound(bench, *surface, std::string(user) + " x " + std::to_string(speed));
      }
    }
  }
  EXPECT_GT(touching, 100'000); // not each body is where each of them points
}

// what a held press did on the liver: jumps of one event each, and strokes in steps of 4 pixels
TEST(HeldPress, FollowsTheLiverOverJumpsAndStrokes)
{
  test::PointerBench bench(liver(), SphereTip{ 10.0_mm }, kAbove);
  bench.pointer.hover(400, 400);
  bench.pointer.wheel(8);
  bench.run(0.3);
  ASSERT_NEAR(bench.newest().contact.depth, 4.0_mm, 0.02_mm);
  for (const int x : { 330, 470, 350, 500, 400, 320, 480 })
  {
    bench.pointer.hover(x, 400 + (x % 3) * 20);
    bench.run(0.5);
    ASSERT_NEAR(bench.newest().contact.depth, 4.0_mm, 0.02_mm) << x;
  }
  for (const double speed : { 200.0, 400.0 }) // [pixels/s]
  {
    for (int x = 480; x > 330; x -= 4)
    {
      bench.pointer.hover(x, 400);
      bench.run(4.0 / speed);
      EXPECT_NEAR(bench.newest().contact.depth, 4.0_mm, 0.2_mm) << speed << ' ' << x;
    }
    bench.pointer.hover(480, 400);
    bench.run(0.5);
  }
  EXPECT_LT(bench.excess(), kAllowed);
}

} // namespace
} // namespace palp
