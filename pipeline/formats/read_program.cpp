#include "pipeline/formats/read_program.h"

#include "pipeline/formats/joined_corners.h"
#include "pipeline/formats/read_limits.h"
#include "pipeline/process/child_process.h"

#include <SMP/Common/vtkSMPToolsAPI.h> // vtkSMPTools.h itself is no C++20
#include <cstdlib>
#include <malloc.h>
#include <string_view>
#include <utility>

namespace palp
{
namespace
{

// a number, and what stands behind the colon after it
std::pair<double, std::string> numberBefore(std::string_view text)
{
  const std::size_t colon = std::min(text.find(':'), text.size() - 1);
  return { std::strtod(text.data(), nullptr), std::string(text.substr(colon + 1)) };
}

void take(ImagePart& part, std::string_view key, std::string_view value)
{
  if (key == "level")
  {
    part.level = std::strtod(value.data(), nullptr);
  }
  else if (key == "band")
  {
    const auto [low, high] = numberBefore(value);
    part.band = { low, std::strtod(high.c_str(), nullptr) };
  }
  else if (key == "components")
  {
    part.components = std::strtoull(value.data(), nullptr, 10);
  }
  else if (key == "name")
  {
    const auto [number, name] = numberBefore(value);
    part.names.push_back({ number, name });
  }
  else if (key == "series")
  {
    part.series = value;
  }
  else if (key == "label")
  {
    part.labels.emplace_back(value);
  }
}

} // namespace

void readForAnother(int argc, char** argv, const DicomReaders& dicom)
{
  // what one step frees, the next takes: pages that went back to the kernel would be cleared anew
  constexpr int kKept = 1 << 30;
  mallopt(M_MMAP_THRESHOLD, kKept);
  mallopt(M_TRIM_THRESHOLD, kKept);
  // the limit of time counts all threads, and one reads as fast
  vtk::detail::smp::vtkSMPToolsAPI::GetInstance().SetBackend("Sequential");
  const std::filesystem::path file = argc > 1 ? argv[1] : "";
  const std::string_view mode = argc > 2 ? argv[2] : "";
  ImagePart part;
  OrgansAsked asked{ .isList = mode == "list" };
  mode == "some" ? void(asked.places.emplace()) : void();
  std::string array;
  for (int i = 2; i < argc; ++i)
  {
    const std::string_view word = argv[i];
    const std::size_t equals = std::min(word.find('='), word.size() - 1);
    const std::string_view key = word.substr(0, equals);
    const std::string_view value = word.substr(equals + 1);
    take(part, key, value);
    array = key == "array" ? value : array;
    if (key == "place" && asked.places)
    {
      asked.places->push_back(std::strtoull(value.data(), nullptr, 10));
    }
  }
  answer(
    [&]
    {
      if (mode == "values")
      {
        return pack(readValues(file, array, dicom));
      }
      if (mode == "organs" || mode == "list" || mode == "some")
      {
        return pack(readOrgans(file, part, asked, dicom));
      }
      FileSurface surface = readFile(file, part, dicom);
      return pack(mode == "joined" ? withJoinedCorners(std::move(surface)) : surface);
    },
    readLimits(file), neededFiles(file));
}

} // namespace palp
