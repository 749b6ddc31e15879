// SPDX-License-Identifier: Apache-2.0
#include "io/fuzz_raster.h"

#include <cstddef>
#include <cstdint>
#include <span>

#include "scratch_folder.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const sonar::fuzz::ScratchFolder folder("raster");
  static const sonar::fuzz::RasterFuzz raster(folder.path());
  raster(std::as_bytes(std::span(data, size)));
  return 0;
}
