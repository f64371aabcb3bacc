#include "haptics/devices/identify/swing.h"

#include <Eigen/Core>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace palp
{
namespace
{

constexpr double kGrid = 0.25e-3; // [s]
constexpr int kDelays = 33;       // to 8 ms
constexpr int kLook = 20;         // grid points on either side that tell a direction

struct Even
{
  std::vector<double> position;             // [m]
  std::vector<std::array<double, 3>> force; // [N]
  std::vector<std::size_t> late;            // points before it that a late exchange was at
};

using Forces = Eigen::Matrix<double, kDelays, 3>; // a row for each delay

// from each exchange to the next [s]
std::vector<double> passed(const Swing& swing)
{
  std::vector<double> between;
  for (std::size_t i = 1; i < swing.time.size(); ++i)
  {
    between.push_back(swing.time[i] - swing.time[i - 1]);
  }
  return between;
}

// from which on an exchange was held up, so that neither of its times is to be believed [s]
double latest(std::vector<double> between)
{
  constexpr double kUsual = 0.5e-3; // that a thread waits for its turn [s]
  const auto middle = between.begin() + static_cast<std::ptrdiff_t>(between.size() / 2);
  std::ranges::nth_element(between, middle);
  return 1.5 * *middle + kUsual;
}

// positions between exchanges lie on a line, forces are held
Even onGrid(const Swing& swing)
{
  Even even;
  const double late = latest(passed(swing));
  std::size_t at = 0;
  std::size_t sent = 0;
  for (double t = swing.time.front(); t < swing.time.back(); t += kGrid)
  {
    while (swing.time[at + 1] <= t)
    {
      ++at;
    }
    while (sent + 1 < swing.sent.size() && swing.sent[sent + 1] <= t)
    {
      ++sent;
    }
    const double share = (t - swing.time[at]) / (swing.time[at + 1] - swing.time[at]);
    even.position.push_back(
      swing.position[at] + share * (swing.position[at + 1] - swing.position[at]));
    even.force.push_back(swing.force[sent]);
    const bool isLate = swing.time[at + 1] - swing.time[at] > late;
    even.late.push_back((even.late.empty() ? 0 : even.late.back()) + (isLate ? 1 : 0));
  }
  return even;
}

// -1, 0 or 1 at each point
std::vector<int> directions(const Even& even, double step)
{
  const double least = std::max(2.0 * step, 40e-6);
  std::vector<int> direction(even.position.size(), 0);
  for (std::size_t i = kLook; i + kLook < direction.size(); ++i)
  {
    const double change = even.position[i + kLook] - even.position[i - kLook];
    direction[i] = std::abs(change) < least ? 0 : change > 0.0 ? 1 : -1;
  }
  return direction;
}

struct Windows
{
  std::vector<Eigen::Vector4d> rows; // of mass, damping, friction, load
  std::vector<Forces> forces;
};

// lengths of the motions in one direction, in grid points
void addRuns(std::vector<std::size_t>& runs, const std::vector<int>& direction)
{
  std::size_t run = 0;
  for (std::size_t i = 1; i < direction.size(); ++i)
  {
    run = direction[i] != 0 && direction[i] == direction[i - 1] ? run + 1 : 0;
    if (run > 0 && (i + 1 == direction.size() || direction[i + 1] != direction[i]))
    {
      runs.push_back(run);
    }
  }
}

// than which half of all motion is longer
std::size_t typicalRun(std::vector<std::size_t> runs)
{
  std::ranges::sort(runs);
  const std::size_t all = std::reduce(runs.begin(), runs.end());
  std::size_t passed = 0;
  const auto half = std::ranges::find_if(runs,
    [&](std::size_t one)
    {
      passed += one;
      return 2 * passed >= all;
    });
  return half == runs.end() ? 0 : *half;
}

void addWindow(Windows& windows, const Even& even, std::size_t from, std::size_t length, int way)
{
  using std::numbers::pi;
  const double duration = kGrid * static_cast<double>(length);
  const double middle = even.position[from + length / 2]; // near zero, for the sake of rounding
  Eigen::Vector4d row = Eigen::Vector4d::Zero();
  Forces forces = Forces::Zero();
  for (std::size_t i = 0; i <= length; ++i)
  {
    const double angle = 2.0 * pi * static_cast<double>(i) / static_cast<double>(length);
    const double weight = 0.5 * (1.0 - std::cos(angle)) * kGrid; // sin^2 of half the angle
    const double slope = pi / duration * std::sin(angle) * kGrid;
    const double bend = 2.0 * pi * pi / (duration * duration) * std::cos(angle) * kGrid;
    const double x = even.position[from + i] - middle;
    row += Eigen::Vector4d(bend * x, -slope * x, way * weight, weight);
    for (int d = 0; d < kDelays; ++d)
    {
      forces.row(d) +=
        weight * Eigen::RowVector3d::Map(even.force[from + i - static_cast<std::size_t>(d)].data());
    }
  }
  windows.rows.emplace_back(row / duration);
  windows.forces.emplace_back(forces / duration);
}

void addWindows(
  Windows& windows, const Even& even, const std::vector<int>& direction, std::size_t length)
{
  const std::size_t stride = std::max<std::size_t>(1, length / 6);
  std::size_t run = 0;
  std::size_t next = 0;
  for (std::size_t i = kDelays; i < direction.size(); ++i)
  {
    run = direction[i] != 0 && direction[i] == direction[i - 1] ? run + 1 : 0;
    if (run > length && i >= next && i > length + kDelays)
    {
      next = i + stride;
      if (even.late[i] == even.late[i - length - kDelays])
      {
        addWindow(windows, even, i - length, length, direction[i]);
      }
    }
  }
}

SwingModel solve(const Windows& windows, std::optional<double> delay)
{
  const auto count = static_cast<Eigen::Index>(windows.rows.size());
  SwingModel best;
  best.residual = HUGE_VAL;
  const int first =
    delay ? std::clamp(static_cast<int>(std::lround(*delay / kGrid)), 0, kDelays - 1) : 0;
  for (int d = first; d < (delay ? first + 1 : kDelays); ++d)
  {
    Eigen::Matrix<double, Eigen::Dynamic, 6> rows(count, 6);
    Eigen::VectorXd forces(count);
    for (Eigen::Index i = 0; i < count; ++i)
    {
      const auto at = static_cast<std::size_t>(i);
      const Eigen::RowVector3d told = windows.forces[at].row(d);
      rows.row(i) << windows.rows[at].transpose(), -told.tail<2>();
      forces[i] = told[0];
    }
    const Eigen::Vector<double, 6> found = rows.colPivHouseholderQr().solve(forces);
    const double residual = (rows * found - forces).norm() / std::max(forces.norm(), 1e-12);
    if (residual < best.residual)
    {
      best = { found[0], std::max(0.0, found[1]), std::max(0.0, found[2]), found[3], d * kGrid,
        residual };
    }
  }
  return best;
}

} // namespace

double lateShare(std::span<const Swing> swings)
{
  std::size_t all = 0;
  std::size_t late = 0;
  for (const Swing& swing : swings)
  {
    if (swing.time.size() > 2)
    {
      const std::vector<double> between = passed(swing);
      const double most = latest(between);
      all += between.size();
      late += static_cast<std::size_t>(
        std::ranges::count_if(between, [most](double one) { return one > most; }));
    }
  }
  return all > 0 ? static_cast<double>(late) / static_cast<double>(all) : 0.0;
}

SwingModel fitSwings(std::span<const Swing> swings, double step, std::optional<double> delay)
{
  constexpr std::size_t kLeast = 40;  // grid points of a window: 10 ms
  constexpr std::size_t kMost = 1000; // 250 ms
  constexpr std::size_t kEnough = 8;
  std::vector<Even> evens;
  std::vector<std::vector<int>> ways;
  std::vector<std::size_t> runs;
  for (const Swing& swing : swings)
  {
    if (swing.time.size() > 2)
    {
      evens.push_back(onGrid(swing));
      ways.push_back(directions(evens.back(), step));
      addRuns(runs, ways.back());
    }
  }
  const std::size_t length = std::clamp(typicalRun(runs) / 2, kLeast, kMost);
  Windows windows;
  for (std::size_t i = 0; i < evens.size(); ++i)
  {
    addWindows(windows, evens[i], ways[i], length);
  }
  return windows.rows.size() < kEnough ? SwingModel{} : solve(windows, delay);
}

} // namespace palp
