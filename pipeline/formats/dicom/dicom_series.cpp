#include "pipeline/formats/dicom/dicom_series.h"

#include "haptics/files/csv_text.h"
#include "haptics/files/input_text.h"
#include "pipeline/formats/dicom/dicom_elements.h"
#include "pipeline/formats/dicom/dicom_values.h"
#include "pipeline/formats/meshes/refuse.h"
#include "pipeline/process/child_process.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <gdcmReader.h>
#include <gdcmTrace.h>
#include <map>
#include <numbers>
#include <set>
#include <span>

namespace palp
{
namespace
{

using gdcm::DataSet;
using gdcm::Tag;

constexpr double kAlike = 1e-3;  // [-] of spacings and directions, which are written in decimals
constexpr double kMissing = 0.1; // [-] of the distance by which one may be off
constexpr double kGap = 1.9;     // of it that an image is missing in
constexpr double kTilt = 0.01;   // [rad] between the way of the slices and their normal

const Tag kClass(0x0008, 0x0016);
const Tag kModality(0x0008, 0x0060);
const Tag kDescription(0x0008, 0x103e);
const Tag kSeries(0x0020, 0x000e);
const Tag kNumber(0x0020, 0x0011);
const Tag kPosition(0x0020, 0x0032);
const Tag kOrientation(0x0020, 0x0037);
const Tag kFrame(0x0020, 0x0052);
const Tag kSpacing(0x0028, 0x0030);
const Tag kIntercept(0x0028, 0x1052);
const Tag kSlope(0x0028, 0x1053);
const Tag kVoxels(0x7fe0, 0x0010);

DicomSlice sliceOf(const std::filesystem::path& file, const DataSet& data)
{
  if (textOf(data, kClass) == kSegmentationClass)
  {
    refuse(file, "a segmentation, no image of a series; give this file itself, or move it away");
  }
  if (countOf(data, Tag(0x0028, 0x0002)) != 1 ||
    textOf(data, Tag(0x0028, 0x0004)) == "PALETTE COLOR")
  {
    refuse(file, "has colors; give images of one value a voxel");
  }
  if (data.FindDataElement(Tag(0x0028, 0x3000)))
  {
    refuse(file, "its values go by a Modality LUT; export it with Rescale Slope and Intercept");
  }
  if (decimalOf(data, kFrames, 1.0) > 1.0)
  {
    refuse(file, "holds several images in one file; save them one a file, or as .nrrd");
  }
  const auto position = decimalsOf(data, kPosition, 3);
  const auto orientation = decimalsOf(data, kOrientation, 6);
  const auto spacing = decimalsOf(data, kSpacing, 2);
  if (!position || !orientation || !spacing)
  {
    refuse(file,
      std::string("has no ") +
        (!position         ? "Image Position (Patient)"
            : !orientation ? "Image Orientation (Patient)"
                           : "Pixel Spacing") +
        "; export the series again with its place");
  }
  DicomSlice slice{ .file = file,
    .columns = countOf(data, Tag(0x0028, 0x0011)),
    .rows = countOf(data, Tag(0x0028, 0x0010)),
    .position = Eigen::Vector3d::Map(position->data()),
    .alongRow = Eigen::Vector3d::Map(orientation->data()),
    .alongColumn = Eigen::Vector3d::Map(orientation->data() + 3),
    .columnSpacing = spacing->back(),
    .rowSpacing = spacing->front(),
    .slope = decimalOf(data, kSlope, 1.0),
    .intercept = decimalOf(data, kIntercept, 0.0),
    .isScaled = data.FindDataElement(kSlope) || data.FindDataElement(kIntercept),
    .frame = textOf(data, kFrame),
    .patient = textOf(data, Tag(0x0010, 0x0020)),
    .phase = textOf(data, Tag(0x0018, 0x0081)) + '/' + textOf(data, Tag(0x0020, 0x0100)) };
  const bool isSquare = std::abs(slice.alongRow.norm() - 1.0) < kAlike &&
    std::abs(slice.alongColumn.norm() - 1.0) < kAlike &&
    std::abs(slice.alongRow.dot(slice.alongColumn)) < kAlike;
  if (!isSquare || !(slice.columnSpacing > 0.0) || !(slice.rowSpacing > 0.0) || slice.slope == 0.0)
  {
    refuse(file,
      "its Image Orientation, Pixel Spacing or Rescale Slope makes no image; export it again");
  }
  return slice;
}

void add(DicomSeries& series, const std::filesystem::path& file, const DataSet& data)
{
  series.uid = textOf(data, kSeries);
  series.description = textOf(data, kDescription, textOf(data, kCharacterSet));
  series.modality = textOf(data, kModality);
  series.number = static_cast<int>(std::clamp(decimalOf(data, kNumber, 0.0), 0.0, 1e9));
  try
  {
    series.slices.push_back(sliceOf(file, data));
  }
  catch (const Error& error) // the others may be good
  {
    series.fault = series.fault.empty() ? error.what() : series.fault;
  }
}

std::string inWords(const DicomSeries& series)
{
  const DicomSlice& first = series.slices.front();
  return inQuotes(series.description) + " (" + series.modality + ", " +
    std::to_string(series.slices.size()) + " images of " + std::to_string(first.columns) + " x " +
    std::to_string(first.rows) + ")";
}

std::string shown(double length)
{
  return shortest(std::round(1000.0 * length) / 1000.0) + " mm";
}

std::string nameOf(const DicomSlice& slice)
{
  return slice.file.filename().string();
}

void checkAlike(const std::filesystem::path& folder, const DicomSeries& series)
{
  const DicomSlice& first = series.slices.front();
  for (const DicomSlice& slice : series.slices)
  {
    const bool isAlike = slice.columns == first.columns && slice.rows == first.rows &&
      (slice.alongRow - first.alongRow).norm() < kAlike &&
      (slice.alongColumn - first.alongColumn).norm() < kAlike &&
      std::abs(slice.columnSpacing / first.columnSpacing - 1.0) < kAlike &&
      std::abs(slice.rowSpacing / first.rowSpacing - 1.0) < kAlike;
    const std::string other = nameOf(first);
    const auto hold = [&](bool holds, const std::string& fault)
    { holds ? void() : refuse(folder, nameOf(slice) + " " + fault); };
    hold(isAlike,
      "has another size, direction or spacing than " + other +
        "; keep the images of one stack in the folder");
    hold(slice.isScaled == first.isScaled,
      "and " + other + ": one lacks Rescale Slope and Intercept; export the series again");
    const auto isOne = [](const std::string& one, const std::string& another)
    { return one.empty() || another.empty() || one == another; };
    hold(isOne(slice.patient, first.patient),
      "is of another patient than " + other + "; keep the images of one in the folder");
    hold(slice.phase == first.phase,
      "is of another echo or time than " + other + "; keep the images of one in the folder");
    hold(isOne(slice.frame, first.frame),
      "has another Frame of Reference than " + other +
        ", so their places do not go together; keep the images of one in the folder");
  }
}

// each beside the others, whatever their distances
void checkLine(const std::filesystem::path& folder, std::span<const DicomSlice> slices)
{
  constexpr double kOff = 0.2; // pixels
  const Eigen::Vector3d& first = slices.front().position;
  const Eigen::Vector3d way = (slices.back().position - first).normalized();
  for (const DicomSlice& slice : slices)
  {
    const Eigen::Vector3d from = slice.position - first;
    const double off = (from - from.dot(way) * way).norm();
    if (off > kOff * std::min(slice.columnSpacing, slice.rowSpacing))
    {
      refuse(folder,
        nameOf(slice) + " stands " + shown(off) +
          " beside the line of the others; export the series again");
    }
  }
}

// each where an even stack has it: small differences of the distances add up
void checkEven(const std::filesystem::path& folder, std::span<const DicomSlice> slices,
  const Eigen::Vector3d& normal)
{
  constexpr double kOff = 0.1; // of a step
  const auto height = [&](const DicomSlice& slice)
  { return normal.dot(slice.position - slices.front().position); };
  const double step = height(slices.back()) / static_cast<double>(slices.size() - 1);
  for (std::size_t i = 0; i < slices.size(); ++i)
  {
    const double off = std::abs(height(slices[i]) - static_cast<double>(i) * step);
    if (off > kOff * step)
    {
      refuse(folder,
        "its images are not evenly far apart: " + nameOf(slices[i]) + " is " + shown(off) +
          " from where an even stack has it; resample them to even distances and save that as "
          ".nrrd");
    }
  }
}

} // namespace

std::vector<DicomSeries> dicomSeriesIn(const std::filesystem::path& folder)
{
  gdcm::Trace::SetDebug(false);
  gdcm::Trace::SetWarning(false);
  gdcm::Trace::SetError(false);
  std::set<std::filesystem::path> files; // in the same order everywhere
  for (const auto& entry : std::filesystem::directory_iterator(folder))
  {
    std::error_code none; // a link may lead to itself
    const bool isMeant = entry.is_regular_file(none) && entry.path().filename() != "DICOMDIR";
    isMeant ? void(files.insert(entry.path())) : void();
  }
  std::map<std::string, DicomSeries> found;
  for (const std::filesystem::path& file : files)
  {
    if (!std::ifstream(file))
    {
      refuse(file, "cannot be opened; check its permissions, and copy what a link leads to");
    }
    if (!checkElements(file))
    {
      continue; // another kind of file
    }
    blameForACrash(file); // by an assertion of GDCM
    gdcm::Reader reader;
    reader.SetFileName(file.c_str());
    if (!reader.ReadUpToTag(kVoxels))
    {
      refuse(file, "cut off or damaged; export or copy it again");
    }
    const DataSet& data = reader.GetFile().GetDataSet();
    if (!data.FindDataElement(Tag(0x0028, 0x0010))) // a directory, a report, a contour
    {
      continue;
    }
    add(found[textOf(data, kSeries)], file, data);
  }
  blameForACrash({});
  if (found.empty())
  {
    refuse(folder, "no DICOM image in it; name the folder that has the files of the series itself");
  }
  std::vector<DicomSeries> all;
  all.reserve(found.size());
  for (auto& [uid, series] : found)
  {
    all.push_back(std::move(series));
  }
  std::ranges::stable_sort(all, {},
    [](const DicomSeries& series) { return std::pair(!series.fault.empty(), series.number); });
  return all;
}

DicomSeries chosenSeries(
  const std::filesystem::path& folder, const std::string& asked, std::vector<std::string>& notes)
{
  const std::vector<DicomSeries> all = dicomSeriesIn(folder);
  const auto volumes =
    static_cast<std::size_t>(std::ranges::count(all, std::string(), &DicomSeries::fault));
  std::string list;
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    const std::string place = std::to_string(i + 1);
    const bool isMeant = asked == place || (!asked.empty() && asked == all[i].uid);
    if (!all[i].fault.empty() && (isMeant || volumes == 0))
    {
      throw Error(ErrorCode::BadFile, all[i].fault);
    }
    if (isMeant)
    {
      return all[i];
    }
    i < volumes ? void(list += (i > 0 ? ", " : "") + place + " " + inWords(all[i]))
                : notes.push_back("left out: " + all[i].fault);
  }
  if (!asked.empty())
  {
    refuse(folder, "no series " + inQuotes(asked) + " in it; it has " + list);
  }
  if (volumes > 1)
  {
    throw Error(ErrorCode::BadValue,
      folder.string() + ": has " + std::to_string(volumes) + " series: " + list +
        "; name one as the series (--series)");
  }
  return all.front();
}

