#include "pipeline/formats/regions/image_surface.h"

#include "haptics/files/csv_text.h"
#include "haptics/files/input_text.h"
#include "pipeline/formats/regions/contour_pieces.h"
#include "pipeline/formats/regions/held_labels.h"
#include "pipeline/formats/regions/image_body.h"

#include <algorithm>
#include <string_view>
#include <vtkImageData.h>

namespace palp
{
namespace
{

// of a gray image
void checkDiffer(const PatientImage& volume, const ImageValues& values, const std::string& name)
{
  if (!(values.low < values.high))
  {
    checkNumbers(values, name);
    refuseImage(name,
      "no body in it, all its voxels are " + inWords(volume.slope * values.low + volume.intercept) +
        "; give another image");
  }
}

// by a level, where it is no label map
ImageRegion levelOf(const PatientImage& volume, const ImagePart& part, const ImageValues& values,
  const std::string& name)
{
  if (!volume.segments.empty() || values.labels)
  {
    refuseImage(name,
      "a label map, whose values have no order (" +
        labelsInWords(labelsOf(volume, values), volume) +
        "); give one as the label (--label), or several with commas" +
        (part.level ? ", not a level" : ""),
      ErrorCode::BadValue);
  }
  if (!part.level)
  {
    checkDiffer(volume, values, name);
    const double one = volume.slope * values.low + volume.intercept;
    const double other = volume.slope * values.high + volume.intercept;
    refuseImage(name,
      "an image; name the value of the surface with a level (--level), its values go from " +
        inWords(std::min(one, other)) + " to " + inWords(std::max(one, other)),
      ErrorCode::BadValue);
  }
  return regionOfLevel(volume, *part.level, values, name);
}

// of a mask, or with names, as well
bool isLabelMap(const PatientImage& volume, const ImageValues& values)
{
  const auto isBackground = [](double value) { return value == 0.0; };
  return !volume.segments.empty() || values.labels ||
    (values.distinct.size() == 2 && std::ranges::any_of(values.distinct, isBackground)) ||
    (values.distinct.size() == 1 && std::ranges::none_of(values.distinct, isBackground));
}

// labels that are one body together
using LabelGroup = std::vector<Label>;

FileOrgan listed(const LabelGroup& labels, const PatientImage& volume)
{
  const Segment& first = labels.front().segment;
  FileOrgan organ{
    .label = {}, .name = first.name, .color = first.color, .surface = {}, .from = {}
  };
  for (const Label& label : labels)
  {
    organ.label.append(organ.label.empty() ? "" : "+").append(inDigits(label.shown));
    organ.voxels += static_cast<std::uint64_t>(label.voxels);
  }
  organ.voxelVolume = static_cast<double>(organ.voxels) * voxelVolume(volume);
  organ.surface.field = fieldOf(volume);
  const Eigen::AlignedBox3d box = boxInPatient(volume, boxOf(labels));
  organ.corners = { box.min(), box.max() };
  return organ;
}

// which stands before each message about it
std::string titleOf(const FileOrgan& organ, const std::string& name)
{
  return name + ", label " + organ.label;
}

ImageRegion regionOf(
  const LabelGroup& labels, const PatientImage& volume, const std::vector<Label>& all)
{
  ImageRegion region = regionOfLabels(volume, labels);
  const std::string held = heldInWords(labelsHeld(volume, all, labels), labels);
  held.empty() ? void() : region.notes.push_back("warning: " + held);
  return region;
}

FileOrgan organOf(const LabelGroup& labels, const PatientImage& volume,
  const std::vector<Label>& all, std::size_t components, const std::string& name)
{
  const FileOrgan known = listed(labels, volume);
  FileOrgan organ = bodyOf(volume, regionOf(labels, volume, all), components, titleOf(known, name));
  organ.label = known.label;
  organ.name = known.name;
  organ.color = known.color;
  return organ;
}

// one that nobody asked for by name does not keep the others from being made
FileOrgan organOrWhyNot(const LabelGroup& labels, const PatientImage& volume,
  const std::vector<Label>& all, std::size_t components, bool mayLack, const std::string& name)
{
  try
  {
    return organOf(labels, volume, all, components, name);
  }
  catch (const Error& error)
  {
    if (!mayLack)
    {
      throw;
    }
    FileOrgan organ = listed(labels, volume);
    const std::string why = error.what();
    organ.surface.notes.push_back(
      "warning: left out, " + why.substr(titleOf(organ, name).size() + std::string(": ").size()));
    return organ;
  }
}

// those that are asked for, else all that are large enough
std::vector<LabelGroup> wantedLabels(const PatientImage& volume, const std::vector<Label>& known,
  const ImagePart& part, bool isList, const std::string& name, std::vector<std::string>& notes)
{
  std::vector<LabelGroup> wanted;
  for (const std::string& word : part.labels)
  {
    std::vector<std::string> words;
    for (const std::string_view one : split(word, '+'))
    {
      words.emplace_back(trimmed(one));
      if (words.back().empty())
      {
        refuseImage(name, inQuotes(word) + " lacks a label beside its +; write them like 2+3");
      }
    }
    LabelGroup group = chosenLabels(known, words, volume, name);
    const auto which = [](const Label& one) { return std::pair(one.shown, one.segment.layer); };
    const auto isGroup = [&](const LabelGroup& other)
    { return std::ranges::is_permutation(group, other, {}, which, which); };
    std::ranges::none_of(wanted, isGroup) ? wanted.push_back(std::move(group)) : void();
  }
  for (const Label& label : part.labels.empty() ? bodiesAmong(known) : std::vector<Label>())
  {
    if (label.voxels >= kFewestVoxels || isList)
    {
      wanted.push_back({ label });
      continue;
    }
    notes.push_back("warning: label " + inDigits(label.shown) + " has " +
      counted(static_cast<std::size_t>(label.voxels), "voxel") +
      ", too few for a surface, and is left out");
  }
  if (wanted.empty())
  {
    refuseImage(name, "no label of eight voxels or more in it; " + labelsInWords(known, volume));
  }
  return wanted;
}

} // namespace

FileSurface imageSurface(const PatientImage& volume, const ImagePart& part, const std::string& name)
{
  checkVolume(volume, name);
  const bool isByLabel = !part.labels.empty();
  const ImageValues values = part.band ? ImageValues{} : valuesOf(*volume.image);
  isByLabel ? checkNumbers(values, name) : void();
  const std::vector<Label> known = isByLabel ? labelsOf(volume, values) : std::vector<Label>();
  checkApart(known, name);
  ImageRegion region = part.band ? regionOfBand(volume, *part.band, name)
    : isByLabel ? regionOf(chosenLabels(known, part.labels, volume, name), volume, known)
                : levelOf(volume, part, values, name);
  region.notes.insert(region.notes.begin(), volume.notes.begin(), volume.notes.end());
  return bodyOf(volume, std::move(region), part.components, name).surface;
}

FileOrgans imageOrgans(const PatientImage& volume, const ImagePart& part, const OrgansAsked& asked,
  const std::string& name)
{
  checkVolume(volume, name);
  FileOrgans all{ .unit = volume.unit, .space = volume.space, .notes = volume.notes };
  const ImageValues values = part.band ? ImageValues{} : valuesOf(*volume.image);
  if (part.band || part.level)
  {
    ImageRegion region =
      part.band ? regionOfBand(volume, *part.band, name) : levelOf(volume, part, values, name);
    all.organs.push_back(bodyOf(volume, std::move(region), part.components, name));
    return all;
  }
  all.low = volume.slope * values.low + volume.intercept;
  all.high = volume.slope * values.high + volume.intercept;
  if (part.labels.empty() && !isLabelMap(volume, values))
  {
    checkDiffer(volume, values, name);
    return all;
  }
  checkNumbers(values, name);
  const std::vector<Label> known = labelsOf(volume, values);
  checkApart(known, name);
  if (const std::string empty = emptyInWords(volume, known); part.labels.empty() && !empty.empty())
  {
    all.notes.push_back(empty);
  }
  const std::vector<LabelGroup> wanted =
    wantedLabels(volume, known, part, asked.isList, name, all.notes);
  const auto isMade = [&](std::size_t place)
  { return wanted.size() == 1 || !asked.places || std::ranges::count(*asked.places, place) > 0; };
  const bool mayLack = part.labels.empty() && wanted.size() > 1;
  for (std::size_t i = 0; i < wanted.size(); ++i)
  {
    all.organs.push_back(!asked.isList && isMade(i)
        ? organOrWhyNot(wanted[i], volume, known, part.components, mayLack, name)
        : listed(wanted[i], volume));
  }
  return all;
}

} // namespace palp
