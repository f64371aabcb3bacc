#include "app/train/grade.h"

#include "haptics/error.h"
#include "haptics/files/csv_text.h"
#include "haptics/surface/closest_point.h"
#include "haptics/surface/sampling/point_cells.h"
#include "haptics/units.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace palp
{
namespace
{

using namespace units::literals;

constexpr double kLongestSample = 0.1; // that one stands for where others were left out [s]

const Sample& touchedLast(std::span<const Sample> samples, double time)
{
  const Sample* last = nullptr;
  for (const Sample& sample : samples)
  {
    if (sample.time > time)
    {
      break;
    }
    last = sample.contact.touching() ? &sample : last;
  }
  if (last == nullptr)
  {
    throw Error(ErrorCode::BadValue,
      "training: the mark at " + shortest(time) +
        " s comes before the first touch; mark a place while it is pressed, or after");
  }
  return *last;
}

std::vector<GradedNodule> nodulesOf(const Scene& scene)
{
  std::vector<GradedNodule> nodules;
  for (const EmbeddedNodule& one : scene.nodules->nodules())
  {
    const ClosestPoint above =
      findClosestPoint(*scene.surface, one.nodule.center, std::numeric_limits<double>::infinity());
    nodules.push_back({ .nodule = one, .above = above.point, .foundBy = {} });
  }
  return nodules;
}

void classify(Grade& grade, double hitWithin)
{
  double sum = 0.0;
  for (std::size_t i = 0; i < grade.marks.size(); ++i)
  {
    GradedMark& mark = grade.marks[i];
    const auto distance = [&](const GradedNodule& nodule)
    { return (nodule.above - mark.place).norm(); };
    const auto nearest = std::ranges::min_element(grade.nodules, {}, distance);
    mark.nearest = static_cast<std::size_t>(nearest - grade.nodules.begin());
    mark.error = distance(*nearest);
    mark.isNear = mark.error <= hitWithin;
    if (!mark.isNear)
    {
      ++grade.falseMarks;
    }
    else if (nearest->foundBy)
    {
      ++grade.repeatedMarks;
    }
    else
    {
      nearest->foundBy = i;
      ++grade.hits;
      sum += mark.error;
    }
  }
  grade.meanError =
    grade.hits > 0 ? std::optional(sum / static_cast<double>(grade.hits)) : std::nullopt;
}

double chanceOf(const Grade& grade, double hitWithin)
{
  double hits = 0.0;
  for (const GradedNodule& nodule : grade.nodules)
  {
    const double near = grade.area.fractionWithin(nodule.above, hitWithin);
    hits += 1.0 - std::pow(1.0 - near, static_cast<double>(grade.marks.size()));
  }
  return hits;
}

// forces, times and path while the tool touches
void measure(Grade& grade, std::span<const Sample> samples, double hardForce)
{
  double touch = 0.0;                               // [s]
  std::optional<std::pair<double, double>> between; // first touch and last [s]
  for (std::size_t i = 0; i < samples.size(); ++i)
  {
    const Sample& sample = samples[i];
    if (!sample.contact.touching())
    {
      continue;
    }
    between = { between ? between->first : sample.time, sample.time };
    grade.peakForce = std::max(grade.peakForce, sample.response.force);
    if (i + 1 == samples.size())
    {
      break;
    }
    const Sample& next = samples[i + 1];
    const double lasts = std::clamp(next.time - sample.time, 0.0, kLongestSample);
    touch += lasts;
    grade.meanForce += lasts * sample.response.force;
    grade.tooHard += sample.response.force > hardForce ? lasts : 0.0;
    grade.tooSoft += sample.response.contactRadius < grade.softRadius ? lasts : 0.0;
    grade.pathLength += next.contact.touching() ? (next.pose.apex - sample.pose.apex).norm() : 0.0;
  }
  for (double* part : { &grade.meanForce, &grade.tooHard, &grade.tooSoft })
  {
    *part = touch > 0.0 ? *part / touch : 0.0;
  }
  grade.time = between ? between->second - between->first : 0.0;
}

// the points of the area that were in a contact, on the side from which they are pressed
void cover(Grade& grade, std::span<const Sample> samples)
{
  constexpr double kStep = 0.2_mm; // of a contact, that changes next to nothing
  constexpr double kLeast = 1.0_mm;
  double reach = kLeast;
  for (const Sample& sample : samples)
  {
    reach = std::max(reach, sample.response.contactRadius);
  }
  const std::vector<SurfacePoint>& points = grade.area.points;
  PointCells cells(reach);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    cells.add(i, points[i].position);
  }
  grade.touched.assign(points.size(), false);
  const Sample* before = nullptr;
  for (const Sample& sample : samples)
  {
    const Contact& contact = sample.contact;
    const double radius = sample.response.contactRadius;
    const bool isSame = before != nullptr && radius <= before->response.contactRadius &&
      (contact.center - before->contact.center).norm() < kStep;
    if (!contact.touching() || isSame)
    {
      continue;
    }
    before = &sample;
    cells.near(contact.center,
      [&](std::size_t i)
      {
        const bool isUnder = (points[i].position - contact.center).norm() <= radius &&
          points[i].normal.dot(contact.normal) > 0.0;
        grade.touched[i] = grade.touched[i] || isUnder;
      });
  }
  grade.coverage = static_cast<double>(std::ranges::count(grade.touched, true)) /
    static_cast<double>(points.size());
}

} // namespace

Grade gradeSearch(const Scene& scene, std::span<const Sample> samples, const TrainingPlan& plan,
  const Curriculum& curriculum)
{
  if (!plan.marks || scene.nodules == nullptr)
  {
    throw Error(ErrorCode::BadValue, "training: nothing was marked yet; give marks");
  }
  const TrainingLevel& level = curriculum.level(plan.level);
  Grade grade{ .nodules = nodulesOf(scene), .marks = {} };
  for (const double time : *plan.marks)
  {
    grade.marks.push_back({ .time = time, .place = touchedLast(samples, time).contact.center });
  }
  grade.area = searchAreaOf(*scene.surface, plan.side);
  classify(grade, curriculum.hitWithin);
  grade.hitsByChance = chanceOf(grade, curriculum.hitWithin);
  grade.softRadius = (level.cover.high + level.radius.high) / std::sqrt(7.0);
  measure(grade, samples, curriculum.hardForce);
  cover(grade, samples);
  grade.isPassed = grade.hits == grade.nodules.size() &&
    grade.falseMarks <= static_cast<std::size_t>(curriculum.mostFalseMarks);
  return grade;
}

} // namespace palp
