#include "pipeline/tissue/tissue_map.h"

#include "haptics/error.h"
#include "haptics/files/csv_text.h"
#include "haptics/files/input_text.h"
#include "haptics/files/listed.h"
#include "haptics/files/prefix.h"
#include "haptics/surface/sampling/area_darts.h"
#include "haptics/units.h"
#include "pipeline/process/child_process.h"
#include "pipeline/process/file_values.h"
#include "pipeline/tissue/modulus_grid.h"
#include "pipeline/tissue/tissue_formula.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <random>
#include <set>
#include <utility>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStaticPointLocator.h>

namespace palp
{
namespace
{

using namespace units::literals;

constexpr double kFineArray = 2.0_mm;
constexpr int kCosines = 200;
constexpr double kPerLength = 3.0; // points of a grid in the length of a random field

[[noreturn]] void refuseMap(const std::filesystem::path& file, const std::string& message)
{
  throw Error(ErrorCode::BadFile, file.string() + ": " + message);
}

// the values of a file, its coordinates in meters
FileValues valuesIn(const std::filesystem::path& file, UnitChoice unit, const std::string& array)
{
  std::vector<std::string> command{ (prefix() / "bin/palp-read").string(), file.string(),
    "values" };
  if (!array.empty())
  {
    command.push_back("array=" + array);
  }
  const auto answer = answerOf(command);
  auto values = answer ? unpackFileValues(*answer) : std::nullopt;
  if (!values)
  {
    refuseMap(
      file, "damaged or cut off: the reader crashed or exceeded its limits; export it again");
  }
  const UnitChoice stated = unit ? unit : unitNamed(values->unit);
  const double length = unitLength(stated.value_or(LengthUnit::Millimeter));
  for (double& element : values->toSpace)
  {
    element *= length;
  }
  for (Eigen::Vector3d& point : values->points)
  {
    point *= length;
  }
  return *std::move(values);
}

Eigen::Affine3d toSpaceOf(const FileValues& file)
{
  Eigen::Affine3d toSpace = Eigen::Affine3d::Identity();
  toSpace.affine() =
    Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(file.toSpace.data());
  return toSpace;
}

// of a voxel in the image
Eigen::Vector3d placeOf(const FileValues& file, std::size_t voxel)
{
  const auto columns = static_cast<std::size_t>(file.voxels[0]);
  const auto rows = static_cast<std::size_t>(file.voxels[1]);
  return { static_cast<double>(voxel % columns), static_cast<double>(voxel / columns % rows),
    static_cast<double>(voxel / columns / rows) };
}

ModulusGrid gridOf(const FileValues& file, std::vector<float> moduli)
{
  return { toSpaceOf(file).inverse(), file.voxels, std::move(moduli) };
}

// in Pa
std::vector<float> measured(
  const std::filesystem::path& file, const std::vector<float>& values, double unit)
{
  if (std::ranges::min(values) < 0.0F || !(std::ranges::max(values) > 0.0F))
  {
    refuseMap(file,
      "moduli of " + shortest(std::ranges::min(values)) + " to " +
        shortest(std::ranges::max(values)) + "; give them above 0, and 0 where nothing is known");
  }
  std::vector<float> moduli;
  std::ranges::transform(values, std::back_inserter(moduli),
    [&](float value) { return static_cast<float>(unit * static_cast<double>(value)); });
  return moduli;
}

// another frame or unit, a scaled copy within the body included, is told by its own size
void checkOnSurface(const std::filesystem::path& file, const std::vector<Eigen::Vector3d>& points,
  const SurfaceDistance& off)
{
  constexpr double kApart = 0.03;   // of the size: what is smoothed, or another's segmentation
  constexpr double kCoarsest = 0.1; // of the size: between the points of a copy that bulges less
  std::vector<double> distances;
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& point : points)
  {
    distances.push_back(off(point));
    box.extend(point);
  }
  const auto farther = distances.begin() + static_cast<std::ptrdiff_t>(9 * points.size() / 10);
  std::ranges::nth_element(distances, farther);
  const double size = box.diagonal().norm();
  const double spacing = size / std::sqrt(static_cast<double>(points.size()));
  if (*farther > kApart * size + std::min(spacing, kCoarsest * size))
  {
    refuseMap(file,
      "its surface is not that of the body: a tenth of its points are " +
        units::inMillimeters(*farther) +
        " or more off it; give it in the frame and the unit of the body");
  }
}

std::map<float, double> youngByValue(
  const std::filesystem::path& file, const FileValues& image, std::span<const LabelModulus> labels)
{
  const std::set<float> there(image.values.begin(), image.values.end());
  std::map<float, double> found;
  for (const LabelModulus& one : labels)
  {
    const auto named = std::ranges::find_if(
      image.names, [&](const LabelName& name) { return lowered(name.name) == lowered(one.label); });
    char* end = nullptr;
    const double number = std::strtod(one.label.c_str(), &end);
    const bool isNumber = *end == '\0' && end != one.label.c_str();
    const auto value = static_cast<float>(named != image.names.end() ? named->value : number);
    if ((named == image.names.end() && !isNumber) || !there.contains(value))
    {
      std::string known;
      for (auto label = there.begin(); label != there.end() && known.size() < 80; ++label)
      {
        addListed(known, shortest(*label));
      }
      refuseMap(file, "no voxel has the label '" + one.label + "'; there are " + known);
    }
    found[value] = one.young;
  }
  return found;
}

} // namespace

