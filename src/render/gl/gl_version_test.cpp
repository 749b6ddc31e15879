// SPDX-License-Identifier: Apache-2.0
#include "render/gl/gl_version.h"

#include <gtest/gtest.h>

namespace sonar {
namespace {

// Names as the drivers report them.
TEST(GlVersion, SoftwareDriversAreKnownByTheirNames) {
  for (const char* driver :
       {"llvmpipe (LLVM 15.0.6, 256 bits)", "softpipe", "Mesa Software Rasterizer", "Gallium 0.4 on swrast",
        "ANGLE (Google, Vulkan 1.3.0 (SwiftShader Device (LLVM 10.0.0)), SwiftShader driver)"}) {
    EXPECT_TRUE(draws_by_software(driver)) << driver;
  }
  for (const char* driver : {"NVIDIA H100 PCIe/PCIe/SSE2", "Mesa Intel(R) UHD Graphics 630 (CFL GT2)",
                             "AMD Radeon RX 6600 (navi23, LLVM 15.0.6, DRM 3.49)", "unknown driver"}) {
    EXPECT_FALSE(draws_by_software(driver)) << driver;
  }
}

}  // namespace
}  // namespace sonar
