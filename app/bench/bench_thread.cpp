#include "app/bench/bench.h"
#include "app/bench/bench_work.h"
#include "app/bench/emulated_board.h"
#include "data/shapes.h"
#include "haptics/devices/bus_device.h"
#include "haptics/servo/servo.h"

#include <nlohmann/json.hpp>

#include <ostream>
#include <thread>

namespace palp
{
namespace
{

double microseconds(Histogram::Duration time)
{
  return std::chrono::duration<double, std::micro>(time).count();
}

class CircleDevice final : public Device
{
public:
  [[nodiscard]] DeviceLimits limits() const override
  {
    return benchDevice();
  }

  [[nodiscard]] std::optional<ToolPose> exchange(const Wrench&, double dt) noexcept override
  {
    return benchPose(time_ += dt);
  }

private:
  double time_ = 0.0;
};

void line(std::ostream& out, const char* name, const Histogram& histogram)
{
  if (histogram.count() == 0)
  {
    out << name << ": none was measured\n";
    return;
  }
  out << name << " [us]: p50 " << microseconds(histogram.quantile(0.5)) << ", p99 "
      << microseconds(histogram.quantile(0.99)) << ", p99.9 "
      << microseconds(histogram.quantile(0.999)) << ", max " << microseconds(histogram.longest())
      << '\n';
}

nlohmann::ordered_json row(const char* work, const Histogram& histogram)
{
  const auto told = [&](auto time) // null: of nothing
  { return histogram.count() > 0 ? nlohmann::ordered_json(microseconds(time)) : nullptr; };
  return { { "work", work }, { "count", histogram.count() },
    { "p50_us", told(histogram.quantile(0.5)) }, { "p99_us", told(histogram.quantile(0.99)) },
    { "max_us", told(histogram.longest()) } };
}

void print(std::ostream& out, const ServoFigures& figures)
{
  const Timing& timing = figures.timing;
  out << "servo thread: " << figures.schedule << '\n';
  line(out, "lateness", timing.lateness);
  line(out, "step", timing.step);
  if (figures.board != nullptr)
  {
    line(out, "pose to force at the board", *figures.board);
    line(out, "pose to force as the servo measures it", timing.poseToForce);
  }
  out << "ticks " << timing.ticks << " + skipped " << timing.skipped << " in " << figures.elapsed
      << " s\n";
}

void printJson(std::ostream& out, const ServoFigures& figures)
{
  const Timing& timing = figures.timing;
  nlohmann::ordered_json rows{ row("lateness", timing.lateness), row("step", timing.step) };
  if (figures.board != nullptr)
  {
    rows.push_back(row("pose_to_force", *figures.board));
    rows.push_back(row("pose_to_force_measured", timing.poseToForce));
  }
  const std::uint64_t ticks = timing.ticks;
  const std::uint64_t skipped = timing.skipped;
  const nlohmann::ordered_json all{ { "schedule", figures.schedule },
    { "elapsed_s", figures.elapsed }, { "ticks", ticks }, { "skipped", skipped },
    { "rate_hz", static_cast<double>(ticks) / figures.elapsed }, { "rows", rows } };
  out << all.dump(1) << '\n';
}

} // namespace

void runServo(const ServoBench& bench, const std::function<bool(double)>& watch,
  const std::function<void(const ServoFigures&)>& finished)
{
  using std::chrono::duration_cast;
  const Mesh mesh = makeGrid(100, kBenchSide);
  Scene scene;
  scene.surface = std::make_shared<const Surface>(mesh.points, mesh.triangles);
  scene.armed = true;
  const auto board = std::make_unique<Histogram>();
  const bool isBus = bench.bus.count() > 0.0;
  std::unique_ptr<Device> device;
  if (isBus)
  {
    device = std::make_unique<BusDevice>(
      [&] { return std::make_unique<EmulatedBoard>(bench.bus, *board); }, DevicePlacement{});
  }
  else
  {
    device = std::make_unique<CircleDevice>();
  }
  Servo servo(*device, scene,
    { .period = duration_cast<std::chrono::nanoseconds>(bench.period),
      .spin = bench.spin,
      .processor = bench.processor });
  while (watch(servo.newest().time))
  {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    servo.history().drain([](const Sample&) {});
  }
  finished({ .timing = servo.timing(),
    .board = isBus ? board.get() : nullptr,
    .schedule = servo.schedule(),
    .elapsed = servo.newest().time });
}

void reportServo(std::ostream& out, const ServoBench& bench, bool json)
{
  runServo(
    bench, [&](double elapsed) { return elapsed < bench.duration.count(); },
    [&](const ServoFigures& figures) { json ? printJson(out, figures) : print(out, figures); });
}

} // namespace palp
