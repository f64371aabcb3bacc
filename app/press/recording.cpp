#include "app/press/recording.h"

#include "haptics/contact/contact_geometry_of.h"
#include "haptics/contact/embed_nodules.h"
#include "haptics/contact/embed_stiffness.h"
#include "haptics/servo/tissue_at.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

namespace palp
{

namespace
{

// of each interval the extremes; returns how many are left of those from begin to end
std::size_t thinRange(
  std::vector<Sample>& samples, std::size_t begin, std::size_t end, double interval)
{
  const auto depth = [](const Sample& sample) { return sample.contact.depth; };
  const auto force = [](const Sample& sample) { return sample.response.force; };
  auto left = samples.begin() + static_cast<std::ptrdiff_t>(begin);
  const auto stop = samples.begin() + static_cast<std::ptrdiff_t>(end);
  for (auto at = left; at != stop;)
  {
    const double number = std::floor(at->time / interval);
    const auto next = std::find_if(
      at, stop, [&](const Sample& sample) { return std::floor(sample.time / interval) != number; });
    const std::array extremes{ std::ranges::min_element(at, next, {}, depth),
      std::ranges::max_element(at, next, {}, depth), std::ranges::min_element(at, next, {}, force),
      std::ranges::max_element(at, next, {}, force) };
    std::array<Sample, extremes.size()> kept;
    const auto last = std::copy_if(at, next, kept.begin(),
      [&, from = at](const Sample&) mutable
      { return std::ranges::find(extremes, from++) != extremes.end(); });
    left = std::copy(kept.begin(), last, left);
    at = next;
  }
  samples.erase(left, stop);
  return static_cast<std::size_t>(left - samples.begin()) - begin;
}

// of a hand those of contact, and their neighbors
template <typename Track>
void keepContactOf(Track& track)
{
  const std::vector<Sample>& all = track.samples;
  const auto touches = [&](std::size_t i) { return i < all.size() && all[i].contact.touching(); };
  const bool none = deepestOf(all) == nullptr;
  std::vector<Sample> kept;
  std::size_t thinned = 0;
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    const bool isEnd = none && (i == 0 || i + 1 == all.size());
    if (touches(i - 1) || touches(i) || touches(i + 1) || isEnd) // 0 - 1 is beyond the end
    {
      kept.push_back(all[i]);
      thinned += i < track.thinned ? 1 : 0;
    }
  }
  track.samples = std::move(kept);
  track.thinned = thinned;
}

template <typename Track>
void boundTrack(Track& track, std::size_t kept)
{
  const std::size_t minute = kept / 10; // at a time, so that moving the rest is rare
  std::vector<Sample>& samples = track.samples;
  if (samples.size() > minute) // from here on no copy of all is made to grow by
  {
    samples.reserve(kept + 4 * minute);
  }
  // of a fixed number in all, of which those left out take none: what is full grows no more
  if (samples.size() > kept + 3 * minute)
  {
    const std::size_t first = track.thinned;
    track.thinned += thinRange(samples, first, first + minute, track.interval);
    while (track.thinned > 2 * minute)
    {
      track.interval *= 2.0;
      track.thinned = thinRange(samples, 0, track.thinned, track.interval);
    }
  }
}

template <typename Track>
void thinTrack(Track& track)
{
  track.thinned = thinRange(track.samples, 0, track.samples.size(), track.interval);
  track.samples.shrink_to_fit();
}

} // namespace

void keepContact(Recording& recording)
{
  recording.contactOnly = true;
  keepContactOf(recording);
  recording.second ? keepContactOf(*recording.second) : void();
}

void bound(Recording& recording, std::size_t kept)
{
  boundTrack(recording, kept);
  recording.second ? boundTrack(*recording.second, kept) : void();
}

void append(Recording& recording, std::vector<Sample> samples)
{
  constexpr double kApart = 1.0; // [s]
  std::vector<Sample>& all = recording.samples;
  if (all.empty())
  {
    all = std::move(samples);
    return;
  }
  const double late = samples.empty() ? 0.0 : all.back().time + kApart - samples.front().time;
  for (Sample& sample : samples)
  {
    sample.time += late > kApart ? late : 0.0;
  }
  all.insert(all.end(), samples.begin(), samples.end());
}

void thin(Recording& recording)
{
  thinTrack(recording);
  recording.second ? thinTrack(*recording.second) : void();
}

namespace
{

// what the compliance of the body answers, where the law alone does not
void leaveToOrgan(Rule& rule)
{
  const std::string_view name = rule.name;
  rule.value = name == "support" ? 0.0 : rule.value;
}

// Without an organ file nobody knows how a lobe is held, and the law takes it as held below.
Rule lobeRule(const Surface& surface, const Contact& contact)
{
  constexpr double kThin = 2.0;
  const BoxTree::Node& all = surface.tree().nodes().front();
  double whole = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < all.low.size(); ++k)
  {
    whole = std::min(whole, static_cast<double>(all.high[k]) - static_cast<double>(all.low[k]));
  }
  return { "lobe", "-", contact.touching() ? whole / contact.thickness : 0.0, kThin,
    "thinner than half of the body: a lobe that nothing holds below bends; palp organ and --organ "
    "take that into account" };
}

} // namespace

