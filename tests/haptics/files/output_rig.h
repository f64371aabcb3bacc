#pragma once

#include "haptics/files/output_folder.h"
#include "haptics/files/replace_file.h"
#include "tests/support/process.h"

#include <gtest/gtest.h>

namespace palp
{

/// Runs that leave a.csv and b.csv in one folder.
class OutputRig : public testing::Test
{
protected:
  using Earlier = OutputFolder::Earlier;

  void write(const std::string& text, Earlier earlier = Earlier::Refuse)
  {
    OutputFolder output(out_, kOwn, earlier);
    replaceFile(output.stage() / "a.csv", text);
    replaceFile(output.stage() / "b.csv", text);
    output.publish();
  }

  void expectBoth(const std::string& text) const
  {
    EXPECT_EQ(test::readAll(out_ / "a.csv"), text);
    EXPECT_EQ(test::readAll(out_ / "b.csv"), text);
  }

  const std::vector<std::string> kOwn{ "a.csv", "b.csv", "plot.png" };
  test::TemporaryFolder folder_;
  std::filesystem::path out_ = folder_.path() / "some" / "out";
};

} // namespace palp
