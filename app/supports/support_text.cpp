#include "app/supports/support_text.h"

#include "app/input/press_places.h"
#include "app/input/quantity.h"
#include "app/program/sha256.h"
#include "app/supports/support_parts.h"
#include "haptics/error.h"
#include "haptics/files/input_text.h"
#include "haptics/surface/closest_point.h"
#include "haptics/surface/ray.h"
#include "haptics/units.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

namespace palp
{
namespace
{

constexpr const char* kOption = "--support";
constexpr double kRounding = 1e-6; // [m]
constexpr std::string_view kPoints = ":points:";
constexpr std::string_view kLabel = ":label:";
constexpr char kHash = '#'; // before what a file of points held

std::vector<std::string> wordsOf(const std::string& text)
{
  std::vector<std::string> words(1);
  for (const char c : text)
  {
    c == ':' ? void(words.emplace_back()) : words.back().push_back(c);
  }
  return words;
}

// of a text that begins with a kind and this; empty: it does not
std::string restAfter(std::string_view what, const std::string& text)
{
  for (const char* kind : { "bonded", "sliding" })
  {
    if (const std::string start = std::string(kind).append(what); text.starts_with(start))
    {
      return text.substr(start.size());
    }
  }
  return {};
}

// a support whose direction is not yet known, and the surface that it holds [m^2]
struct Held
{
  std::function<bool(const Eigen::Vector3d&)> holds;
  Eigen::Vector3d facing; // sum of the area vectors
  double area = 0.0;
};

// of the triangles that it holds by their middles
template <typename Holds>
void addTriangles(Held& held, const Surface& surface, const Holds& holds)
{
  for (std::size_t i = 0; i < surface.triangles().size(); ++i)
  {
    const auto& [a, b, c] = surface.triangles()[i];
    const Eigen::Vector3d& p = surface.points()[at(a)];
    const Eigen::Vector3d& q = surface.points()[at(b)];
    const Eigen::Vector3d& r = surface.points()[at(c)];
    if (holds((p + q + r) / 3.0, static_cast<int>(i)))
    {
      const Eigen::Vector3d area = 0.5 * (q - p).cross(r - p);
      held.facing += area;
      held.area += area.norm();
    }
  }
}

// all within a part of space
template <typename Holds>
Held heldWithin(const Surface& surface, const Holds& holds)
{
  Held held{ holds, Eigen::Vector3d::Zero() };
  addTriangles(held, surface, [&](const Eigen::Vector3d& middle, int) { return holds(middle); });
  return held;
}

Held boxOf(const std::vector<std::string>& words, const Surface& surface)
{
  const Eigen::Vector3d one = parsePlace(words[2], kOption).position;
  const Eigen::Vector3d other = parsePlace(words[3], kOption).position;
  const Eigen::Vector3d low = one.cwiseMin(other).array() - kRounding;
  const Eigen::Vector3d high = one.cwiseMax(other).array() + kRounding;
  return heldWithin(surface,
    [low, high](const Eigen::Vector3d& x)
    { return (x - low).minCoeff() >= 0.0 && (high - x).minCoeff() >= 0.0; });
}

// where nothing of the body is before it that way: a hollow's wall rests on nothing
Held directionOf(const std::vector<std::string>& words, const Surface& surface)
{
  const Eigen::Vector3d way = parseDirection(words[2], kOption).normalized();
  constexpr Bounds bounds{ std::numeric_limits<double>::min(), std::numbers::pi,
    "more than 0deg, to 180deg" };
  const double least = std::cos(parseWithin(words[3], Quantity::Angle, bounds, kOption));
  const auto faces = [&surface, way, least](const Eigen::Vector3d& place, int triangle)
  {
    const Triangle& corners = surface.triangles()[at(triangle)];
    return unitNormal(surface.points(), corners).dot(way) >= least &&
      rayEntry(surface.tree(), place + kRounding * way, way).triangle < 0;
  };
  Held held{ [&surface, faces](const Eigen::Vector3d& x)
    {
      return faces(
        x, findClosestPoint(surface, x, std::numeric_limits<double>::infinity()).triangle);
    },
    Eigen::Vector3d::Zero() };
  addTriangles(held, surface, faces);
  return held;
}

Held labelOf(const std::vector<std::string>& words, const Surface& surface, const FindRegion& find)
{
  if (!find)
  {
    throw Error(ErrorCode::BadValue,
      std::string(kOption) + ": label:" + words[2] +
        " is of a label map, which the surface is not of; give its image and --label, or a box");
  }
  return heldWithin(surface,
    [region = find(words[2])](const Eigen::Vector3d& x)
    { return distanceTo(region.surface->tree(), x, region.reach) < region.reach; });
}

Held paintedOf(const std::string& text, const Surface& surface)
{
  const auto parts = std::make_shared<const SupportParts>(surface);
  const auto held =
    std::make_shared<const std::vector<bool>>(readHeldParts(*parts, pointsOfSupport(text)));
  Held all{ [parts, held](const Eigen::Vector3d& x) { return (*held)[parts->nearest(x).part]; },
    Eigen::Vector3d::Zero() };
  for (std::size_t i = 0; i < held->size(); ++i)
  {
    if ((*held)[i])
    {
      all.facing += parts->all()[i].area;
      all.area += parts->all()[i].area.norm();
    }
  }
  return all;
}

// of what faces a direction within an angle, on the surface
Eigen::Vector3d middleOf(const Surface& surface, const Eigen::Vector3d& way, double angle)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double area = 0.0;
  for (const Triangle& corners : surface.triangles())
  {
    const Eigen::Vector3d& p = surface.points()[at(corners[0])];
    const Eigen::Vector3d& q = surface.points()[at(corners[1])];
    const Eigen::Vector3d& r = surface.points()[at(corners[2])];
    const Eigen::Vector3d normal = (q - p).cross(r - p);
    if (normal.dot(way) >= std::cos(angle) * normal.norm())
    {
      sum += normal.norm() * (p + q + r) / 3.0;
      area += normal.norm();
    }
  }
  return findClosestPoint(surface, sum / std::max(area, 1e-300), 1e9).point;
}

// what holds a liver that stands in LPS, y to the back, z to the head; none: no such word
std::optional<Held> presetOf(const std::string& name, const Surface& surface)
{
  using namespace units::literals;
  if (name == "posterior")
  {
    return directionOf({ "", "", "0,1,0", "60deg" }, surface);
  }
  if (name == "ligaments")
  {
    return directionOf({ "", "", "0,1,1", "30deg" }, surface);
  }
  if (name == "hilum")
  {
    constexpr double kReach = 20.0_mm; // of the vessels that go in there
    const Eigen::Vector3d middle = middleOf(surface, -Eigen::Vector3d::UnitZ(), 60.0_deg);
    return heldWithin(
      surface, [middle](const Eigen::Vector3d& x) { return (x - middle).norm() <= kReach; });
  }
  return std::nullopt;
}

Held placedOf(const std::string& text, const std::vector<std::string>& words,
  const Surface& surface, const FindRegion& find)
{
  return words[1] == "label" ? labelOf(words, surface, find)
    : words[1] == "points"   ? paintedOf(text, surface)
    : words[1] == "box"      ? boxOf(words, surface)
                             : directionOf(words, surface);
}

} // namespace

