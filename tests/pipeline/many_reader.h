#pragma once

#include "pipeline/formats/joined_corners.h"
#include "pipeline/formats/surface_formats.h"
#include "pipeline/surface_io/surface_io.h"

#include <gtest/gtest.h>
#ifdef PALP_SANITIZED
#include <sanitizer/lsan_interface.h>
#endif

namespace palp::test
{

/// Reads many files, every fifth as the program does, which must say nothing by itself; the others
/// in the process of the test, where a sanitizer tells more of a crash, and without a start of
/// palp-read for each.
class ManyReader
{
public:
  LoadedSurface read(const std::filesystem::path& file, UnitChoice unit = {})
  {
    const bool asProgram = count_++ % 5 == 0;
    const Said said(asProgram);
#ifdef PALP_SANITIZED
    // VTK loses some of what it throws away of a damaged file, which ends with palp-read
    const __lsan::ScopedDisabler leaks;
#endif
    return asProgram ? readSurface(file, unit)
                     : madeReady(withJoinedCorners(readFile(file)), file, unit);
  }

private:
  // to standard error; what VTK says within the test, it says within palp-read to nobody
  class Said
  {
  public:
    explicit Said(bool isNothing)
      : isNothing_(isNothing)
    {
      testing::internal::CaptureStderr();
    }
    ~Said()
    {
      const std::string text = testing::internal::GetCapturedStderr();
      EXPECT_TRUE(text.empty() || !isNothing_) << text;
    }
    Said(const Said&) = delete;
    Said& operator=(const Said&) = delete;

  private:
    bool isNothing_;
  };

  int count_ = 0;
};

} // namespace palp::test
