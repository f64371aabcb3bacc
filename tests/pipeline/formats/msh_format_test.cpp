#include "haptics/error.h"
#include "haptics/surface/area_and_volume.h"
#include "pipeline/model/poly_data.h"
#include "pipeline/surface_io/surface_io.h"
#include "tests/pipeline/formats/msh_text.h"
#include "tests/pipeline/many_reader.h"
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
      (void)reader_.read(write(bytes), LengthUnit::Millimeter);
    }
    catch (const Error& error)
    {
      return error.what();
    }
    return "accepted";
  }

  TemporaryFolder folder_;
  ManyReader reader_;
};

TEST_F(Msh, OfAnyFormGivesTheOuterSurface)
{
  const std::string notes = "$Comments\nwhat $Nodes and $Elements are\n$EndComments\n";
  const std::pair<const char*, std::string> all[] = { { "2.2", MshBlock().write(2.2, false) },
    { "2.2 binary", MshBlock().write(2.2, true) }, { "4.1", MshBlock().write(4.1, false) },
    { "4.1 binary", MshBlock().write(4.1, true) },
    { "2.2 of the other order of bytes", MshBlock().write(2.2, true, true) },
    { "4.1 of the other order of bytes", MshBlock().write(4.1, true, true) },
    { "on curves", MshBlock().write(4.1, false, false, 1) },
    { "on faces", MshBlock().write(4.1, true, false, 2) },
    { "comments", notes + MshBlock().write(4.1, false) } };
  for (const auto& [name, bytes] : all)
  {
    const LoadedSurface surface = readSurface(write(bytes), LengthUnit::Millimeter);
    EXPECT_TRUE(surface.closed) << name;
    EXPECT_EQ(surface.mesh->GetNumberOfPolys(), 12) << name;
    EXPECT_NEAR(enclosedVolume(pointsOf(*surface.mesh), trianglesOf(*surface.mesh)), 24e-6, 1e-9)
      << name;
  }
}

// a tetrahedron of third order: its corners, two nodes on each edge and one in each face
TEST_F(Msh, OfCurvedElementsGivesTheirCorners)
{
  const std::string corners = "1 0 0 0\n2 30 0 0\n3 0 30 0\n4 0 0 30\n";
  std::string others;
  std::string tags = "1 2 3 4";
  for (int i = 5; i <= 20; ++i)
  {
    others += std::to_string(i) + " 10 1 1\n";
    tags += " " + std::to_string(i);
  }
  const LoadedSurface surface =
    readSurface(write("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n20\n" + corners + others +
                  "$EndNodes\n$Elements\n1\n1 29 2 1 1 " + tags + "\n$EndElements\n"),
      LengthUnit::Millimeter);
  EXPECT_EQ(surface.mesh->GetNumberOfPolys(), 4);
  EXPECT_NEAR(enclosedVolume(pointsOf(*surface.mesh), trianglesOf(*surface.mesh)), 4.5e-6, 1e-12);
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
  EXPECT_NE(refusal("$NOD\n1\n1 0 0 0\n$ENDNOD\n").find("of a version"), std::string::npos);
  EXPECT_NE(changed("100 97 91", "100 97 12").find("a node that is not there"), std::string::npos);
  EXPECT_NE(changed("$Nodes\n8", "$Nodes\n999999999999").find("cut off"), std::string::npos);
  EXPECT_NE(changed("40 30", "40 thirty").find("expected a number"), std::string::npos);
  EXPECT_NE(changed("1 2 7", "93 2 7").find("not read here"), std::string::npos);
}

} // namespace
} // namespace palp::test
