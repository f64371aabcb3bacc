#pragma once

#include "data/shapes.h"
#include "tests/support/fuzz.h"
#include "tests/support/process.h"

#include <filesystem>
#include <limits>
#include <string>
#include <vector>
#include <vtkNew.h>
#include <vtkSmartPointer.h>

class vtkPolyData;

namespace palp::test
{

// What the kinds of fuzzed surfaces and images are made of.

/// A file as a writer of VTK makes it.
template <typename Writer, typename Data, typename Set>
std::string written(const char* name, Data& data, Set set)
{
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / name;
  vtkNew<Writer> writer;
  writer->SetFileName(file.c_str());
  writer->SetInputData(&data);
  set(*writer);
  writer->Write();
  return readAll(file);
}

/// A ball of 50 mm [mm], as it stands in a file.
[[nodiscard]] Mesh ball();
[[nodiscard]] vtkSmartPointer<vtkPolyData> ballData();

/// In text, one point and one triangle in a line.
[[nodiscard]] std::string ballText(
  const std::string& head, const std::string& point, const std::string& corner, int first);
[[nodiscard]] std::string offText();

/// Voxels of an image of a ball, which is no surface.
[[nodiscard]] std::string voxelBytes();

// What a sentence says that names the cause.
inline const std::string kCut = "cut off|ends after|ends in|too short|empty|missing";
inline const std::string kIndex = "a point that is not there|refers to (vertex|point)";
inline const std::string kNumber = "usable number|not a number|three coordinates|not numbers";
inline const std::string kCount = "counts|cut off|holds|ends after|number of|more than|size";
inline const std::string kKind =
  "not an? [A-Z]|whatever its name|expected OFF|no triangles|datatype";

inline constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// @param whole  files without a fault
[[nodiscard]] Fuzzed surface(
  const std::string& file, std::vector<std::string> whole, std::vector<Fault> faults);
[[nodiscard]] Fuzzed image(
  const std::string& file, std::vector<std::string> whole, std::vector<Fault> faults);

/// What palp-read answers of an image.
[[nodiscard]] std::string readImageBytes(const std::filesystem::path& file);

/// Kinds that are made together, for that may take long: other programs write some.
struct FuzzedGroup
{
  std::vector<std::string> files; ///< of each kind, in turn
  std::vector<Fuzzed> (*make)();
};

/// Those of either.
[[nodiscard]] std::vector<FuzzedGroup> fuzzedMeshes();
[[nodiscard]] std::vector<FuzzedGroup> fuzzedImages();

} // namespace palp::test
