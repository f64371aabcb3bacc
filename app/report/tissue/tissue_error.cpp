#include "app/report/tissue/tissue_error.h"

#include "app/bench/bench.h"
#include "app/program/data_files.h"
#include "calibration/study/case.h"
#include "haptics/contact/embed_stiffness.h"
#include "haptics/files/csv_text.h"
#include "haptics/files/input_text.h"
#include "haptics/force/nodules/nodules.h"
#include "haptics/numerics/statistics.h"
#include "haptics/units.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <sstream>

namespace palp::report
{
namespace
{

using namespace units::literals;

// of the tables of reference: a ball on a bonded layer, linear
constexpr double kRadius = 10.0_mm;
constexpr double kHeight = 40.0_mm;
constexpr double kYoung = 50.0_kPa;
constexpr double kPoisson = 0.45;
constexpr double kDeepest = 8.0_mm;

// forces over depth in tissue that is not even
struct Reference
{
  std::vector<double> depths; // [m]
  std::vector<double> forces; // [N]
};

// columns of a table of reference by name, as text
std::vector<std::map<std::string, std::string>> rowsOf(const std::string& name)
{
  std::istringstream text(readText(dataFile("reference/" + name + ".csv"), "a table of reference"));
  std::vector<std::string> header;
  std::vector<std::map<std::string, std::string>> rows;
  for (std::string line; std::getline(text, line);)
  {
    if (line.empty() || line.front() == '#')
    {
      continue;
    }
    const std::vector<std::string> cells = csvFields(line);
    if (header.empty())
    {
      header = cells;
      continue;
    }
    auto& row = rows.emplace_back();
    for (std::size_t i = 0; i < std::min(header.size(), cells.size()); ++i)
    {
      row[header[i]] = cells[i];
    }
  }
  return rows;
}

bool isAt(const std::map<std::string, std::string>& row, const char* column, double value)
{
  return std::abs(csvNumber(row.at(column)).value_or(-1.0) - value) < 1e-9;
}

Reference noduleReference(const Nodule& nodule)
{
  Reference found;
  for (const auto& row : rowsOf("nodule_onaxis"))
  {
    if (row.at("tip") == "sphere" && isAt(row, "R_m", kRadius) && isAt(row, "nu", kPoisson) &&
      isAt(row, "H_m", kHeight) && isAt(row, "b_m", nodule.radius) &&
      isAt(row, "top_m", nodule.top) && isAt(row, "k", nodule.ratio))
    {
      found.depths.push_back(*csvNumber(row.at("d_m")));
      found.forces.push_back(*csvNumber(row.at("F_nod_N")));
    }
  }
  return found;
}

Reference mapReference(const std::string& map)
{
  Reference found;
  for (const auto& row : rowsOf("maps_axisym"))
  {
    if (row.at("map").starts_with(map) && isAt(row, "R_m", kRadius))
    {
      found.depths.push_back(*csvNumber(row.at("d_m")));
      found.forces.push_back(*csvNumber(row.at("F_N")));
    }
  }
  return found;
}

ForceLaw linearLaw()
{
  return { SphereTip{ kRadius }, Material{ kYoung, kPoisson },
    { .mode = LawMode::Corrected, .constitution = ConstitutiveModel::Linear } };
}

ContactGeometry placeAt(double depth)
{
  return { .depth = depth, .thickness = kHeight };
}

// the rows of one tissue
class Rows
{
public:
  Rows(Table& table, std::string tissue, Reference reference)
    : table_(table)
    , tissue_(std::move(tissue))
    , reference_(std::move(reference))
  {
  }

  [[nodiscard]] const std::vector<double>& depths() const noexcept
  {
    return reference_.depths;
  }

  // a law, whose evaluations take less than the clock's grain
  void addLaw(const char* method, const std::function<double(double)>& forceAt)
  {
    constexpr int kCalls = 1000;
    std::vector<double> forces;
    std::vector<double> times;
    double sum = 0.0;
    for (const double depth : depths())
    {
      forces.push_back(forceAt(depth));
      const auto measured = timed(
        9, [](int) {},
        [&](int k)
        {
          for (int call = 0; call < kCalls; ++call)
          {
            sum += forceAt(depth + 1e-12 * (call + k));
          }
        });
      times.push_back(sum > 0.0 ? statisticsOf(measured).median / kCalls : 0.0);
    }
    add(method, forces, times);
  }

