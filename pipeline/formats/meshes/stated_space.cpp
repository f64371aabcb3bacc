#include "pipeline/formats/meshes/stated_space.h"

#include "haptics/files/input_text.h"
#include "pipeline/formats/meshes/refuse.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>

namespace palp
{

namespace
{

std::string upper(std::string_view text)
{
  std::string all(text);
  std::ranges::transform(
    all, all.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return all;
}

bool isPartOfWord(char c)
{
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-';
}

// whether a word names the axes of a patient, as LPS or RAS: a letter for each
bool isSpace(std::string_view word)
{
  return word.size() == 3 &&
    std::ranges::all_of(std::array{ "RL", "AP", "IS" },
      [&](const char* axis) { return word.find_first_of(axis) != word.npos; });
}

// the word behind SPACE= in a text, blanks around the sign aside; empty: there is none
std::string spaceIn(std::string_view header)
{
  const std::string text = upper(header);
  const std::string_view key = kSpaceArray;
  for (std::size_t at = text.find(key); at != text.npos; at = text.find(key, at + 1))
  {
    const std::size_t sign = text.find_first_not_of(" \t", at + key.size());
    const bool isKey = at == 0 || !isPartOfWord(text[at - 1]);
    if (isKey && sign != text.npos && text[sign] == '=')
    {
      const std::size_t begin = std::min(text.size(), text.find_first_not_of(" \t", sign + 1));
      const auto end = std::find_if_not(
        text.begin() + static_cast<std::ptrdiff_t>(begin), text.end(), isPartOfWord);
      return { text.begin() + static_cast<std::ptrdiff_t>(begin), end };
    }
  }
  return {};
}

} // namespace

void stateSpace(vtkPolyData& mesh, std::string_view header)
{
  const std::string space = spaceIn(header);
  if (!isSpace(space)) // words about something else
  {
    return;
  }
  vtkNew<vtkStringArray> words;
  words->SetName(kSpaceArray);
  words->InsertNextValue(space);
  mesh.GetFieldData()->AddArray(words);
}

std::string checkedSpace(const std::filesystem::path& file, const std::string& stated)
{
  const std::string given = upper(stated);
  const std::string space = given == "RIGHT-ANTERIOR-SUPERIOR" ? "RAS"
    : given == "LEFT-POSTERIOR-SUPERIOR"                       ? "LPS"
                                                               : given;
  if (!space.empty() && space != "RAS" && space != "LPS")
  {
    refuse(file,
      "its axes are " + inQuotes(stated) +
        " by its SPACE, where 3D Slicer has LPS or RAS; export it in one of them");
  }
  return space;
}

void turnToLps(const std::filesystem::path& file, FileSurface& surface)
{
  const std::string space = checkedSpace(file, surface.space);
  if (space == "RAS")
  {
    for (Eigen::Vector3d& point : surface.points)
    {
      point.head<2>() *= -1.0;
    }
    surface.notes.emplace_back(kTurnedFromRas);
  }
  surface.space = space.empty() ? "" : "LPS";
}

} // namespace palp
