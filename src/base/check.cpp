// SPDX-License-Identifier: Apache-2.0
#include "base/check.h"

#include <cstdio>
#include <cstdlib>

namespace sonar {

void contract_broken(std::string_view condition, std::string_view file, int line) {
  std::fprintf(stderr, "%.*s:%d: contract broken: %.*s\n", static_cast<int>(file.size()), file.data(), line,
               static_cast<int>(condition.size()), condition.data());
  std::abort();
}

}  // namespace sonar