TissueMap mapOfLabels(
  const std::filesystem::path& file, UnitChoice unit, std::span<const LabelModulus> labels)
{
  const FileValues image = valuesIn(file, unit, "");
  const std::map<float, double> young = youngByValue(file, image, labels);
  std::vector<float> moduli;
  moduli.reserve(image.values.size());
  for (const float value : image.values)
  {
    const auto named = young.find(value);
    moduli.push_back(named == young.end() ? 0.0F : static_cast<float>(named->second));
  }
  const auto grid = std::make_shared<const ModulusGrid>(gridOf(image, std::move(moduli)));
  return [grid](const Eigen::Vector3d& position, double) { return grid->nearest(position); };
}

std::string otherLabels(const std::filesystem::path& file, UnitChoice unit,
  std::span<const LabelModulus> labels, const Eigen::AlignedBox3d& box)
{
  const FileValues image = valuesIn(file, unit, "");
  const std::map<float, double> named = youngByValue(file, image, labels);
  const Eigen::Affine3d toSpace = toSpaceOf(image);
  std::set<float> others;
  for (std::size_t i = 0; i < image.values.size(); ++i)
  {
    const float value = image.values[i];
    const bool isOther = value != 0.0F && !named.contains(value) && !others.contains(value);
    if (isOther && box.contains(toSpace * placeOf(image, i)))
    {
      others.insert(value);
    }
  }
  std::string text;
  for (const float value : others)
  {
    const auto name = std::ranges::find_if(
      image.names, [&](const LabelName& one) { return static_cast<float>(one.value) == value; });
    text += (text.empty() ? "label " : ", label ") + shortest(value) +
      (name == image.names.end() ? "" : " (" + printable(name->name) + ")");
  }
  return text;
}

TissueMap mapOfImage(const std::filesystem::path& file, UnitChoice unit)
{
  constexpr float kStiffTissue = 500.0F; // [kPa]
  const FileValues image = valuesIn(file, unit, "");
  const auto known = std::ranges::count_if(image.values, [](float value) { return value > 0.0F; });
  const auto stiff =
    std::ranges::count_if(image.values, [](float value) { return value > kStiffTissue; });
  if (2 * stiff > known)
  {
    refuseMap(file,
      "most of it is above " + shortest(kStiffTissue) +
        " kPa, as no soft tissue is; its values are taken as kPa: divide those in Pa by 1000");
  }
  const auto grid =
    std::make_shared<const ModulusGrid>(gridOf(image, measured(file, image.values, 1.0_kPa)));
  return [grid](const Eigen::Vector3d& position, double) { return grid->between(position); };
}

TissueMap mapOfArray(const std::filesystem::path& file, UnitChoice unit, const std::string& array,
  const Eigen::AlignedBox3d& box, const SurfaceDistance& off)
{
  const FileValues surface = valuesIn(file, unit, array);
  off ? checkOnSurface(file, surface.points, off) : void();
  const bool isInPascals = array.ends_with("Pa") && !array.ends_with("kPa");
  const std::vector<float> moduli = measured(file, surface.values, isInPascals ? 1.0 : 1.0_kPa);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Eigen::Vector3d& point : surface.points)
  {
    points->InsertNextPoint(point.data());
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  vtkNew<vtkStaticPointLocator> locator;
  locator->SetDataSet(data);
  locator->BuildLocator();
  const auto nearest = [&](const Eigen::Vector3d& position)
  {
    const vtkIdType point = locator->FindClosestPoint(position.data());
    return static_cast<double>(moduli[static_cast<std::size_t>(std::max<vtkIdType>(point, 0))]);
  };
  const auto grid =
    std::make_shared<const ModulusGrid>(ModulusGrid::sampled(box, kFineArray, nearest));
  return [grid](const Eigen::Vector3d& position, double) { return grid->between(position); };
}

TissueMap mapOfFormula(const std::string& text, const Eigen::AlignedBox3d& box)
{
  const TissueFormula formula(text);
  for (const Eigen::Vector3d& place : { box.min(), box.center().eval(), box.max() })
  {
    (void)formula(place);
  }
  return [text, box](const Eigen::Vector3d& position, double)
  {
    // a parser for each thread
    thread_local std::optional<std::pair<std::string, TissueFormula>> mine;
    if (!mine || mine->first != text)
    {
      mine.emplace(text, TissueFormula(text));
    }
    return box.contains(position) ? mine->second(position) : std::nan("");
  };
}

TissueMap mapOfRandom(const RandomTissue& tissue, const Eigen::AlignedBox3d& box)
{
  std::mt19937_64 engine{ tissue.seed };
  const auto normal = [&] // Box and Muller's
  {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform(engine)));
    return radius * std::cos(2.0 * std::numbers::pi * uniform(engine));
  };
  std::vector<Eigen::Vector4d> waves; // and their phases
  for (int i = 0; i < kCosines; ++i)
  {
    const double x = normal() / tissue.length;
    const double y = normal() / tissue.length;
    const double z = normal() / tissue.length;
    waves.emplace_back(x, y, z, 2.0 * std::numbers::pi * uniform(engine));
  }
  const double deviation = std::sqrt(std::log1p(tissue.spread * tissue.spread));
  const auto ratio = [&](const Eigen::Vector3d& position)
  {
    double sum = 0.0;
    for (const Eigen::Vector4d& wave : waves)
    {
      sum += std::cos(wave.dot(position.homogeneous()));
    }
    return std::exp(deviation * sum * std::sqrt(2.0 / kCosines) - 0.5 * deviation * deviation);
  };
  const auto grid = std::make_shared<const ModulusGrid>(
    ModulusGrid::sampled(box, tissue.length / kPerLength, ratio));
  return [grid](const Eigen::Vector3d& position, double young)
  { return young * grid->between(position); };
}

} // namespace palp
