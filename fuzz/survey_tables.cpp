// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>

#include "pieces.h"
#include "pipeline/fuzz_bodies.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  sonar::fuzz::survey_tables({reinterpret_cast<const char*>(data), size});
  return 0;
}

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned seed) {
  return sonar::fuzz::mutate_pieces(data, size, max_size, seed, sonar::fuzz::lines_of, sonar::fuzz::line_of);
}
