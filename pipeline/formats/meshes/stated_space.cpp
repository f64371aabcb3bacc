#include "pipeline/formats/meshes/stated_space.h"

#include "pipeline/process/file_surface.h"

#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>

namespace palp
{

void stateSpace(vtkPolyData& mesh, std::string_view header)
{
  for (const char* space : { "RAS", "LPS" })
  {
    if (header.find(std::string(kSpaceArray) + "=" + space) != header.npos)
    {
      vtkNew<vtkStringArray> words;
      words->SetName(kSpaceArray);
      words->InsertNextValue(space);
      mesh.GetFieldData()->AddArray(words);
      return;
    }
  }
}

} // namespace palp
