// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>

#include "io/fuzz_bodies.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  sonar::fuzz::wire({reinterpret_cast<const std::byte*>(data), size});
  return 0;
}
