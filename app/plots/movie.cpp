#include "app/plots/movie.h"

#include "app/press/review.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace palp
{
namespace
{

constexpr double kBeside = 0.4; // before and after the contact [s]
constexpr double kAround = 6.0; // [s]

std::vector<MovieFrame> replay(std::span<const Sample> samples)
{
  const auto touches = [](const Sample& sample) { return sample.contact.touching(); };
  const auto first = std::ranges::find_if(samples, touches);
  const auto last = std::find_if(samples.rbegin(), samples.rend(), touches);
  const bool isTouched = first != samples.end();
  const double begin = isTouched ? first->time - kBeside : samples.front().time;
  const double end = isTouched ? last->time + kBeside : samples.back().time;
  std::vector<MovieFrame> frames;
  for (int i = 0; begin + i / static_cast<double>(kMovieRate) <= end; ++i)
  {
    frames.push_back({ nearestSample(samples, begin + i / static_cast<double>(kMovieRate)) });
  }
  return frames;
}

} // namespace

std::vector<MovieFrame> movieFrames(
  MovieKind kind, std::span<const Sample> samples, const Sample& shown)
{
  if (kind == MovieKind::Replay)
  {
    return replay(samples);
  }
  std::vector<MovieFrame> frames(static_cast<std::size_t>(kMovieRate * kAround), { &shown });
  for (std::size_t i = 0; i < frames.size(); ++i)
  {
    frames[i].turn =
      2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(frames.size());
  }
  return frames;
}

} // namespace palp
