#include "app/plots/movie.h"

#include "tests/support/csv_table.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <numbers>

namespace palp
{
namespace
{

// at rest for 2 s, pressed for 3 s, at rest for 4 s, by another rate than that of a movie
std::vector<Sample> recording()
{
  std::vector<Sample> samples;
  for (int i = 0; i <= 900; ++i)
  {
    Sample sample;
    sample.time = 100.0 + 0.01 * i;
    sample.contact.depth = i >= 200 && i <= 500 ? 1e-3 : 0.0;
    samples.push_back(sample);
  }
  return samples;
}

TEST(Movie, ReplaysThePressAsLongAsItTook)
{
  const std::vector<Sample> samples = recording();
  const auto frames = movieFrames(MovieKind::Replay, samples, samples[300]);
  ASSERT_EQ(frames.size(), 96U); // 0.4 + 3 + 0.4 s, both ends
  for (std::size_t i = 0; i < frames.size(); ++i)
  {
    EXPECT_NEAR(frames[i].sample->time, 101.6 + 0.04 * static_cast<double>(i), 0.0051);
    EXPECT_EQ(frames[i].turn, 0.0);
  }
}

TEST(Movie, OfATouchlessRecordingShowsAllOfIt)
{
  std::vector<Sample> samples = recording();
  for (Sample& sample : samples)
  {
    sample.contact.depth = 0.0;
  }
  EXPECT_EQ(movieFrames(MovieKind::Replay, samples, samples[0]).size(), 226U);
  samples.resize(1);
  EXPECT_EQ(movieFrames(MovieKind::Replay, samples, samples[0]).size(), 1U);
}

TEST(Movie, ATurntableGoesOnceAround)
{
  const std::vector<Sample> samples = recording();
  const auto frames = movieFrames(MovieKind::Turntable, samples, samples[300]);
  EXPECT_EQ(frames.size(), 150U);
  EXPECT_EQ(frames.front().turn, 0.0);
  EXPECT_NEAR(frames.back().turn, 2.0 * std::numbers::pi * 149.0 / 150.0, 1e-12);
  EXPECT_TRUE(std::ranges::all_of(
    frames, [&](const MovieFrame& frame) { return frame.sample == &samples[300]; }));
}

class MovieFiles : public testing::Test
{
protected:
  // a press of the shipped block, drawn small, with these programs at hand
  test::Finished press(const std::string& path, const std::string& kinds)
  {
    return test::runCommand("PATH=" + path +
      " " PALP_PROGRAM " run " PALP_SHARE "/meshes/block_50.vtp --at 0,0,0 --depth 3mm --speed "
      "50mm/s --size 96x72 --plots force-time --movie " +
      kinds + " --out " + (folder_.path() / "out").string());
  }

  // pictures of 40 ms from 0.4 s before the first touch to 0.4 s after the last
  [[nodiscard]] int expected() const
  {
    const auto times = test::readCsv(folder_.path() / "out/samples.csv")["time_s"];
    return static_cast<int>((times.back() - times.front() + 0.8) / 0.04) + 1;
  }

  test::TemporaryFolder folder_;
};

// pictures in a Theora file: the position of its last page, in key frames and what follows them
// (Theora I Specification, 6.2 and A.2.3)
int picturesIn(const std::filesystem::path& file)
{
  const std::string bytes = test::readAll(file);
  const auto at = [&](std::size_t i) { return static_cast<unsigned char>(bytes.at(i)); };
  const std::size_t header = bytes.find("\x80theora");
  const unsigned shift = ((at(header + 40) & 3U) << 3U) | (at(header + 41) >> 5U);
  const std::size_t page = bytes.rfind("OggS");
  std::uint64_t position = 0;
  for (std::size_t i = 0; i < 8; ++i)
  {
    position |= static_cast<std::uint64_t>(at(page + 6 + i)) << (8 * i);
  }
  return static_cast<int>((position >> shift) + (position & ((1ULL << shift) - 1)));
}

TEST_F(MovieFiles, AreTheoraWhereThereIsNoOtherProgram)
{
  const test::Finished run = press("/nowhere", "replay,turntable");
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_NEAR(picturesIn(folder_.path() / "out/replay.ogv"), expected(), 1);
  EXPECT_EQ(picturesIn(folder_.path() / "out/turntable.ogv"), 150);
  const test::Finished again = test::runCommand(PALP_PROGRAM " run " +
    (folder_.path() / "out").string() + " --out " + (folder_.path() / "again").string());
  EXPECT_NE(again.err.find("repeated to the byte"), std::string::npos) << again.err;
}

// a program of that name that counts what it gets
TEST_F(MovieFiles, AreMadeByFfmpegWhereItIsThere)
{
  const std::filesystem::path program = folder_.path() / "ffmpeg";
  std::ofstream(program) << "#!/bin/sh\nwhile [ $# -gt 1 ]; do [ \"$1\" = -i ] && in=$2; shift; "
                            "done\nls \"${in%/*}\" | /usr/bin/wc -l > \"$1\"\n";
  std::filesystem::permissions(program, std::filesystem::perms::owner_all);
  const test::Finished run = press(folder_.path().string() + ":/usr/bin:/bin", "replay");
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_NEAR(std::stoi(test::readAll(folder_.path() / "out/replay.mp4")), expected(), 1);
  std::ofstream(program) << "#!/bin/sh\nexit 1\n";
  const test::Finished failed =
    press(folder_.path().string() + ":/usr/bin:/bin", "replay --overwrite");
  EXPECT_EQ(failed.code, 2) << failed.err;
  EXPECT_NE(failed.err.find("replay.mp4: the movie cannot be written"), std::string::npos)
    << failed.err;
}

} // namespace
} // namespace palp
