// SPDX-License-Identifier: Apache-2.0
#include "base/units.h"

#include <cstddef>
#include <vector>

namespace sonar {
namespace {

std::vector<double> make_linear_table() {
  std::vector<double> table(65536);
  for (int count = -32767; count <= 32767; ++count) {
    table[static_cast<std::size_t>(count + 32768)] = std::exp2(static_cast<double>(count) / 256.0);
  }
  table[0] = 0.0;
  return table;
}

}  // namespace

double linear_from_count(std::int16_t count) {
  static const std::vector<double> table = make_linear_table();
  return table[static_cast<std::size_t>(static_cast<int>(count) + 32768)];
}

}  // namespace sonar
