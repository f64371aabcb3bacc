#include "app/press/recorded_rows.h"

#include "app/press/playback.h"
#include "app/press/presses.h"
#include "haptics/units.h"
#include "tests/support/process.h"
#include "tests/support/surfaces.h"

#include <fstream>
#include <gtest/gtest.h>

namespace palp
{
namespace
{

using namespace units::literals;

std::string written(const Recording& recording)
{
  std::ostringstream out;
  writeSamples(out, recording, nullptr);
  writePresses(out, recording);
  return out.str();
}

// a ball on a block: pressed, held, drawn aside and drawn out faster than the tissue follows
Recording recordingOf(const LawSettings& settings)
{
  Recording recording;
  recording.scene.surface =
    std::make_shared<const Surface>(test::makeSurface(test::block({ 0.2, 0.2, 0.1 }, 20)));
  recording.scene.law = ForceLaw(SphereTip{ 10.0_mm }, Material{ 7.3_kPa, 0.45 }, settings);
  const ScriptedPath path({ { 0.0, { 0.0, 0.0, 1.0_mm } }, { 0.1, { 0.0, 0.0, -4.7_mm } },
    { 0.3, { 3.1_mm, 0.0, -4.7_mm } }, { 0.32, { 3.1_mm, 0.0, 1.0_mm } } });
  recording.samples = play(path, recording.scene);
  return recording;
}

// what only its past tells of tissue that relaxes and rubs is read from the file, to the last bit
TEST(RecordedRows, OfTissueThatRemembersAreWhatWasFelt)
{
  const test::TemporaryFolder folder;
  for (const double mu : { 0.0, 0.3 })
  {
    LawSettings settings{ .mode = LawMode::Corrected, .friction = mu };
    settings.relaxation.add({ 0.5, 200.0_ms });
    const Recording felt = recordingOf(settings);
    const std::string text = written(felt);
    const std::filesystem::path file = folder.path() / "samples.csv";
    std::ostringstream samples;
    writeSamples(samples, felt, nullptr);
    std::ofstream(file) << samples.str();

    Recording again = felt;
    readRows(again, file);
    EXPECT_EQ(written(again), text) << mu;
    ASSERT_EQ(again.samples.size(), felt.samples.size());
    for (std::size_t i = 0; i < felt.samples.size(); ++i)
    {
      const Sample& read = again.samples[i];
      const Sample& was = felt.samples[i];
      EXPECT_EQ(read.response.force, was.response.force) << i;
      EXPECT_NEAR(read.response.stiffness, was.response.stiffness, 1e-12 * was.response.stiffness);
      EXPECT_NEAR(read.surfaceDepth, was.surfaceDepth, 1e-15) << i;
      EXPECT_EQ(read.friction, was.friction) << i;
    }
    const auto instantly = recordingOf({ .mode = LawMode::Corrected });
    EXPECT_LT(findPresses(again).at(0).force, 0.95 * findPresses(instantly).at(0).force);
  }
}

} // namespace
} // namespace palp
