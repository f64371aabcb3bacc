#include "calibration/tables/organ_table.h"

#include "haptics/error.h"
#include "haptics/files/csv_text.h"
#include "haptics/files/input_text.h"
#include "haptics/files/number_table.h"
#include "haptics/files/replace_file.h"
#include "haptics/units.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <sstream>
#include <utility>

namespace palp
{
namespace
{

constexpr const char* kFirst = "# palp organ ";
constexpr const char* kHeader =
  "x_mm,y_mm,z_mm,normal_x,normal_y,normal_z,constant_per_m,slope_x_per_m2,slope_y_per_m2,"
  "slope_z_per_m2,bend_per_m3,edge_per_m,trust";
constexpr int kDigits = 7;

// short enough for small files
double rounded(double value)
{
  if (value == 0.0 || !std::isfinite(value))
  {
    return value;
  }
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(kDigits);
  text << value;
  return csvNumber(text.str()).value_or(value);
}

std::optional<std::string> entry(const std::vector<std::string>& comments, const std::string& key)
{
  const std::string start = "# " + key + ": ";
  for (const std::string& line : comments)
  {
    if (line.starts_with(start))
    {
      return std::string(trimmed(std::string_view(line).substr(start.size())));
    }
  }
  return std::nullopt;
}

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& why)
{
  throw Error(ErrorCode::BadFile, printable(file.string()) + ": " + why);
}

std::string textOf(
  const std::filesystem::path& file, const NumberTable& table, const std::string& key)
{
  const auto found = entry(table.comments, key);
  return found ? *found
               : (refuse(file, "has no line '# " + key + ":'; make it again by palp organ"), "");
}

double numberOf(const std::filesystem::path& file, const NumberTable& table, const std::string& key)
{
  const auto number = csvNumber(textOf(file, table, key));
  return number && std::isfinite(*number) && *number > 0.0
    ? *number
    : (refuse(file, "'# " + key + ":' is no number above 0; make it again by palp organ"), 0.0);
}

double poissonOf(const std::filesystem::path& file, const NumberTable& table)
{
  const auto number = csvNumber(textOf(file, table, "poisson"));
  return number && *number >= 0.0 && *number < 0.5
    ? *number
    : (refuse(
         file, "'# poisson:' is no number from 0 to less than 0.5; make it again by palp organ"),
        0.0);
}

PlacedCompliance placeOf(const std::filesystem::path& file, const NumberTable::Row& row)
{
  const std::vector<double>& v = row.values;
  const Eigen::Vector3d normal(v[3], v[4], v[5]);
  constexpr double kUnit = 1e-3;
  constexpr int kLast = static_cast<int>(ComplianceTrust::Unknown);
  constexpr double kMostTold = 1e8; // of a hair, or next to an edge
  const double trust = v[12];
  if (!(std::abs(normal.norm() - 1.0) < kUnit) || !(trust >= 0.0 && trust <= kLast) ||
    !(std::abs(v[6]) <= kMostTold))
  {
    throw Error(ErrorCode::BadFile,
      where(file, row.line) +
        "is no place of a body: its normal has to be of unit length, its constant within 1e8 per "
        "m, trust 0 to 4");
  }
  return { .position = units::fromMillimeters(1.0) * Eigen::Vector3d(v[0], v[1], v[2]),
    .normal = normal.normalized(),
    .constant = v[6],
    .slope = { v[7], v[8], v[9] },
    .bend = v[10],
    .edge = v[11],
    .trust = static_cast<ComplianceTrust>(static_cast<int>(trust)) };
}

// of each place whether it is loaded, where it is, its normal, and for each mode what a load there
// moves and how it moves itself
constexpr const char* kMotionKey = "motion";
constexpr std::size_t kMostMoved = 60'000;

void writeMotion(std::ostream& out, const OrganMotionModes& motion)
{
  if (motion.places.empty())
  {
    return;
  }
  constexpr int kMotionDigits = 5;
  out << "# motion_radius_mm: " << shortest(units::toMillimeters(motion.radius))
      << "\n# motion_modes: " << motion.modes.cols()
      << "\n# motion: loaded or not, x, y, z in mm, normal, then for each mode what a load there "
         "moves, and x, y, z\n";
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(kMotionDigits);
  for (std::size_t i = 0; i < motion.places.size(); ++i)
  {
    const auto at = static_cast<Eigen::Index>(i);
    const auto& [position, normal, isLoaded] = motion.places[i];
    const Eigen::Vector3d millimeters = position * units::toMillimeters(1.0);
    text << "# " << kMotionKey << ' ' << isLoaded;
    for (const double value : millimeters)
    {
      text << ' ' << rounded(value);
    }
    for (const double value : normal)
    {
      text << ' ' << value;
    }
    for (Eigen::Index mode = 0; mode < motion.modes.cols(); ++mode)
    {
      text << ' ' << motion.loads(mode, at);
      for (Eigen::Index axis = 0; axis < 3; ++axis)
      {
        text << ' ' << motion.modes(3 * at + axis, mode);
      }
    }
    text << '\n';
  }
  out << text.view();
}

std::vector<float> numbersIn(std::string_view text)
{
  std::vector<float> numbers;
  const char* const end = text.data() + text.size();
  for (const char* next = text.data(); next != end;)
  {
    float number = 0.0F;
    const auto [rest, error] = std::from_chars(next, end, number);
    if (error != std::errc() || !std::isfinite(number))
    {
      return {};
    }
    numbers.push_back(number);
    next = rest != end && *rest == ' ' ? rest + 1 : rest;
  }
  return numbers;
}

OrganMotionModes motionIn(const std::filesystem::path& file, const NumberTable& table)
{
  const std::string start = std::string("# ") + kMotionKey + " ";
  std::vector<std::vector<float>> lines;
  for (const std::string& line : table.comments)
  {
    line.starts_with(start)
      ? lines.push_back(numbersIn(std::string_view(line).substr(start.size())))
      : void();
  }
  OrganMotionModes motion;
  if (lines.empty() || lines.size() > kMostMoved)
  {
    return motion;
  }
  constexpr double kMostModes = 100.0;
  constexpr std::ptrdiff_t kPlace = 7; // numbers before those of the modes
  const auto modes =
    static_cast<Eigen::Index>(std::min(kMostModes, numberOf(file, table, "motion_modes")));
  motion.radius = units::fromMillimeters(numberOf(file, table, "motion_radius_mm"));
  motion.loads.resize(modes, std::ssize(lines));
  motion.modes.resize(3 * std::ssize(lines), modes);
  for (std::size_t i = 0; i < lines.size(); ++i)
  {
    const std::vector<float>& line = lines[i];
    if (std::ssize(line) != kPlace + 4 * modes)
    {
      refuse(file, "has a damaged line '# motion'; make it again by palp organ");
    }
    motion.places.push_back({ .position = units::fromMillimeters(1.0) *
        Eigen::Vector3f(line[1], line[2], line[3]).cast<double>(),
      .normal = Eigen::Vector3f(line[4], line[5], line[6]).cast<double>().normalized(),
      .isLoaded = line[0] != 0.0F });
    const Eigen::Map<const Eigen::Matrix4Xf> all(line.data() + kPlace, 4, modes);
    motion.loads.col(static_cast<Eigen::Index>(i)) = all.row(0);
    motion.modes.middleRows(3 * static_cast<Eigen::Index>(i), 3) = all.bottomRows(3);
  }
  return motion;
}

// a file of something else, of another version or cut short says so before any number is read
void checkVersion(const std::filesystem::path& file, const std::string& text)
{
  const std::string_view line = std::string_view(text).substr(0, text.find('\n'));
  if (!line.starts_with(kFirst))
  {
    refuse(file, "is no organ file; palp organ SURFACE --support ... --out FILE makes one");
  }
  const std::string_view version = trimmed(line.substr(std::string_view(kFirst).size()));
  if (version != std::to_string(OrganTable::kVersion))
  {
    refuse(file,
      "is an organ file of version " + inQuotes(version) + ", this program reads " +
        std::to_string(OrganTable::kVersion) + "; make it again by palp organ --overwrite");
  }
  if (text.back() != '\n')
  {
    refuse(file, "is cut short; make it again by palp organ");
  }
}

} // namespace

