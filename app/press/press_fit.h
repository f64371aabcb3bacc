#pragma once

#include "app/press/press_log.h"
#include "calibration/fit/modulus_fit.h"

namespace palp
{

/// Young's modulus that the way in of a press tells of, by the law, the tool and the place of it.
///
/// The depth is that of the contact, so no touch is searched. Of a press whose force is the law's
/// own, on one place, the answer is the modulus in use; of one that was computed with nodules, with
/// friction or while it slid, what a user would be told by the curve alone.
///
/// @throws Error  BadValue: the body gave way by an organ file; also as fit::fitModulus
[[nodiscard]] fit::ModulusFit fitPress(const KeptPress& press);

} // namespace palp
