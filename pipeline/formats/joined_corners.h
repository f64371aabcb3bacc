#pragma once

#include "pipeline/process/file_surface.h"

namespace palp
{

/// The same with points that coincide as one, where each triangle has corners of its own, as in an
/// STL: a sixth of them is then to be sent.
[[nodiscard]] FileSurface withJoinedCorners(FileSurface surface);

} // namespace palp