Support parseSupport(const std::string& text, const Surface& surface, const FindRegion& find)
{
  std::vector<std::string> words = wordsOf(text);
  words.size() == 1 ? void(words.insert(words.begin(), "bonded")) : void();
  const bool isKind = words[0] == "bonded" || words[0] == "sliding";
  const bool isPlaced = isKind &&
    (!pointsOfSupport(text).empty() || (words.size() == 3 && !labelOfSupport(text).empty()) ||
      (words.size() == 4 && (words[1] == "box" || words[1] == "direction")));
  const std::optional<Held> preset =
    isKind && words.size() == 2 ? presetOf(words[1], surface) : std::nullopt;
  if (!isPlaced && !preset)
  {
    throw Error(ErrorCode::BadValue,
      std::string(kOption) + ": '" + text +
        "' is no support; write bonded:box:X0,Y0,Z0:X1,Y1,Z1 in mm, "
        "bonded:direction:X,Y,Z:30deg, bonded:label:7, bonded:points:FILE, posterior, ligaments "
        "or hilum, or any with sliding");
  }
  const Held held = preset ? *preset : placedOf(text, words, surface, find);
  const auto refuse = [&](const char* why)
  { throw Error(ErrorCode::BadValue, std::string(kOption) + ": '" + text + "' " + why); };
  constexpr double kNoWay = 1e-3; // of the area: as of a closed surface
  if (!(held.area > 0.0))
  {
    refuse("holds nothing of the surface; move or widen it");
  }
  if (words[0] == "bonded")
  {
    return { held.holds };
  }
  if (held.facing.norm() < kNoWay * held.area)
  {
    refuse("slides across no direction, as what it holds faces all ways; give less, or bonded");
  }
  return { held.holds, held.facing.normalized() };
}

