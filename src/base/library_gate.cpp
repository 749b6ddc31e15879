// SPDX-License-Identifier: Apache-2.0
#include "base/library_gate.h"

namespace sonar {
namespace {

std::shared_mutex& gate() {
  static std::shared_mutex mutex;
  return mutex;
}

}  // namespace

std::shared_lock<std::shared_mutex> inside_library() { return std::shared_lock(gate()); }
std::unique_lock<std::shared_mutex> libraries_at_rest() { return std::unique_lock(gate()); }

}  // namespace sonar
