#include "app/arms/arm_file.h"

#include "haptics/error.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <string>
#include <unistd.h>

namespace palp
{
namespace
{

std::string textOf(const std::filesystem::path& file)
{
  std::ifstream in(file);
  return { std::istreambuf_iterator<char>(in), {} };
}

class ArmFile : public ::testing::Test
{
protected:
  void SetUp() override
  {
    setenv("XDG_CONFIG_HOME", folder_.c_str(), 1);
    saveArm(file_, arm_);
  }
  void TearDown() override
  {
    unsetenv("XDG_CONFIG_HOME");
    std::filesystem::remove_all(folder_);
  }

  const std::string folder_ = testing::TempDir() + "palp_arms_" + std::to_string(getpid());
  const std::filesystem::path file_ = folder_ + "/palp/arms/wooden-16c0-0486.json";
  const IdentifiedArm arm_{ .axes = { ArmAxis{ 0.1, 0.2, 0.03, 1.0 },
                              ArmAxis{ 0.4, 0.5, 0.06, 0.9 }, ArmAxis{ 0.7, 0.8, 0.09, 0.8 } },
    .delay = 0.0015,
    .encoderStep = 48e-6,
    .scale = 0.6 };
};

TEST_F(ArmFile, KeepsWhatWasMeasured)
{
  EXPECT_EQ(armFile("wooden 16c0:0486"), file_);
  const auto back = loadArm(file_);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->axes[1].damping, 0.5);
  EXPECT_EQ(back->axes[2].friction, 0.09);
  EXPECT_EQ(back->delay, 0.0015);
  EXPECT_EQ(back->scale, 0.6);
  EXPECT_TRUE(back->agrees());
  EXPECT_FALSE(loadArm(folder_ + "/none.json"));
}

TEST_F(ArmFile, SaysOfADamagedOneWhatIsWrong)
{
  const std::string good = textOf(file_);
  const auto messageWith = [&](const std::string& old, const std::string& now)
  {
    std::string bad = good;
    bad.replace(bad.find(old), old.size(), now);
    std::ofstream(file_) << bad;
    try
    {
      (void)loadArm(file_);
    }
    catch (const Error& error)
    {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(messageWith("mass_kg", "mass_g").find("mass_kg is missing"), std::string::npos);
  EXPECT_NE(messageWith("0.2", "-0.2").find("damping_N_s_per_m is beyond"), std::string::npos);
  EXPECT_NE(messageWith("0.0015", "1.5").find("delay_s is beyond"), std::string::npos); // in ms
  EXPECT_NE(messageWith("\"y\"", "\"q\"").find("axes are not"), std::string::npos);
  EXPECT_NE(messageWith("{", "").find("in JSON"), std::string::npos);
  EXPECT_NE(messageWith("0.6", "\"0.6\"").find("scale is missing or no number"), std::string::npos);
}

TEST_F(ArmFile, RefusesAKeyThatStandsTwice)
{
  std::string text = textOf(file_);
  text.insert(text.find('{') + 1, "\"scale\": 1.0,");
  std::ofstream(file_) << text;
  try
  {
    (void)loadArm(file_);
    FAIL() << "taken";
  }
  catch (const Error& error)
  {
    EXPECT_NE(std::string(error.what()).find("'scale' stands twice"), std::string::npos)
      << error.what();
  }
}

} // namespace
} // namespace palp
