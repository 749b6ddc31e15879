// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>
#include <span>

#include "io/fuzz_bodies.h"
#include "scratch_folder.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const sonar::fuzz::ScratchFolder folder("sealed");
  sonar::fuzz::sealed_file(std::as_bytes(std::span(data, size)), folder.path());
  return 0;
}
