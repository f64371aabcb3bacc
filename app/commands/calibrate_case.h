#pragma once

#include "calibration/study/study.h"

#include <map>
#include <string>

namespace palp
{

/// A case of palp calibrate as text with units, by the name of its option.
struct CaseText
{
  std::map<std::string, std::string> values{ { "block", "100x100x50mm" }, { "tip", "sphere:10mm" },
    { "young", "50kPa" }, { "poisson", "0.33" }, { "material", "neo-hookean" },
    { "depth", "0.5:10:0.5mm" }, { "threshold", "0.5mm" }, { "cap", "0.3mm" },
    { "model", "axisymmetric" }, { "base", "bonded" }, { "element-size", "" }, { "coating", "" },
    { "nodule", "" }, { "stiffness", "" } };
};

/// @throws Error  BadValue: names the option and what to give
[[nodiscard]] fem::Case caseOf(const std::string& name, const CaseText& text);

} // namespace palp
