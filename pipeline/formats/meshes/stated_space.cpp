#include "pipeline/formats/meshes/stated_space.h"

#include "pipeline/process/file_surface.h"

#include <algorithm>
#include <array>
#include <string>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>

namespace palp
{

bool isSpace(std::string_view word)
{
  return word.size() == 3 &&
    std::ranges::all_of(std::array{ "RL", "AP", "IS" },
      [&](const char* axis) { return word.find_first_of(axis) != word.npos; });
}

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

} // namespace palp
