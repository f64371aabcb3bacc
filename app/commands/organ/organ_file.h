#pragma once

#include "app/press/body.h"
#include "app/program/interrupt.h"
#include "calibration/organ/organ_model.h"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace palp
{

/// What an organ file is made of.
struct OrganFilePlan
{
  std::filesystem::path out;
  std::vector<std::string> supports; ///< as text
  double young = 50e3;               ///< [Pa]; of a body with a map E* is of this
  double poisson = 0.33;             ///< [-]
  double cell = 4e-3;                ///< side of the cubes [m]
  bool overwrite = false;            ///< an organ file of something else
};

/// Makes an organ file of a body, or goes on with one that was begun beside it; does nothing where
/// it is there. Says its size, the time, and the places that it cannot answer for.
///
/// @param supports   of the plan
/// @param interrupt  made before the body was loaded
/// @throws Error    BadFile: out is a file of something else, or cannot be written; NoSolution:
///                  interrupted, what was reached waits beside out; also as OrganModel
void makeOrganFile(const OrganFilePlan& plan, const SceneBody& body,
  std::span<const Support> supports, Interrupt& interrupt);

/// Its size, and what of the body it leaves out.
[[nodiscard]] std::string inWords(const OrganModel& model);

/// What is told where it is interrupted before any place is solved for.
inline constexpr const char* kNoPlaceYet =
  "interrupted before the first places were done; nothing is written";

} // namespace palp
