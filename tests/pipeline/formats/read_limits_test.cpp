#include "haptics/error.h"
#include "pipeline/formats/read_limits.h"
#include "tests/support/process.h"

#include <gtest/gtest.h>

namespace palp
{
namespace
{

class ReadLimits : public testing::Test
{
protected:
  [[nodiscard]] std::filesystem::path file(const std::string& name, std::size_t bytes) const
  {
    std::ofstream(folder_.path() / name) << std::string(bytes, 'x');
    return folder_.path() / name;
  }
  // of bytes, side^3 of them, which are in `data`
  [[nodiscard]] std::filesystem::path image(
    const std::string& name, const std::string& side, const std::string& data) const
  {
    std::ofstream(folder_.path() / name)
      << "ObjectType = Image\nNDims = 3\nDimSize = " << side << ' ' << side << ' ' << side
      << "\nElementType = MET_UCHAR\nElementSpacing = 1 1 1\nElementDataFile = " << data << '\n';
    return folder_.path() / name;
  }

private:
  test::TemporaryFolder folder_;
};

TEST_F(ReadLimits, GrowWithTheFile)
{
  const ChildLimits small = readLimits(file("small.stl", 1));
  const ChildLimits large = readLimits(file("large.stl", 10'000'000));
  EXPECT_LT(small.memory, 1U << 30U);
  EXPECT_LE(small.time, 5U); // a damaged one ends within that
  EXPECT_GT(large.memory, small.memory + 100'000'000);
  EXPECT_GT(large.time, small.time);
}

TEST_F(ReadLimits, GrowWithAHeaderThatMayBeTrue)
{
  (void)file("data.raw", 1);
  const ChildLimits small = readLimits(image("small.mhd", "8", "data.raw"));
  const ChildLimits large = readLimits(image("large.mhd", "512", "data.raw"));
  EXPECT_GT(large.memory, small.memory + 134'217'728U);
  EXPECT_GT(large.time, small.time + 10);
  // no file of 200 bytes holds that, however well it is packed
  const ChildLimits claimed = readLimits(image("claimed.mha", "512", "LOCAL"));
  EXPECT_LT(claimed.memory, 1U << 30U);
  EXPECT_LE(claimed.time, 5U);
}

TEST_F(ReadLimits, RefuseMoreThanTheMachineHas)
{
  (void)file("data.raw", 1);
  EXPECT_NO_THROW(checkFits(image("large.mhd", "512", "data.raw")));
  EXPECT_THROW(checkFits(image("huge.mhd", "60000", "data.raw")), Error); // 200 TB
}

} // namespace
} // namespace palp
