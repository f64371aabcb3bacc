#include "app/press/review.h"

#include <algorithm>
#include <cassert>
#include <iterator>

namespace palp
{
namespace
{

bool touches(const Sample& sample)
{
  return sample.contact.touching();
}

// of the sample before the first contact
double beginOf(const std::vector<Sample>& samples)
{
  const auto first = std::ranges::find_if(samples, touches);
  assert(first != samples.end());
  return (first == samples.begin() ? first : std::prev(first))->time;
}

// of the one after the last
double endOf(const std::vector<Sample>& samples)
{
  const auto last = std::find_if(samples.rbegin(), samples.rend(), touches);
  return (last == samples.rbegin() ? last : std::prev(last))->time;
}

} // namespace

const Sample* nearestSample(std::span<const Sample> samples, double time) noexcept
{
  if (samples.empty())
  {
    return nullptr;
  }
  const auto later = std::ranges::lower_bound(samples, time, {}, &Sample::time);
  if (later == samples.begin())
  {
    return &samples.front();
  }
  const auto earlier = std::prev(later);
  const bool isLater = later != samples.end() && later->time - time < time - earlier->time;
  return isLater ? &*later : &*earlier;
}

Review::Review(const Recording& recording)
  : begin_(beginOf(recording.samples))
  , head_(endOf(recording.samples) - begin_)
{
}

} // namespace palp
