// SPDX-License-Identifier: Apache-2.0
#include "render/fuzz_bodies.h"

#include <cstddef>
#include <cstdint>
#include <span>

#include "scratch_folder.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const sonar::fuzz::ScratchFolder folder("png");
  sonar::fuzz::png(std::as_bytes(std::span(data, size)), folder.path());
  return 0;
}