  void add(
    const std::string& method, const std::vector<double>& forces, const std::vector<double>& times)
  {
    const double most = std::ranges::max(reference_.forces);
    double largest = 0.0;
    double squares = 0.0;
    for (std::size_t i = 0; i < forces.size(); ++i)
    {
      const double error = 100.0 * (forces[i] - reference_.forces[i]) / most;
      largest = std::max(largest, std::abs(error));
      squares += error * error;
    }
    table_.rows.push_back({ tissue_, method, statisticsOf(times).median, largest,
      std::sqrt(squares / static_cast<double>(forces.size())) });
  }

private:
  Table& table_;
  std::string tissue_;
  Reference reference_;
};

void addElements(Rows& rows, const Nodule& nodule, double size, const Effort& effort)
{
  const fem::Case study{ .name = "nodule",
    .width = 0.3,
    .length = 0.3,
    .height = kHeight,
    .tip = SphereTip{ kRadius },
    .material = { kYoung, kPoisson },
    .nodule = { nodule.radius, nodule.top, { nodule.ratio * kYoung, kPoisson } },
    .energy = fem::StrainEnergy::Linear,
    .depths = rows.depths(),
    .elementSize = size };
  const fem::Body body = fem::bodyOf(study);
  fem::Indenter indenter(body, study.tip, study.energy, study.material);
  std::vector<double> forces;
  std::vector<double> times;
  for (const double depth : rows.depths())
  {
    effort.check();
    times.push_back(timed(
      1, [](int) {},
      [&](int) {
        indenter.press(depth);
      }).front());
    forces.push_back(indenter.state().force);
  }
  rows.add("finite elements of our own, " + units::inMillimeters(size), forces, times);
}

void addNodule(Table& table, const Nodule& nodule, const Effort& effort)
{
  Rows rows(table,
    "nodule of " + units::inMillimeters(nodule.radius) + ", " + units::inMillimeters(nodule.top) +
      " deep, " + shortest(nodule.ratio) + " times as stiff",
    noduleReference(nodule));
  const ForceLaw law = linearLaw();
  const Nodules nodules(HomogeneousPress(law, placeAt(0.0), kDeepest), std::span(&nodule, 1));
  rows.addLaw("corrected law without it", [&](double depth) { return law(placeAt(depth)).force; });
  rows.addLaw("corrected law and energy of the nodule",
    [&](double depth)
    {
      constexpr std::array kRightAbove{ 0.0 };
      return law(placeAt(depth)).force + nodules(depth, kRightAbove).response.force;
    });
  for (const double size : { 1.0_mm, 0.5_mm })
  {
    addElements(rows, nodule, size, effort);
  }
}

// the maps of the table, x and z in m
struct Map
{
  const char* name;
  const char* words;
  double (*ratio)(const Eigen::Vector3d& at);
};

constexpr std::array kMaps{
  Map{ "A", "three times as stiff from 10 mm on",
    [](const Eigen::Vector3d& at) { return at.z() > 10.0_mm ? 3.0 : 1.0; } },
  Map{ "B", "three times as stiff to 2 mm",
    [](const Eigen::Vector3d& at) { return at.z() < 2.0_mm ? 3.0 : 1.0; } },
  Map{ "C", "stiffer by once every 20 mm",
    [](const Eigen::Vector3d& at) { return 1.0 + at.z() / 20.0_mm; } },
  Map{ "D", "twice as stiff to 6 mm around the axis",
    [](const Eigen::Vector3d& at) { return at.head<2>().norm() < 6.0_mm ? 2.0 : 1.0; } },
};

void addMap(Table& table, const Map& map)
{
  Rows rows(table, map.words, mapReference(map.name));
  const ForceLaw law = linearLaw();
  const auto field = stiffnessUnder(
    law, placeAt(0.0), kDeepest, [&](const Eigen::Vector3d& at) { return kYoung * map.ratio(at); });
  rows.addLaw("corrected law without it", [&](double depth) { return law(placeAt(depth)).force; });
  rows.addLaw("corrected law and energy of the map",
    [&](double depth)
    {
      const ContactGeometry place = placeAt(depth);
      const auto blend = field->at(
        { Eigen::Vector3d::Zero(), -Eigen::Vector3d::UnitZ(), depth, Eigen::Matrix3d::Zero() }, law,
        place);
      return blend(law(place), depth).force;
    });
}

} // namespace

Section tissueAgainstTime(const Effort& effort)
{
  Table table{ .name = "tissue_vs_time",
    .caption = "Error of the force in tissue that is not even, against the time of one evaluation "
               "[% of the largest force].",
    .columns = { "tissue", "method", "time_us", "error_max_pct", "error_rms_pct" } };
  constexpr std::array kNodules{ Nodule{ 5.0_mm, 5.0_mm, 5.0 }, Nodule{ 5.0_mm, 5.0_mm, 0.2 },
    Nodule{ 8.0_mm, 5.0_mm, 10.0 } };
  const auto wanted = std::span(kNodules).first(effort.quick ? 1 : kNodules.size());
  const double work = static_cast<double>(wanted.size() + kMaps.size());
  double done = 0.0;
  for (const Nodule& nodule : wanted)
  {
    addNodule(table, nodule, effort);
    effort.reached(++done / work);
  }
  for (const Map& map : kMaps)
  {
    addMap(table, map);
    effort.reached(++done / work);
  }
  Section section;
  section.text = { "A ball of 10 mm, 1 to 8 mm deep on a bonded layer of 40 mm, 50 kPa, nu 0.45. "
                   "Reference: linear finite elements of an independent program (data/reference). "
                   "Time is that of one more force: for a law one evaluation, for finite elements "
                   "the step from the depth before." };
  section.tables = { std::move(table) };
  return section;
}

} // namespace palp::report
