#include "pipeline/process/file_surface.h"

#include <gtest/gtest.h>

namespace palp::test
{
namespace
{

FileSurface tetrahedron()
{
  return { .points = { { 0.0, 0.0, 0.0 }, { 1.0, 0.0, 0.0 }, { 0.0, 1.0, 0.0 }, { 0.0, 0.0, 1.0 } },
    .triangles = { { 0, 2, 1 }, { 0, 1, 3 }, { 1, 2, 3 }, { 0, 3, 2 } },
    .unit = "mm",
    .notes = { "a note", "another" },
    .field = 320.0 };
}

TEST(FileSurface, ComesBackAsItWas)
{
  const auto back = unpack(pack(tetrahedron()));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->points, tetrahedron().points);
  EXPECT_EQ(back->triangles, tetrahedron().triangles);
  EXPECT_EQ(back->unit, "mm");
  EXPECT_EQ(back->notes, tetrahedron().notes);
  EXPECT_EQ(back->field, 320.0);
}

TEST(FileSurface, IsNothingWhenCutOffAnywhereOrTooLong)
{
  const std::string whole = pack(tetrahedron());
  for (std::size_t length = 0; length < whole.size(); ++length)
  {
    EXPECT_FALSE(unpack(std::string_view(whole).substr(0, length))) << length;
  }
  EXPECT_FALSE(unpack(whole + "x"));
}

TEST(FileSurface, IsNothingWhenItCountsOrPointsTooFar)
{
  std::string counts = pack(tetrahedron());
  counts[7] = '\x7f'; // the highest byte of the number of points
  EXPECT_FALSE(unpack(counts));
  for (const int corner : { -1, 4 })
  {
    FileSurface surface = tetrahedron();
    surface.triangles[2][1] = corner;
    EXPECT_FALSE(unpack(pack(surface))) << corner;
  }
}

} // namespace
} // namespace palp::test