bool OrganTable::continues(const OrganTable& other) const
{
  return mesh == other.mesh && supports == other.supports && stiffness == other.stiffness &&
    young == other.young && poisson == other.poisson && cell == other.cell &&
    spacing == other.spacing && count == other.count;
}

void OrganTable::place(const Eigen::Isometry3d& frame)
{
  for (PlacedCompliance& one : places)
  {
    one.position = frame * one.position;
    one.normal = frame.linear() * one.normal;
    one.slope = frame.linear() * one.slope;
  }
  const Eigen::Matrix3f turn = frame.linear().cast<float>();
  for (std::size_t i = 0; i < motion.places.size(); ++i)
  {
    OrganMotionModes::Place& one = motion.places[i];
    one.position = frame * one.position;
    one.normal = frame.linear() * one.normal;
    auto rows = motion.modes.middleRows<3>(3 * static_cast<Eigen::Index>(i));
    rows = (turn * rows).eval();
  }
}

void writeOrganTable(const std::filesystem::path& file, const OrganTable& table)
{
  std::ostringstream out;
  out << kFirst << OrganTable::kVersion << "\n# mesh: " << table.mesh
      << "\n# supports: " << table.supports;
  if (!table.stiffness.empty())
  {
    out << "\n# stiffness: " << table.stiffness << "\n# young_Pa: " << shortest(table.young);
  }
  out << "\n# poisson: " << shortest(table.poisson)
      << "\n# cell_mm: " << shortest(units::toMillimeters(table.cell))
      << "\n# spacing_mm: " << shortest(units::toMillimeters(table.spacing))
      << "\n# places: " << table.count
      << "\n# constant, slope and bend: E* times what the body adds to the half-space's "
         "displacement per newton, G0 + b.(x + y) + (x'Ax + y'Ay)/2"
         "\n# edge: one over the distance to a sharp edge, negative between two; trust: 0 known, 1 "
         "an edge or another "
         "tissue is near, 2 "
         "too thin for the cells, 3 on a support, 4 from "
         "neighbors only\n";
  writeMotion(out, table.motion);
  out << kHeader << '\n';
  // a part has all its digits, so that what goes on from it ends as what was never stopped
  for (const PlacedCompliance& place : table.places)
  {
    const Eigen::Vector3d at = place.position * units::toMillimeters(1.0);
    std::array row{ at.x(), at.y(), at.z(), place.normal.x(), place.normal.y(), place.normal.z(),
      place.constant, place.slope.x(), place.slope.y(), place.slope.z(), place.bend, place.edge,
      static_cast<double>(place.trust) };
    if (table.places.size() == table.count)
    {
      std::ranges::transform(row, row.begin(), rounded);
    }
    writeCsvRow(out, row);
  }
  replaceFile(file, out.str());
}

