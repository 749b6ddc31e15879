// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>

#include "pipeline/fuzz_bodies.h"
#include "scratch_folder.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const sonar::fuzz::ScratchFolder folder("work_folder");
  sonar::fuzz::work_folder({reinterpret_cast<const char*>(data), size}, folder.path());
  return 0;
}
