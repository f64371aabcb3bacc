#include "pipeline/formats/regions/held_labels.h"

#include "pipeline/formats/regions/contour_pieces.h"
#include "pipeline/formats/regions/voxel_layer.h"

#include <algorithm>
#include <array>
#include <iterator>

namespace palp
{
namespace
{

bool isWithin(const VoxelBox& inner, const VoxelBox& outer)
{
  bool within = true;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    within = within && inner.low[axis] >= outer.low[axis] && inner.high[axis] <= outer.high[axis];
  }
  return within;
}

// Whether most sides of a label's voxels that no other of its own meets, meet a body: in some rows
// of a large one. Where the image ends they meet nothing.
bool isHeld(vtkImageData& image, const Label& label, std::span<const Label> body)
{
  const int* size = image.GetDimensions();
  const std::array<vtkIdType, 3> steps{ 1, size[0], static_cast<vtkIdType>(size[0]) * size[1] };
  const auto isOfBody = [&](double value) {
    return std::ranges::any_of(body, [&](const Label& one) { return one.segment.value == value; });
  };
  vtkIdType meet = 0; // the body, less those that meet something else
  withVoxels(image, label.segment.layer,
    [&](const auto& voxels)
    {
      const auto& [low, high] = label.box;
      const auto look = [&](const std::array<int, 3>& at, vtkIdType voxel, std::size_t axis, int to)
      {
        const int next = at[axis] + to;
        const bool isInside = next >= 0 && next < size[axis];
        const vtkIdType beside = voxel + to * steps[axis];
        if (!isInside || voxels[beside] != voxels[voxel])
        {
          meet += isInside && isOfBody(static_cast<double>(voxels[beside])) ? 1 : -1;
        }
      };
      constexpr int kRows = 64; // at least, where there are as many
      const int step[] = { std::max(1, (high[1] - low[1]) / kRows),
        std::max(1, (high[2] - low[2]) / kRows) };
      for (std::array<int, 3> at{ 0, 0, low[2] }; at[2] <= high[2]; at[2] += step[1])
      {
        for (at[1] = low[1]; at[1] <= high[1]; at[1] += step[0])
        {
          for (at[0] = low[0]; at[0] <= high[0]; ++at[0])
          {
            const vtkIdType voxel = at[0] + at[1] * steps[1] + at[2] * steps[2];
            for (std::size_t side = 0;
                 side < 6 && static_cast<double>(voxels[voxel]) == label.segment.value; ++side)
            {
              look(at, voxel, side / 2, side % 2 == 0 ? -1 : 1);
            }
          }
        }
      }
    });
  return meet > 0;
}

std::string numbers(std::span<const Label> labels, const char* between)
{
  std::string text;
  for (const Label& label : labels)
  {
    text.append(text.empty() ? "" : between).append(inDigits(label.shown));
  }
  return text;
}

} // namespace

std::vector<Label> labelsHeld(
  const PatientImage& volume, std::span<const Label> all, std::span<const Label> body)
{
  const Segment& first = body.front().segment;
  const VoxelBox box = boxOf(body);
  vtkIdType voxels = 0; // of the body
  for (const Label& one : body)
  {
    voxels += one.voxels;
  }
  const std::vector<Label> others = bodiesAmong({ all.begin(), all.end() });
  std::vector<Label> held;
  std::ranges::copy_if(others, std::back_inserter(held),
    [&](const Label& other)
    {
      const bool isOfBody = std::ranges::any_of(
        body, [&](const Label& one) { return one.segment.value == other.segment.value; });
      return other.segment.layer == first.layer && !isOfBody && other.voxels < voxels &&
        static_cast<double>(other.voxels) >= kLeastHollow && isWithin(other.box, box) &&
        isHeld(*volume.image, other, body);
    });
  return held;
}

std::string heldInWords(std::span<const Label> held, std::span<const Label> body)
{
  constexpr std::size_t kNamed = 5;
  if (held.empty())
  {
    return {};
  }
  const auto some = held.first(std::min(held.size(), kNamed));
  const std::size_t others = held.size() - some.size();
  return (held.size() == 1 ? "label " : "labels ") + numbers(some, ", ") +
    (others > 0 ? " and " + std::to_string(others) + " more" : "") +
    (held.size() == 1 ? " meets it with most of its sides, and is"
                      : " meet it with most of their sides, and are") +
    " left out of it like a hollow; as " + numbers(body, "+") + "+" + numbers(some, "+") +
    (others > 0 ? "+..." : "") + " they are one solid body";
}

} // namespace palp