std::filesystem::path pointsOfSupport(const std::string& text)
{
  return restAfter(kPoints, text);
}

std::string labelOfSupport(const std::string& text)
{
  return restAfter(kLabel, text);
}

std::string withPoints(const std::string& text, const std::string& file)
{
  return text.substr(0, text.find(kPoints) + kPoints.size()) + file;
}

std::string describeSupports(
  const std::vector<std::string>& supports, const std::filesystem::path& folder)
{
  std::string all;
  for (const std::string& support : supports)
  {
    std::string text = support;
    if (const std::filesystem::path points = pointsOfSupport(support); !points.empty())
    {
      constexpr std::size_t kTold = 12; // digits
      Sha256 hash;
      hash.addFile(points);
      const std::filesystem::path from =
        std::filesystem::absolute(folder / "x").parent_path().lexically_normal();
      const std::filesystem::path to =
        std::filesystem::absolute(points).lexically_normal().lexically_relative(from);
      text = withPoints(support, to.string() + kHash + hash.hex().substr(0, kTold));
    }
    all.append(all.empty() ? "" : " ").append(text);
  }
  return all;
}

void checkSupports(const std::vector<std::string>& supports, const std::filesystem::path& organ,
  const std::string& described)
{
  if (!supports.empty() && describeSupports(supports, organ.parent_path()) != described)
  {
    throw Error(ErrorCode::BadFile,
      printable(organ.string()) + ": is of a body that rests on " + described +
        ", and other supports are given; make it again by palp organ, or leave them out");
  }
}

void noteAxes(const std::vector<std::string>& supports, const std::string& space,
  std::vector<std::string>& notes)
{
  const auto isOfPatient = [](const std::string& support)
  {
    const std::string word = support.substr(support.find(':') + 1); // all of it without a kind
    return word == "posterior" || word == "ligaments" || word == "hilum";
  };
  if (const auto found = std::ranges::find_if(supports, isOfPatient);
      found != supports.end() && space != "LPS")
  {
    notes.push_back("warning: " + *found +
      " takes y to the back and z to the head, and the surface does not say that it lies so; "
      "else give bonded:direction:X,Y,Z:60deg");
  }
}

void noteSupports(const std::vector<std::string>& supports, const std::filesystem::path& organ,
  std::vector<std::string>& notes)
{
  if (!supports.empty() && organ.empty())
  {
    notes.emplace_back("warning: where it rests is not in the force without an organ file; palp "
                       "organ makes one");
  }
}

std::vector<std::string> supportsIn(
  const std::string& described, const std::filesystem::path& folder)
{
  std::vector<std::string> supports;
  for (std::size_t begin = 0; begin < described.size();)
  {
    // a name of a file may hold blanks, and ends at its hash
    const std::string rest = described.substr(begin);
    const std::size_t hash = pointsOfSupport(rest).empty() ? 0 : rest.find(kHash);
    const std::size_t end = std::min(
      described.find(' ', begin + (hash == std::string::npos ? 0 : hash)), described.size());
    std::string text = described.substr(begin, end - begin);
    if (const std::filesystem::path points = pointsOfSupport(text); !points.empty())
    {
      const std::string name = points.string().substr(0, points.string().rfind(kHash));
      text = withPoints(text, (folder / name).lexically_normal().string());
    }
    supports.push_back(std::move(text));
    begin = end + 1;
  }
  return supports;
}

} // namespace palp
