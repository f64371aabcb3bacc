#include "pipeline/formats/regions/image_labels.h"

#include "haptics/error.h"
#include "haptics/files/csv_text.h"
#include "haptics/files/input_text.h"
#include "haptics/files/listed.h"
#include "pipeline/formats/regions/image_grids.h"

#include <Eigen/Dense>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>
#include <vtkImageData.h>

namespace palp
{
namespace
{

constexpr double kWhole = 9'007'199'254'740'992.0; // beyond it doubles are not all whole numbers

// one [ml], where the file tells its unit
std::optional<double> milliliters(const PatientImage& volume)
{
  const std::string& unit = volume.unit;
  const double cm = unit == "um" ? 1e-4 : unit == "mm" ? 0.1 : unit == "cm" ? 1.0 : 100.0;
  return unit.empty() ? std::nullopt : std::optional(std::pow(cm, 3) * voxelVolume(volume));
}

std::string inThree(double value)
{
  std::ostringstream text;
  text.precision(3);
  text << value;
  return text.str();
}

std::string shownName(const std::string& name)
{
  constexpr std::size_t most = 60; // of a damaged one that goes on for ever
  return printable(name.size() > most ? name.substr(0, most) + "..." : name);
}

// a number names the value next to it that a voxel can have, to the rounding of the scale
bool isOfValue(const Label& label, double step, const std::string& text)
{
  double value = 0.0;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool isNumber = failure == std::errc() && end == text.data() + text.size();
  constexpr double kRounding = 1e-15;
  return isNumber &&
    std::abs(label.shown - value) <= 1e-6 * std::abs(step) + kRounding * std::abs(value);
}

} // namespace

std::string inDigits(double value)
{
  const bool isWhole = std::abs(value) <= kWhole && value == std::trunc(value);
  return isWhole ? std::to_string(static_cast<long long>(value)) : shortest(value);
}

void giveNames(PatientImage& volume, std::span<const LabelName> names)
{
  for (const LabelName& label : names)
  {
    const double stored = (label.value - volume.intercept) / volume.slope;
    const auto isIt = [&](const Segment& one) { return one.value == stored; };
    const auto own = std::ranges::count_if(volume.segments, isIt);
    if (own == 1)
    {
      std::ranges::find_if(volume.segments, isIt)->name = label.name;
    }
    else if (own > 1)
    {
      volume.notes.push_back("warning: " + inDigits(label.value) +
        " is the value of several segments, which keep their own names");
    }
    else if (label.value != 0.0) // which is no region
    {
      volume.segments.push_back({ .name = label.name, .value = stored, .isOfTable = true });
    }
  }
}

std::vector<Label> labelsOf(const PatientImage& volume, const ImageValues& first)
{
  std::vector<Label> labels;
  const int layers = volume.image->GetNumberOfScalarComponents();
  for (int layer = 0; layer < layers; ++layer)
  {
    const ImageValues values = layer == 0 ? first : valuesOf(*volume.image, layer);
    const auto namedOf = [&](double value)
    {
      return std::ranges::find_if(volume.segments,
        [&](const Segment& one) { return one.layer == layer && one.value == value; });
    };
    for (std::size_t i = 0; i < values.distinct.size(); ++i)
    {
      const double value = values.distinct[i];
      const auto named = namedOf(value);
      labels.push_back({ .segment = named != volume.segments.end()
          ? *named
          : Segment{ .name = {}, .value = value, .layer = layer },
        .shown = volume.slope * value + volume.intercept,
        .voxels = values.often[i],
        .box = values.boxes[i] });
    }
  }
  return labels;
}

std::vector<Label> bodiesAmong(std::vector<Label> labels)
{
  std::erase_if(
    labels, [](const Label& label) { return label.segment.name.empty() && label.shown == 0.0; });
  return labels;
}

double voxelVolume(const PatientImage& volume)
{
  const Eigen::Matrix<double, 4, 4, Eigen::RowMajor> form(volume.toPatient);
  return std::abs(
    form.topLeftCorner<3, 3>().determinant() * Eigen::Array3d(volume.image->GetSpacing()).prod());
}

std::string labelsInWords(const std::vector<Label>& labels, const PatientImage& volume)
{
  const std::optional<double> voxel = milliliters(volume);
  std::ostringstream text;
  const std::vector<Label> bodies = bodiesAmong(labels);
  constexpr std::streamoff kLong = 300; // characters of a sentence
  for (std::size_t i = 0; i < bodies.size(); ++i)
  {
    if (text.tellp() > kLong)
    {
      text << " and " << bodies.size() - i << " more, which palp import lists";
      break;
    }
    const Label& label = bodies[i];
    text << (text.tellp() > 0 ? ", " : "") << inDigits(label.shown)
         << (label.segment.name.empty() ? "" : " ") << shownName(label.segment.name) << " ("
         << label.voxels << (label.voxels == 1 ? " voxel" : " voxels");
    const double size = voxel.value_or(0.0) * static_cast<double>(label.voxels);
    constexpr double kWholeOnes = 1000.0; // from here on
    text << (voxel
        ? ", " + (size < kWholeOnes ? inThree(size) : std::to_string(std::lround(size))) + " ml)"
        : ")");
  }
  return text.tellp() > 0 ? "its labels are " + text.str()
    : labels.empty()      ? "it has more values than a label map"
                          : "all its voxels are 0";
}

std::string emptyInWords(const PatientImage& volume, const std::vector<Label>& labels)
{
  constexpr std::size_t kMost = 5;
  std::size_t count = 0;
  std::string names;
  for (const Segment& segment : volume.segments)
  {
    const auto isIt = [&](const Label& label)
    { return label.segment.layer == segment.layer && label.segment.value == segment.value; };
    if (!segment.isOfTable && std::ranges::none_of(labels, isIt))
    {
      ++count > kMost ? void() : addListed(names, inQuotes(shownName(segment.name)));
    }
  }
  names += count > kMost ? " and " + std::to_string(count - kMost) + " more" : "";
  return count == 0 ? "" : counted(count, "segment has", "segments have") + " no voxel: " + names;
}

void checkApart(const std::vector<Label>& labels, const std::string& name)
{
  if (std::ranges::any_of(
        labels, [](const Label& one) { return std::abs(one.segment.value) >= kWhole; }))
  {
    throw Error(ErrorCode::BadMesh,
      name + ": labels beyond 2^53, which are not told apart here; number them anew");
  }
}

std::vector<Label> chosenLabels(const std::vector<Label>& labels,
  const std::vector<std::string>& asked, const PatientImage& volume, const std::string& name)
{
  std::vector<Label> chosen;
  for (const std::string& word : asked)
  {
    const auto isIts = [&](const Label& one) { return isOfValue(one, volume.slope, word); };
    const auto isExact = [&](const Label& one) { return one.segment.name == word; };
    const bool isValue = std::ranges::any_of(labels, isIts);        // also where it is a name, too
    const bool isOne = std::ranges::count_if(labels, isExact) == 1; // whatever the case of others
    const auto isMeant = [&](const Label& one)
    {
      return isValue ? isIts(one)
        : isOne      ? isExact(one)
                     : lowered(one.segment.name) == lowered(word);
    };
    const auto count = std::ranges::count_if(labels, isMeant);
    if (count != 1)
    {
      const std::string empty = emptyInWords(volume, labels);
      throw Error(ErrorCode::BadMesh,
        name + ": " + (count == 0 ? "no" : "more than one") + " label " + printable(word) +
          " in it; " + labelsInWords(labels, volume) + (empty.empty() ? "" : "; " + empty));
    }
    const Label& label = *std::ranges::find_if(labels, isMeant);
    const auto isIt = [&](const Label& one)
    { return one.shown == label.shown && one.segment.layer == label.segment.layer; };
    std::ranges::none_of(chosen, isIt) ? chosen.push_back(label) : void(); // by value and by name
  }
  return chosen;
}

VoxelBox boxOf(std::span<const Label> labels)
{
  VoxelBox box;
  for (const Label& label : labels)
  {
    box.add(label.box.low, label.box.high);
  }
  return box;
}

vtkSmartPointer<vtkImageData> maskOfLabels(
  const PatientImage& volume, std::span<const Label> labels)
{
  const VoxelBox box = boxOf(labels);
  auto mask = maskAbout(*volume.image, box);
  const int layers = volume.image->GetNumberOfScalarComponents();
  for (int layer = 0; layer < layers; ++layer)
  {
    const auto isChosen = [&](double value)
    {
      return std::ranges::any_of(labels,
        [&](const Label& one) { return one.segment.layer == layer && one.segment.value == value; });
    };
    if (std::ranges::any_of(labels, [&](const Label& one) { return one.segment.layer == layer; }))
    {
      mark(*mask, *volume.image, box, isChosen, layer);
    }
  }
  return mask;
}

} // namespace palp
