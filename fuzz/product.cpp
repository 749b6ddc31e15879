// SPDX-License-Identifier: Apache-2.0
#include "io/fuzz_product.h"

#include <cstddef>
#include <cstdint>
#include <span>

#include "scratch_folder.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const sonar::fuzz::ScratchFolder folder("product");
  static const sonar::fuzz::ProductFuzz product(folder.path());
  product(std::as_bytes(std::span(data, size)));
  return 0;
}
