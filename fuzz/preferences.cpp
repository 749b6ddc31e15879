// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>

#include "scratch_folder.h"
#include "session/fuzz_bodies.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const sonar::fuzz::ScratchFolder folder("preferences");
  sonar::fuzz::preferences({reinterpret_cast<const char*>(data), size}, folder.path());
  return 0;
}
