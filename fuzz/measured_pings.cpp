// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>

#include "pipeline/fuzz_bodies.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  sonar::fuzz::measured_pings({reinterpret_cast<const char*>(data), size});
  return 0;
}
