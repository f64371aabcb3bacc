#include "pipeline/formats/meshes/stated_space.h"

#include "pipeline/formats/meshes/refuse.h"

#include <algorithm>
#include <array>
#include <string>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>

namespace palp
{

namespace
{

// whether a word names the axes of a patient, as LPS or RAS: a letter for each
bool isSpace(std::string_view word)
{
  return word.size() == 3 &&
    std::ranges::all_of(std::array{ "RL", "AP", "IS" },
      [&](const char* axis) { return word.find_first_of(axis) != word.npos; });
}

} // namespace

void stateSpace(vtkPolyData& mesh, std::string_view header)
{
  const std::string key = std::string(kSpaceArray) + "=";
  const std::size_t found = header.find(key);
  if (found == header.npos || !isSpace(header.substr(found + key.size(), 3)))
  {
    return;
  }
  vtkNew<vtkStringArray> words;
  words->SetName(kSpaceArray);
  words->InsertNextValue(std::string(header.substr(found + key.size(), 3)));
  mesh.GetFieldData()->AddArray(words);
}

void turnToLps(const std::filesystem::path& file, FileSurface& surface)
{
  if (isSpace(surface.space) && surface.space != "RAS" && surface.space != "LPS")
  {
    refuse(file,
      "its axes are " + surface.space +
        " by its SPACE, where 3D Slicer has LPS or RAS; export it in "
        "one of them");
  }
  if (surface.space.find("RAS") != std::string::npos)
  {
    for (Eigen::Vector3d& point : surface.points)
    {
      point.head<2>() *= -1.0;
    }
    surface.notes.emplace_back(
      "turned from axes to right, front and head (SPACE=RAS) to left, back "
      "and head (LPS)");
    surface.space = "LPS";
  }
  surface.space = surface.space.find("LPS") != std::string::npos ? "LPS" : "";
}

} // namespace palp
