#pragma once

#include "haptics/servo/timing.h"

#include <chrono>
#include <cstddef>
#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

namespace palp
{

/// One figure of the benchmark, over many repetitions.
struct BenchRow
{
  /// servo_step, law, memory, update, dent, frame, query_brute, tree_build or baseline
  std::string work;
  std::size_t vertices = 0; ///< of the mesh; 0 where there is none
  std::string mode;         ///< moving, jump, cold, paced, still, or how many points are displaced
  std::string variant{};    ///< of a law, tissue or baseline: which one, "" for the scene's own
  double median = 0.0;      ///< [us], as are those below
  double mean = 0.0;
  double deviation = 0.0;
  double p99 = 0.0;
};

/// @param microseconds  at least one, in any order
[[nodiscard]] BenchRow benchRow(
  std::string work, std::size_t vertices, std::string mode, std::vector<double> microseconds);

/// Time of one call [us], after `before`, which is not counted.
template <typename Before, typename Work>
[[nodiscard]] std::vector<double> timed(int count, Before before, Work work)
{
  std::vector<double> microseconds;
  microseconds.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i)
  {
    before(i);
    const auto begin = std::chrono::steady_clock::now();
    work(i);
    const std::chrono::duration<double, std::micro> time = std::chrono::steady_clock::now() - begin;
    microseconds.push_back(time.count());
  }
  return microseconds;
}

/// S, by which figures of different machines compare: a scalar sweep over 10,000 points [us].
[[nodiscard]] double benchSweep();

/// The law alone: the scene's own, which is the paper's for a sphere; then cone, exact sphere, and
/// all factors of the corrected law for a sphere; and what relaxation and friction add to a step.
[[nodiscard]] std::vector<BenchRow> benchLaw();

/// Contact, law and safety chain on the paper's surfaces and on larger ones, and what they are
/// made of.
/// @param most   vertices of the largest surface
/// @param ticks  of each measurement; a quarter of them at the pace of 1 kHz, a fortieth cold
[[nodiscard]] std::vector<BenchRow> benchServo(std::size_t most, int ticks);

/// Contact, law, deformed points and their normals: what one picture costs the processor; and the
/// last two alone by the number of displaced points, on meshes of 10,000 and 1,000,000.
/// @param most  vertices of the largest surface
[[nodiscard]] std::vector<BenchRow> benchUpdate(std::size_t most);

/// The methods of Fig. 12 on the paper's smallest surface along one path: ours, springs, elements.
///
/// A step of 10 ms of a block 50 mm high whose top that surface is; see fem::StepSettings.
[[nodiscard]] std::vector<BenchRow> benchBaselines();

/// Writes how far the force on coarse meshes is from that on a fine one, for each rule of contact,
/// and how smooth it is on a slide over facets.
void reportAccuracy(std::ostream& out);

/// How a servo is measured.
struct ServoBench
{
  std::chrono::duration<double> duration{ 60.0 };
  std::chrono::duration<double> bus{ 0.0 }; ///< of an exchange with an emulated board; 0: none
  std::chrono::duration<double> period{ 0.001 };
  std::chrono::nanoseconds spin{ 0 };
  int processor = -1; ///< below 0: any
};

/// What a servo thread did, and what the board at the end of its bus saw.
struct ServoFigures
{
  const Timing& timing;
  Histogram* board = nullptr; ///< from a pose to its force by the board's clock; null: no bus
  std::string schedule;
  double elapsed = 0.0; ///< [s]
};

/// Lets a servo thread touch a surface of 10,000 points with a tool that circles in it.
/// @param watch     asked ten times a second, with the seconds so far; false ends the run
/// @param finished  gets what the thread counted
void runServo(const ServoBench& bench, const std::function<bool(double)>& watch,
  const std::function<void(const ServoFigures&)>& finished);

/// Writes how well a servo thread keeps its rate, and how late its forces are at a board.
/// @param json  for programs
void reportServo(std::ostream& out, const ServoBench& bench, bool json);

} // namespace palp