Eigen::Vector3d stack(const std::filesystem::path& folder, DicomSeries& series)
{
  checkAlike(folder, series);
  std::vector<DicomSlice>& slices = series.slices;
  if (slices.size() < 2)
  {
    refuse(folder, "one image alone, no volume; give all of the series");
  }
  const Eigen::Vector3d normal =
    slices.front().alongRow.cross(slices.front().alongColumn).normalized();
  const auto height = [&](const DicomSlice& slice) { return normal.dot(slice.position); };
  std::ranges::sort(slices, {}, height);
  const Eigen::Vector3d way = slices.back().position - slices.front().position;
  const double tilt = std::acos(std::min(1.0, normal.dot(way) / way.norm()));
  checkLine(folder, slices);
  std::vector<double> steps;
  for (std::size_t i = 1; i < slices.size(); ++i)
  {
    steps.push_back(height(slices[i]) - height(slices[i - 1]));
  }
  std::vector<double> ordered = steps;
  const auto middle = ordered.begin() + static_cast<std::ptrdiff_t>((steps.size() - 1) / 2);
  std::ranges::nth_element(ordered, middle); // of two the smaller, as an image may be missing
  const double usual = *middle;
  for (std::size_t i = 0; i < steps.size(); ++i)
  {
    const std::string between = nameOf(slices[i]) + " and " + nameOf(slices[i + 1]);
    if (!(steps[i] > kMissing * usual))
    {
      refuse(folder,
        between + " are in one place; keep one phase, echo or time of the series in the folder");
    }
    if (std::abs(steps[i] - usual) > kMissing * usual)
    {
      refuse(folder,
        between + " are " + shown(steps[i]) + " apart, the others " + shown(usual) +
          (steps[i] > kGap * usual ? ": images are missing; copy all of the series"
                                   : "; resample them to even distances and save that as .nrrd"));
    }
  }
  checkEven(folder, slices, normal);
  if (tilt > kTilt)
  {
    refuse(folder,
      "its gantry was tilted by " +
        shortest(std::round(10.0 * tilt * 180.0 / std::numbers::pi) / 10.0) +
        " degrees; resample it to a straight grid and save that as .nrrd");
  }
  return way / static_cast<double>(steps.size());
}

} // namespace palp
