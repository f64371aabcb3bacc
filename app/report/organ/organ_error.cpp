#include "app/report/organ/organ_error.h"

#include "app/bench/bench.h"
#include "app/report/organ/organ_bodies.h"
#include "app/report/organ/solving_course.h"
#include "app/report/pareto.h"
#include "calibration/experiments/experiment_parts.h"
#include "calibration/organ/organ_places.h"
#include "haptics/files/fixed_text.h"
#include "haptics/numerics/statistics.h"
#include "haptics/servo/servo_step.h"
#include "haptics/threads/followed_work.h"
#include "haptics/units.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <ranges>
#include <utility>

namespace palp::report
{
namespace
{

using namespace units::literals;
using fem::parts::kMissing;
using Clock = std::chrono::steady_clock;

constexpr double kYoung = 50.0_kPa;
constexpr double kAround = 12.0_mm; // of a press, where an organ file is asked

double secondsSince(Clock::time_point start)
{
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// cells of a body, and what they took
struct Cells
{
  double side = 0.0;  // [m]; 0: none
  double solve = 0.0; // [s]
  std::size_t places = 0;
};

std::string methodOf(const Cells& cells)
{
  return cells.side > 0.0 ? "cells of " + units::inMillimeters(cells.side) : "no organ file";
}

struct Errors
{
  double largest = 0.0;         // [%] of the force of reference there
  double squares = 0.0;         // sum [%^2]
  std::vector<double> depths{}; // [m]

  [[nodiscard]] double rms() const
  {
    return std::sqrt(squares / static_cast<double>(depths.size()));
  }
};

Errors errorsOf(const OrganPress& press, const Scene& scene)
{
  Errors errors{ .depths = press.reference.depths };
  for (std::size_t i = 0; i < errors.depths.size(); ++i)
  {
    const ToolPose pose{ .apex = press.place.position - errors.depths[i] * press.place.normal,
      .axis = -press.place.normal };
    const double force = press.reference.forces[i];
    const double error = 100.0 * (step(scene, pose).response.force / force - 1.0);
    errors.largest = std::abs(error) > std::abs(errors.largest) ? error : errors.largest;
    errors.squares += error * error;
  }
  return errors;
}

// of the law at a contact [us]
double answerTime(const OrganPress& press, const Scene& scene)
{
  constexpr int kCalls = 1000;
  constexpr double kDepth = 3.0_mm;
  const ToolPose pose{ .apex = press.place.position - kDepth * press.place.normal,
    .axis = -press.place.normal };
  Contact contact = step(scene, pose).contact;
  double sum = 0.0;
  const auto times = timed(
    5, [](int) {},
    [&](int k)
    {
      for (int call = 0; call < kCalls; ++call)
      {
        contact.depth = kDepth + 1e-9 * (call + k);
        sum += evaluateLaw(scene, contact, contact.depth).force;
      }
    });
  return sum > 0.0 ? statisticsOf(times).median / kCalls : kMissing;
}

// what an organ file tells around a press [s]
double feel(const OrganBody& body, const OrganModel& model, const OrganPress& press,
  std::vector<SurfacePoint> places, double spacing, Scene& scene)
{
  std::erase_if(places,
    [&](const SurfacePoint& place)
    { return (place.position - press.place.position).norm() > kAround; });
  OrganTable table;
  table.cell = model.side();
  table.spacing = spacing;
  table.count = places.size();
  const auto start = Clock::now();
  const OrganWork work{
    .places = places, .supports = std::span(&body.support, 1), .tell = [](const OrganTable&) {}
  };
  static_cast<void>(addPlaces(table, model, *body.surface, work)); // nothing stops it
  const double time =
    secondsSince(start) / static_cast<double>(std::max<std::size_t>(1, places.size()));
  scene.series = seriesBodyOf(
    std::make_shared<const ComplianceField>(table.places, spacing, body.poisson), scene.law);
  return time;
}

Scene sceneOf(const OrganBody& body)
{
  Scene scene;
  scene.surface = body.surface;
  scene.law = ForceLaw(SphereTip{ kOrganBall }, makeMaterial(kYoung, body.poisson),
    { .mode = LawMode::Corrected, .constitution = ConstitutiveModel::Linear });
  scene.forceLimit = 1e3;
  return scene;
}

void addRow(Table& table, const OrganBody& body, const OrganPress& press, const Cells& cells,
  double perPlace, const Scene& scene)
{
  const Errors errors = errorsOf(press, scene);
  const bool isSolved = cells.side > 0.0;
  table.rows.push_back({ methodOf(cells), body.name + ", " + press.name, body.kind,
    isSolved ? cells.solve : kMissing, isSolved ? 1e3 * perPlace : kMissing,
    isSolved ? cells.solve + perPlace * static_cast<double>(cells.places) : kMissing,
    answerTime(press, scene), errors.largest, errors.rms() });
}

void addBody(Table& table, const OrganBody& body, std::span<const double> sides,
  const std::stop_token& stop, SolvingCourse& course)
{
  for (const OrganPress& press : body.presses)
  {
    addRow(table, body, press, {}, 0.0, sceneOf(body));
  }
  for (const double side : sides)
  {
    if (stop.stop_requested())
    {
      return;
    }
    course.begin(body, side);
    const auto start = Clock::now();
    const OrganModel model(*body.surface, side, kYoung, body.poisson, std::span(&body.support, 1));
    const double spacing = spacingOf(*body.surface, side);
    const std::vector<SurfacePoint> places = organPlaces(*body.surface, spacing);
    const Cells cells{ .side = side, .solve = secondsSince(start), .places = places.size() };
    for (const OrganPress& press : body.presses)
    {
      Scene scene = sceneOf(body);
      const double perPlace = feel(body, model, press, places, spacing, scene);
      addRow(table, body, press, cells, perPlace, scene);
    }
  }
}

double numberIn(const Table& table, const std::vector<Cell>& row, const char* column)
{
  return std::get<double>(row[table.indexOf(column)]);
}
const std::string& wordIn(const Table& table, const std::vector<Cell>& row, const char* column)
{
  return std::get<std::string>(row[table.indexOf(column)]);
}

// all presses of one kind of body by one method
struct Mean
{
  double time = 0.0;
  double squares = 0.0;
  double worst = 0.0;
  int presses = 0;
};
using Means = std::map<std::string, std::map<std::string, Mean>>; // of kinds, of methods

Means meansOf(const Table& table)
{
  Means means;
  for (const auto& row : table.rows)
  {
    Mean& mean = means[wordIn(table, row, "regime")][wordIn(table, row, "method")];
    mean.time += numberIn(table, row, "time_s");
    mean.squares += std::pow(numberIn(table, row, "error_rms_pct"), 2);
    mean.worst = std::max(mean.worst, std::abs(numberIn(table, row, "error_max_pct")));
    ++mean.presses;
  }
  return means;
}

struct KindMark
{
  const char* kind;
  Curve::Style style;
  int color;
};
constexpr std::array kKindMarks{ KindMark{ "layers", Curve::Style::Circles, 1 },
  KindMark{ "edges", Curve::Style::Squares, 2 }, KindMark{ "lobes", Curve::Style::Diamonds, 3 },
  KindMark{ "domes", Curve::Style::Circles, 4 }, KindMark{ "liver", Curve::Style::Squares, 5 } };

void addFigure(fem::Experiment& experiment, Table kinds)
{
  Table front{ .name = "organ_front",
    .caption = "The Pareto fronts: no other cells are both faster and more accurate.",
    .columns = { "front", "method", "setting", "regime", "time_s", "error_rms_pct" },
    .shown = false };
  Table solved = kinds;
  std::erase_if(
    solved.rows, [&](const auto& row) { return std::isnan(numberIn(solved, row, "time_s")); });
  addParetoFront(front, "cells", solved, "", "");
  Figure figure{ .name = "organ",
    .caption =
      "Error of the force against the time of an organ file, a mark for each size of cells",
    .bottom = "time of the organ file [s]",
    .left = "RMS error of the force [%]",
    .logBottom = true,
    .logLeft = true };
  for (const KindMark& mark : kKindMarks)
  {
    const Curve curve{ .label = mark.kind,
      .table = kinds.name,
      .x = "time_s",
      .y = "error_rms_pct",
      .where = { { "regime", mark.kind } },
      .style = mark.style,
      .color = mark.color };
    figure.curves.push_back(curve);
    Curve best = curve;
    best.label.clear();
    best.table = front.name;
    best.style = Curve::Style::Dashed;
    figure.curves.push_back(best);
  }
  experiment.figures.push_back(std::move(figure));
  experiment.points = { std::move(kinds), std::move(front) };
}

void addKinds(fem::Experiment& experiment, std::span<const double> sides)
{
  Table kinds{ .name = "organ_kinds",
    .caption = "The same of all presses on bodies of a kind, by the root of the mean square, and "
               "of the mean time of a file [% of the force of reference at the same depth].",
    .columns = { "method", "setting", "regime", "time_s", "error_max_pct", "error_rms_pct" } };
  std::string& found = experiment.finding;
  const Means means = meansOf(experiment.numbers);
  for (const auto& mark : kKindMarks)
  {
    const auto of = means.find(mark.kind);
    if (of == means.end())
    {
      continue;
    }
    std::vector<Cells> methods(1);
    std::ranges::transform(
      sides, std::back_inserter(methods), [](double side) { return Cells{ .side = side }; });
    found.append(found.empty() ? "" : "; ").append(mark.kind);
    for (const Cells& cells : methods)
    {
      const auto mean = of->second.find(methodOf(cells));
      if (mean == of->second.end())
      {
        continue;
      }
      const auto& [time, squares, worst, presses] = mean->second;
      const double rms = std::sqrt(squares / presses);
      kinds.rows.push_back({ methodOf(cells), std::to_string(presses) + " presses", mark.kind,
        time / presses, worst, rms });
      found.append(cells.side > 0.0 ? ", " : " ").append(fixed(rms, 1));
    }
  }
  std::string names = "without an organ file";
  for (const double side : sides)
  {
    names.append(", by cells of ").append(units::inMillimeters(side));
  }
  found = "RMS error of the force in per cent " + names + ": " + found + ".";
  addFigure(experiment, std::move(kinds));
}

} // namespace

fem::Experiment organExperiment(
  fem::Resolution resolution, const std::stop_token& stop, std::function<void(double)> tell)
{
  const bool quick = resolution == fem::Resolution::Quick;
  fem::Experiment experiment;
  experiment.numbers = { .name = "organ",
    .caption = "Error of the force by body, press and cells [% of the force of reference at the "
               "same depth]; time_s is that of a whole organ file, answer_us of one force.",
    .columns = { "method", "setting", "regime", "solve_s", "place_ms", "time_s", "answer_us",
      "error_max_pct", "error_rms_pct" } };
  constexpr std::array kSides{ 8.0_mm, 6.0_mm, 4.0_mm, 3.0_mm };
  const auto sides = std::span(kSides).first(quick ? 2 : kSides.size());
  tell = tell ? std::move(tell) : tellFollower();
  const std::vector<OrganBody> bodies = [quick]
  {
    FollowedWork reading; // whose progress is not that of the solutions
    const FollowedWork::OfThread isIt(reading);
    return organBodies(quick);
  }();
  SolvingCourse course(bodies, sides, std::move(tell));
  for (const OrganBody& body : bodies)
  {
    addBody(experiment.numbers, body, sides, stop, course);
  }
  addKinds(experiment, sides);
  return experiment;
}

Section organAgainstTime(const Effort& effort)
{
  fem::Experiment found = organExperiment(
    effort.quick ? fem::Resolution::Quick : fem::Resolution::Full, effort.stop, effort.tell);
  effort.reached(1.0); // an interrupted one lacks rows
  Section section;
  section.text = { std::move(found.finding),
    "Each mark is one size of cells, on all bodies of a kind; lower and further left is better. A "
    "ball of 10 mm, 1 to 8 mm deep, 50 kPa, nu 0.45 (half of a ball: 0.33), linear. Reference: "
    "fine "
    "finite elements of independent programs with contact, that follow the body's surface, and the "
    "exact bonded layer (data/reference). 'Turned' bodies stand askew in the grid of the cells.",
    "Time is that of a whole organ file on this machine: the solution by cells of this size once, "
    "and the time of a place, measured around the press, for all places of the body. One force by "
    "the servo takes answer_us, whatever the cells. Without a file the corrected law takes the "
    "thickness and the curvature of the place." };
  section.tables = { std::move(found.numbers) };
  std::ranges::move(found.points, std::back_inserter(section.tables));
  section.figures = std::move(found.figures);
  return section;
}

} // namespace palp::report