OrganTable readOrganTable(const std::filesystem::path& file)
{
  std::string text = readText(file, "an organ file");
  checkVersion(file, text);
  const NumberTable numbers = NumberTable::finiteIn(std::move(text), file, kHeader);
  OrganTable table;
  table.mesh = textOf(file, numbers, "mesh");
  table.mesh.erase(0, table.mesh.starts_with(", ") ? 2 : 0); // as it was written first
  table.supports = textOf(file, numbers, "supports");
  if (const auto stiffness = entry(numbers.comments, "stiffness"))
  {
    table.stiffness = *stiffness;
    table.young = csvNumber(textOf(file, numbers, "young_Pa")).value_or(0.0);
  }
  table.poisson = poissonOf(file, numbers);
  table.cell = units::fromMillimeters(numberOf(file, numbers, "cell_mm"));
  table.spacing = units::fromMillimeters(numberOf(file, numbers, "spacing_mm"));
  constexpr double kMostPlaces = 1e6;
  table.count = static_cast<std::size_t>(std::min(kMostPlaces, numberOf(file, numbers, "places")));
  for (const NumberTable::Row& row : numbers.rows)
  {
    table.places.push_back(placeOf(file, row));
  }
  table.motion = motionIn(file, numbers);
  if (table.places.size() > table.count)
  {
    refuse(file, "has more places than it says; make it again by palp organ");
  }
  return table;
}

OrganTable readOrganOf(const std::filesystem::path& file, const std::string& mesh)
{
  OrganTable table = readOrganTable(file);
  if (table.mesh != mesh)
  {
    refuse(file,
      "is of another surface than the one that is pressed, or of one read in another "
      "unit; make one of this by palp organ");
  }
  if (!table.isComplete())
  {
    refuse(file, "is not finished; run the same palp organ again, which goes on from there");
  }
  return table;
}

} // namespace palp
