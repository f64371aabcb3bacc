#include "app/plots/figure_job.h"

#include "pipeline/process/packed_values.h"

#include <Eigen/Core>
#include <array>
#include <utility>
#include <vtkFloatArray.h>

namespace palp
{
namespace
{

constexpr std::array kParts{ &FigureLook::isTransparent, &FigureLook::hasColorBar,
  &FigureLook::hasAxes, &FigureLook::hasScaleBar, &FigureLook::hasCaption,
  &FigureLook::isRealistic };

std::vector<float> valuesOf(const SurfaceMap& map)
{
  const float* first = map.values->GetPointer(0);
  return { first, first + map.values->GetNumberOfValues() };
}

void packMap(std::string& bytes, const SurfaceMap& map)
{
  packValues(bytes, std::string(map.values->GetName()));
  packValues(bytes, valuesOf(map));
  packValues(bytes, map.title);
  packValues(bytes, map.origin);
  packOne(bytes, map.low);
  packOne(bytes, map.high);
}

bool unpackMap(std::string_view& bytes, SurfaceMap& map)
{
  std::string name;
  std::vector<float> values;
  const bool read = unpackValues(bytes, name) && unpackValues(bytes, values) &&
    unpackValues(bytes, map.title) && unpackValues(bytes, map.origin) &&
    unpackOne(bytes, map.low) && unpackOne(bytes, map.high);
  map.values = vtkSmartPointer<vtkFloatArray>::New();
  map.values->SetName(name.c_str());
  for (const float value : values)
  {
    map.values->InsertNextValue(value);
  }
  return read;
}

} // namespace

std::string pack(const FigureJob& job)
{
  std::string bytes;
  packOne(bytes, job.size);
  for (const auto part : kParts)
  {
    packOne(bytes, job.look.*part);
  }
  packValues(bytes, job.look.overlays);
  packOne(bytes, job.look.body);
  packValues(bytes, std::vector{ job.camera.position, job.camera.focus, job.camera.up });
  packValues(bytes, std::vector{ job.sample });
  packOne(bytes, job.map.has_value());
  job.map ? packMap(bytes, *job.map) : void();
  return bytes;
}

std::optional<FigureJob> unpackFigureJob(std::string_view bytes)
{
  FigureJob job;
  bool read = unpackOne(bytes, job.size);
  for (const auto part : kParts)
  {
    read = read && unpackOne(bytes, job.look.*part);
  }
  std::vector<Eigen::Vector3d> camera;
  std::vector<Sample> samples;
  bool hasMap = false;
  read = read && unpackValues(bytes, job.look.overlays) && unpackOne(bytes, job.look.body) &&
    unpackValues(bytes, camera) && camera.size() == 3 && unpackValues(bytes, samples) &&
    samples.size() == 1 && unpackOne(bytes, hasMap);
  read = read && (!hasMap || unpackMap(bytes, job.map.emplace())) && bytes.empty();
  if (!read)
  {
    return std::nullopt;
  }
  job.camera = { .position = camera[0], .focus = camera[1], .up = camera[2] };
  job.sample = samples.front();
  return job;
}

} // namespace palp
