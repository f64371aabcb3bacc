#pragma once

#include "calibration/study/study.h"
#include "haptics/error.h"
#include "tests/calibration/indentation_case.h"
#include "tests/support/process.h"

#include <filesystem>

namespace palp::fem
{

/// The paper's case with three depths, a second or two each.
inline Case quick()
{
  Case study = paperCase();
  study.elementSize = 1.0_mm;
  study.depths = { 1.0_mm, 2.0_mm, 2.5_mm };
  return study;
}

/// Into a folder, as the command does it
inline Outcome calibrateInto(const std::filesystem::path& folder, const Case& study, bool resume,
  std::stop_token stop = {}, const Progress& progress = {})
{
  OutputFolder output(folder, calibrationFiles(),
    resume ? OutputFolder::Earlier::Keep : OutputFolder::Earlier::Replace);
  return fem::calibrateInto(output, study, resume, stop, progress);
}

/// The message of the error that resuming gives; empty when it goes on
inline std::string resumeRefusal(const std::filesystem::path& folder, const Case& study)
{
  try
  {
    (void)calibrateInto(folder, study, true);
  }
  catch (const Error& error)
  {
    EXPECT_EQ(error.code(), ErrorCode::BadFile);
    return error.what();
  }
  return {};
}

} // namespace palp::fem
