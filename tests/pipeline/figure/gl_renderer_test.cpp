#include "pipeline/figure/gl_renderer.h"

#include "tests/pipeline/picture.h"

#include <gtest/gtest.h>

namespace palp
{
namespace
{

// as drivers tell of themselves, from bug reports and glxinfo
TEST(GlRenderer, TellsProgramsFromGraphicsCards)
{
  for (const char* program :
    { "llvmpipe (LLVM 15.0.6, 256 bits)", "softpipe", "Software Rasterizer", "Mesa X11",
      "SWR (LLVM 10.0.0, 256 bits)", "Mesa OffScreen", "virgl (LLVMPIPE (LLVM 15.0.7, 256 bits))",
      "zink Vulkan 1.3(llvmpipe (LLVM 17.0.6, 256 bits) (MESA_LLVMPIPE))",
      "D3D12 (Microsoft Basic Render Driver)", "GDI Generic", "Apple Software Renderer",
      "ANGLE (Google, Vulkan 1.3.0 (SwiftShader Device (Subzero) (0x0000C0DE)), SwiftShader "
      "driver)",
      "" })
  {
    EXPECT_TRUE(drawsInSoftware(program)) << program;
  }
  for (const char* card : { "NVIDIA GeForce RTX 3060/PCIe/SSE2", "Quadro P2000/PCIe/SSE2", "NV136",
         "Mesa Intel(R) UHD Graphics 620 (KBL GT2)", "Mesa DRI Intel(R) HD Graphics 4000 (IVB GT2)",
         "AMD Radeon RX 6800 (navi21, LLVM 15.0.6, DRM 3.49, 6.1.0-13-amd64)",
         "AMD RENOIR (DRM 3.40.0, 5.10.0-8-amd64, LLVM 11.0.1)", "Mali-G52 (Panfrost)", "V3D 4.2",
         "Apple M1", "D3D12 (NVIDIA GeForce RTX 3080)", "virgl (Mesa Intel(R) Iris(R) Xe Graphics)",
         "zink Vulkan 1.3(AMD Radeon RX 7900 XTX (RADV NAVI31))",
         "ANGLE (Intel, Intel(R) UHD Graphics 630 Direct3D11 vs_5_0 ps_5_0)" })
  {
    EXPECT_FALSE(drawsInSoftware(card)) << card;
  }
}

TEST(GlRenderer, IsNamedByAWindowThatHasDrawn)
{
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->AddRenderer(vtkNew<vtkRenderer>());
  window->Render();
  const std::string name = rendererNameOf(*window);
  EXPECT_FALSE(name.empty());
  EXPECT_NE(std::string(window->ReportCapabilities()).find(name), std::string::npos) << name;
}

} // namespace
} // namespace palp
