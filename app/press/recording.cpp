#include "app/press/recording.h"

#include "haptics/contact/body_rules.h"
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

// moves down the extremes of the interval above the gap, and no others of it
void thinInterval(std::vector<Sample>& samples, Gap& gap, double interval)
{
  const auto depth = [](const Sample& sample) { return sample.contact.depth; };
  const auto force = [](const Sample& sample) { return sample.response.force; };
  Sample* const begin = samples.data() + gap.from;
  const double number = std::floor(begin->time / interval);
  Sample* const end = std::find_if(begin, samples.data() + gap.thinsTo,
    [&](const Sample& sample) { return std::floor(sample.time / interval) != number; });
  const std::array extremes{ std::ranges::min_element(begin, end, {}, depth),
    std::ranges::max_element(begin, end, {}, depth),
    std::ranges::min_element(begin, end, {}, force),
    std::ranges::max_element(begin, end, {}, force) };
  for (Sample* at = begin; at != end; ++at)
  {
    if (std::ranges::find(extremes, at) != extremes.end())
    {
      samples[gap.to++] = *at;
    }
  }
  gap.from = static_cast<std::size_t>(end - samples.data());
}

// of a track with a gap
template <typename Track>
void narrow(Track& track, std::size_t most)
{
  std::vector<Sample>& samples = track.samples;
  Gap& gap = track.gap;
  const std::size_t stop = gap.from + std::min(most, samples.size() - gap.from);
  while (gap.from < std::min(stop, gap.thinsTo))
  {
    thinInterval(samples, gap, track.interval);
    track.thinned = gap.to;
  }
  for (; gap.from < stop; ++gap.to, ++gap.from)
  {
    samples[gap.to] = samples[gap.from];
  }
  if (gap.from == samples.size())
  {
    samples.resize(gap.to);
    gap = {};
  }
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
void boundTrack(Track& track, std::size_t most, std::size_t kept)
{
  const std::size_t part = kept / 20; // at a time, so that moving the rest is rare
  std::vector<Sample>& samples = track.samples;
  if (samples.size() > kept / 100) // from here on no copy of all is made to grow by
  {
    samples.reserve(kept + 4 * part);
  }
  // of a fixed number in all, of which those left out take none: what is full grows no more
  if (track.gap.thinsTo == 0 && samples.size() > kept + 3 * part)
  {
    const bool isMuch = track.thinned > 2 * part; // parts of an interval, or of too many
    const std::size_t first = isMuch ? 0 : track.thinned;
    const double intervals = (samples[track.thinned].time - samples[first].time) / track.interval;
    track.interval *= 4.0 * intervals > static_cast<double>(part) ? 2.0 : 1.0; // of 4 samples each
    track.gap = { .to = first, .from = first, .thinsTo = track.thinned + part };
  }
  track.gap.thinsTo > 0 ? narrow(track, most) : void();
}

template <typename Track>
void closeGapOf(Track& track)
{
  track.gap.thinsTo > 0 ? narrow(track, track.samples.size()) : void();
}

template <typename Track>
void thinTrack(Track& track)
{
  closeGapOf(track);
  track.gap.thinsTo = track.samples.size();
  closeGapOf(track);
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
  closeGap(recording);
  boundSome(recording, std::numeric_limits<std::size_t>::max(), kept);
}

void boundSome(Recording& recording, std::size_t most, std::size_t kept)
{
  boundTrack(recording, most, kept);
  recording.second ? boundTrack(*recording.second, most, kept) : void();
}

void closeGap(Recording& recording)
{
  closeGapOf(recording);
  recording.second ? closeGapOf(*recording.second) : void();
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
  const Response local = scene.law(geometry);
  if (scene.nodules != nullptr)
  {
    const NoduleRules more = scene.nodules->rules(noduleContactOf(contact), local);
    rules.insert(rules.end(), more.begin(), more.end());
  }
  if (scene.stiffness != nullptr)
  {
    rules.push_back(scene.stiffness->rule(stiffnessContactOf(contact)));
  }
  if (isOrgan)
  {
    std::ranges::for_each(rules, [](Rule& rule) { leaveToOrgan(rule); });
    rules.push_back(seriesRule(*scene.series, scene.law,
      { contact.center, contact.normal, local.contactRadius, local.force, contact.thickness,
        contact.edgeDistance }));
    contact.touching() ? void() : void(rules.back().value = 0.0);
    rules.push_back(facetRule(*scene.surface, scene.law.tip(), contact));
  }
  else if (scene.surface != nullptr && !scene.surface->tree().empty())
  {
    rules.push_back(
      lobeRule(*scene.surface, contact, local.contactRadius, scene.law.settings().base));
    rules.push_back(openRule(*scene.surface, contact));
  }
  rules.push_back(unevenRule(scene.law.tip(), contact));
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