ContactGeometry lawGeometryOf(const Scene& scene, const Contact& contact)
{
  ContactGeometry geometry = contactGeometryOf(contact);
  if (scene.series != nullptr && contact.touching())
  {
    geometry.depth = TissueAt(scene, contact).answer(contact.depth).local;
    geometry.thickness = std::numeric_limits<double>::infinity();
    geometry.hollow = 0.0;
  }
  return geometry;
}

std::vector<double> contrastsAt(const Scene& scene, const Contact& contact)
{
  return scene.nodules == nullptr
    ? std::vector<double>{}
    : scene.nodules->contrasts(noduleContactOf(contact), scene.law(contactGeometryOf(contact)));
}

std::vector<Validity> validityOf(const Scene& scene)
{
  std::vector<Validity> all;
  all.reserve(static_cast<std::size_t>(organCount(scene)));
  for (int i = 0; i < organCount(scene); ++i)
  {
    all.emplace_back(organOf(scene, i).law);
  }
  return all;
}

std::vector<Rule> rulesAt(const Scene& scene, const Validity& validity, const Contact& contact)
{
  const ContactGeometry geometry = lawGeometryOf(scene, contact);
  const bool isOrgan = scene.series != nullptr;
  const Rules all =
    validity(geometry, isOrgan ? std::numeric_limits<double>::infinity() : contact.edgeDistance);
  std::vector<Rule> rules(all.begin(), all.end());
  if (scene.nodules != nullptr)
  {
    const NoduleRules more = scene.nodules->rules(noduleContactOf(contact), scene.law(geometry));
    rules.insert(rules.end(), more.begin(), more.end());
  }
  if (scene.stiffness != nullptr)
  {
    rules.push_back(scene.stiffness->rule(stiffnessContactOf(contact)));
  }
  if (isOrgan)
  {
    std::ranges::for_each(rules, [](Rule& rule) { leaveToOrgan(rule); });
    rules.push_back(seriesRule(*scene.series, scene.law, contact.center, contact.normal));
  }
  else if (scene.surface != nullptr && !scene.surface->tree().empty())
  {
    rules.push_back(lobeRule(*scene.surface, contact));
  }
  return rules;
}

Rule betweenRule(const Calibration& calibration, const Sample& sample, const Sample& other)
{
  Rule rule{ "hands", "-", 0.0, 1.0,
    "two contacts nearer than both R_d together: each is felt as if there were no other" };
  if (sample.contact.touching() && other.contact.touching() && sample.organ == other.organ)
  {
    const Calibration& organ = organOf(calibration, sample.organ);
    const double reach = organ.extentRadius(sample) + organ.extentRadius(other);
    const double apart = (sample.contact.center - other.contact.center).norm();
    rule.value = apart > 0.0 ? reach / apart : std::numeric_limits<double>::infinity();
  }
  return rule;
}

void forEachInOrder(const Recording& recording, const std::function<void(const HandSample&)>& each)
{
  std::array<const Sample*, 2> last{};
  const std::span<const Sample> firsts = recording.samples;
  const std::span<const Sample> seconds =
    recording.second ? std::span<const Sample>(recording.second->samples) : firsts.first(0);
  for (std::size_t i = 0, k = 0; i + k < firsts.size() + seconds.size();)
  {
    const bool isFirst =
      k == seconds.size() || (i < firsts.size() && firsts[i].time <= seconds[k].time);
    const Sample& sample = isFirst ? firsts[i++] : seconds[k++];
    last[isFirst ? 0 : 1] = &sample;
    each({ &sample, last[isFirst ? 1 : 0], isFirst ? 1 : 2 });
  }
}

std::string Recording::organName(int organ) const
{
  const std::vector<std::size_t> felt = feltOrgans(organs);
  return felt.empty() ? "" : organs[felt[static_cast<std::size_t>(organ)]].name;
}

Recording Recording::head() const
{
  return { .mesh = mesh,
    .unit = unit,
    .device = device,
    .files = files,
    .command = command,
    .names = names,
    .organs = organs,
    .scene = scene,
    .samples = {},
    .thinned = thinned,
    .interval = interval,
    .rated = rated,
    .contactOnly = contactOnly,
    .second = second };
}

const Sample* Recording::deepest() const noexcept
{
  return deepestOf(samples);
}

bool Recording::isTouched() const noexcept
{
  const auto any = [](const std::vector<Sample>& all)
  {
    return std::ranges::any_of(all, [](const Sample& sample) { return sample.contact.touching(); });
  };
  return any(samples) || (!samples.empty() && second && any(second->samples));
}

std::span<const Sample> Recording::lastPress() const noexcept
{
  const auto touches = [](const Sample& sample) { return sample.contact.touching(); };
  const auto end = std::find_if(samples.rbegin(), samples.rend(), touches);
  const auto begin = std::find_if_not(end, samples.rend(), touches);
  return { begin.base(), end.base() };
}

const Sample* deepestOf(std::span<const Sample> samples) noexcept
{
  const Sample* deepest = nullptr;
  for (const Sample& sample : samples)
  {
    if (sample.contact.depth > (deepest ? deepest->contact.depth : 0.0))
    {
      deepest = &sample;
    }
  }
  return deepest;
}

} // namespace palp
