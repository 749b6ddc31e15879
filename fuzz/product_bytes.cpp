// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>

#include "io/fuzz_product.h"
#include "scratch_folder.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const sonar::fuzz::ScratchFolder folder("product_bytes");
  sonar::fuzz::product_bytes({reinterpret_cast<const char*>(data), size}, folder.path());
  return 0;
}
