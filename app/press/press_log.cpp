#include "app/press/press_log.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>
#include <utility>

namespace palp
{
namespace
{

// from the last sample before a time on
Recording partOf(const Recording& recording, double from)
{
  Recording part = recording.head();
  part.names.clear();
  const std::vector<Sample>& all = recording.samples;
  auto first = std::ranges::lower_bound(all, from, {}, &Sample::time);
  first -= first == all.begin() ? 0 : 1;
  const auto leftOut = static_cast<std::size_t>(first - all.begin());
  part.thinned = recording.thinned - std::min(recording.thinned, leftOut);
  part.samples.assign(first, all.end());
  if (recording.second)
  {
    const std::vector<Sample>& others = recording.second->samples;
    auto second = std::ranges::lower_bound(others, from, {}, &Sample::time);
    second -= second == others.begin() ? 0 : 1;
    part.second.emplace().device = recording.second->device;
    part.second->samples.assign(second, others.end());
  }
  return part;
}

// its samples as far apart as a step, in depth or force by their largest; the deepest and the last
std::vector<CurvePoint> curveBySteps(
  std::span<const Sample> press, const Sample* deepest, double step)
{
  const auto forceOf = [](const Sample& sample) { return std::abs(sample.response.force); };
  const double most = forceOf(*std::ranges::max_element(press, {}, forceOf));
  std::vector<CurvePoint> curve;
  for (const Sample& sample : press)
  {
    const CurvePoint point{ sample.contact.depth, sample.response.force };
    const bool isFar = curve.empty() ||
      std::abs(point.depth - curve.back().depth) >= step * deepest->contact.depth ||
      std::abs(point.force - curve.back().force) >= step * most;
    if (isFar || &sample == deepest || &sample == &press.back())
    {
      curve.push_back(point);
    }
  }
  return curve;
}

// even along the curve: by time, the points would be of where the tool is held
std::vector<CurvePoint> curveOf(const PressSummary& press, const Recording& recording)
{
  const std::vector<Sample>& all = recording.samples;
  const auto first = std::ranges::lower_bound(all, press.begin, {}, &Sample::time);
  const auto end = std::ranges::upper_bound(all, press.end, {}, &Sample::time);
  const std::span samples(first, end);
  const Sample* deepest = deepestOf(samples);
  if (deepest == nullptr)
  {
    return {};
  }
  constexpr double kFinest = 1.0 / 200;
  std::vector<CurvePoint> curve;
  for (double step = kFinest; curve.empty() || curve.size() > KeptPress::kCurve; step *= 2.0)
  {
    curve = curveBySteps(samples, deepest, step);
  }
  return curve;
}

// no two have a place to the bit
bool isSame(const PressSummary& a, const PressSummary& b) noexcept
{
  return a.begin == b.begin && a.deepest.depth == b.deepest.depth &&
    a.deepest.center == b.deepest.center;
}

} // namespace

void PressLog::follow(const Sample& sample) noexcept
{
  now_ = sample.time;
  if (sample.contact.touching())
  {
    begin_ = begin_.value_or(sample.time);
    lastTouch_ = sample.time;
  }
}

std::optional<Recording> PressLog::keep(const Recording& recording)
{
  return isReleased() ? end(recording) : std::nullopt;
}

std::optional<Recording> PressLog::end(const Recording& recording)
{
  if (!begin_)
  {
    return {};
  }
  Recording part = partOf(recording, *std::exchange(begin_, std::nullopt));
  keepAll(part);
  for (auto at = firstKept(); at != presses_.end(); ++at)
  {
    part.names.push_back(at->summary.name);
  }
  return part;
}

std::size_t PressLog::keepAll(const Recording& samples)
{
  const std::vector<PressSummary> found = findPresses(samples);
  firstNew_ = found_ + 1;
  for (const PressSummary& one : found)
  {
    const Scene& organ = organOf(samples.scene, one.organ);
    KeptPress press{ .id = ++found_,
      .summary = one,
      .organ = samples.organName(one.organ),
      .mesh = samples.mesh,
      .law = organ.law,
      .rule = organ.rule,
      .damping = organ.damping,
      .isInBody = organ.series != nullptr };
    press.summary.name = !samples.names.empty() ? freeName(one.name)
      : next_.empty()                           ? nextName()
                                                : freeName(std::exchange(next_, {}));
    if (samples.rated)
    {
      press.outside = outsideLimits(organ, Validity(organ.law), one.deepest);
    }
    press.curve = curveOf(one, samples);
    presses_.push_back(std::move(press));
    ++version_;
  }
  if (presses_.size() > kMost)
  {
    presses_.erase(presses_.begin(), presses_.end() - kMost);
  }
  return found.size();
}

PressNames PressLog::names() const
{
  std::vector<PressSummary> all = gone_;
  std::ranges::transform(presses_, std::back_inserter(all), &KeptPress::summary);
  return [all = std::move(all)](const Recording& recording)
  {
    std::vector<std::string> names;
    for (const PressSummary& press : findPresses(recording))
    {
      const auto known = std::ranges::find_if(
        all, [&press](const PressSummary& other) { return isSame(press, other); });
      names.push_back(known != all.end() ? known->name : press.name);
    }
    return names;
  };
}

const KeptPress* PressLog::find(int id) const noexcept
{
  const auto at = std::ranges::find(presses_, id, &KeptPress::id);
  return at != presses_.end() ? &*at : nullptr;
}

// as wanted, or with a number behind it where a press has that name
std::string PressLog::freeName(const std::string& wanted) const
{
  std::string name = wanted;
  const auto isOf = [&name](const KeptPress& press) { return press.summary.name == name; };
  for (int i = 2; std::ranges::any_of(presses_, isOf); ++i)
  {
    name = wanted + " (" + std::to_string(i) + ')';
  }
  return name;
}

// by its number, or by the next that no press has
std::string PressLog::nextName() const
{
  auto index = static_cast<std::size_t>(found_ - 1);
  while (freeName(pressName(index)) != pressName(index))
  {
    ++index;
  }
  return pressName(index);
}

std::vector<KeptPress>::iterator PressLog::firstKept() noexcept
{
  return std::ranges::lower_bound(presses_, firstNew_, {}, &KeptPress::id);
}

void PressLog::noteSaved(int number) noexcept
{
  std::for_each(firstKept(), presses_.end(), [number](KeptPress& press) { press.saved = number; });
}

void PressLog::noteExported(int id) noexcept
{
  for (KeptPress& press : presses_)
  {
    press.saved = press.id <= id ? KeptPress::kElsewhere : press.saved;
  }
}

std::vector<std::string> PressLog::namesOf(int saved) const
{
  std::vector<std::string> names;
  for (const KeptPress& press : presses_)
  {
    press.saved == saved ? names.push_back(press.summary.name) : void();
  }
  return names;
}

void PressLog::rename(int id, const std::string& name)
{
  if (const auto at = std::ranges::find(presses_, id, &KeptPress::id); at != presses_.end())
  {
    at->summary.name = at->summary.name == name ? name : freeName(name);
  }
  ++version_;
}

void PressLog::remove(int id)
{
  if (const KeptPress* press = find(id))
  {
    gone_.push_back(press->summary);
    gone_.back().name.clear();
    presses_.erase(presses_.begin() + (press - presses_.data()));
  }
  ++version_;
}

void PressLog::restore(KeptPress press)
{
  std::erase_if(gone_, [&](const PressSummary& gone) { return isSame(gone, press.summary); });
  const auto place = std::ranges::lower_bound(presses_, press.id, {}, &KeptPress::id);
  presses_.insert(place, std::move(press));
  ++version_;
}

} // namespace palp
