#include "haptics/error.h"
#include "haptics/surface/area_and_volume.h"
#include "pipeline/model/poly_data.h"
#include "pipeline/surface_io/surface_io.h"
#include "tests/pipeline/formats/msh_text.h"
#include "tests/support/process.h"

#include <gtest/gtest.h>
#include <vtkPolyData.h>

namespace palp::test
{
namespace
{

class Msh : public testing::Test
{
protected:
  std::filesystem::path write(const std::string& bytes)
  {
    std::ofstream(folder_.path() / "block.msh", std::ios::binary) << bytes;
    return folder_.path() / "block.msh";
  }

  std::string refusal(const std::string& bytes)
  {
    try
    {
      (void)readSurface(write(bytes), LengthUnit::Millimeter);
    }
    catch (const Error& error)
    {
      return error.what();
    }
    return "accepted";
  }

  TemporaryFolder folder_;
};

TEST_F(Msh, OfAnyFormGivesTheOuterSurface)
{
  for (const double version : { 2.2, 4.1 })
  {
    for (const bool isBinary : { false, true })
    {
      const LoadedSurface surface =
        readSurface(write(MshBlock().write(version, isBinary)), LengthUnit::Millimeter);
      EXPECT_TRUE(surface.closed) << version << isBinary;
      EXPECT_EQ(surface.mesh->GetNumberOfPolys(), 12) << version << isBinary;
      EXPECT_NEAR(enclosedVolume(pointsOf(*surface.mesh), trianglesOf(*surface.mesh)), 24e-6, 1e-9)
        << version << isBinary;
    }
  }
}

TEST_F(Msh, ThatIsDamagedIsRefusedByItsFault)
{
  for (const double version : { 2.2, 4.1 })
  {
    for (const bool isBinary : { false, true })
    {
      const std::string whole = MshBlock().write(version, isBinary);
      for (std::size_t size = 12; size + 14 < whole.size(); size += 23)
      {
        const std::string message = refusal(whole.substr(0, size));
        EXPECT_NE(message.find("cut off"), std::string::npos) << size << ": " << message;
      }
    }
  }
  const std::string text = MshBlock().write(2.2, false);
  const auto changed = [&](const std::string& from, const std::string& to)
  {
    std::string bytes = text;
    return refusal(bytes.replace(bytes.find(from), from.size(), to));
  };
  EXPECT_NE(changed("2.2 0 8", "3.0 0 8").find("of a version"), std::string::npos);
  EXPECT_NE(changed("100 97 91", "100 97 12").find("a node that is not there"), std::string::npos);
  EXPECT_NE(changed("$Nodes\n8", "$Nodes\n999999999999").find("cut off"), std::string::npos);
  EXPECT_NE(changed("40 30", "40 thirty").find("expected a number"), std::string::npos);
  EXPECT_NE(changed("1 2 7", "93 2 7").find("not read here"), std::string::npos);
}

} // namespace
} // namespace palp::test
