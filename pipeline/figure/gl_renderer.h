#pragma once

#include <string>
#include <string_view>

class vtkRenderWindow;

namespace palp
{

/// The name that OpenGL gives of what draws, as "llvmpipe (LLVM 15.0.6, 256 bits)".
/// @param window  that has drawn
[[nodiscard]] std::string rendererNameOf(vtkRenderWindow& window);

/// Whether that is a program on the processor and no graphics card; so is taken what has no name.
/// @source  Mesa's llvmpipe, softpipe, swrast, SWR, lavapipe and OSMesa, also below zink, virgl and
///          D3D12; SwiftShader; Apple's and Microsoft's
[[nodiscard]] bool drawsInSoftware(std::string_view renderer);

} // namespace palp
