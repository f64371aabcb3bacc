#include "app/import/organ_level.h"

#include <gtest/gtest.h>
#include <set>

namespace palp
{
namespace
{

// else one would be felt where the other is shown
TEST(NameFiles, GivesNoneTheNameOfTheCoarserLevelOfAnother)
{
  const std::vector<std::vector<std::string>> lists = { { "liver", "liver_haptic", "LIVER" },
    { "liver_haptic", "Liver", "liver haptic" }, { "a", "a_haptic", "a_haptic_haptic", "a_2" },
    { "", "label_2_haptic", "" } };
  for (const std::vector<std::string>& names : lists)
  {
    std::vector<FileOrgan> organs(names.size());
    for (std::size_t i = 0; i < names.size(); ++i)
    {
      organs[i].name = names[i];
      organs[i].label = std::to_string(i + 1);
    }
    std::vector<std::string> files;
    nameFiles(organs, files, "image");
    std::set<std::string> all;
    for (const std::string& file : files)
    {
      EXPECT_TRUE(all.insert(file).second) << file;
      EXPECT_TRUE(all.insert(file + kHaptic).second) << file;
    }
    std::set<std::string> shown;
    for (const FileOrgan& organ : organs)
    {
      EXPECT_TRUE(shown.insert(organ.name).second) << organ.name;
    }
  }
}

} // namespace
} // namespace palp
