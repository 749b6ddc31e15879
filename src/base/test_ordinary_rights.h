// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <unistd.h>

#include "base/check.h"

namespace sonar {

/// The rights of an ordinary user while it lives, for tests: root may write anywhere, whatever a folder's mode says. False
/// where root cannot give its own up.
class OrdinaryRights {
 public:
  OrdinaryRights() : root_(::geteuid() == 0), ordinary_(!root_ || ::seteuid(kNobody) == 0) {}
  ~OrdinaryRights() {
    if (root_ && ordinary_) SONAR_CHECK(::seteuid(0) == 0);
  }
  OrdinaryRights(const OrdinaryRights&) = delete;
  OrdinaryRights& operator=(const OrdinaryRights&) = delete;
  [[nodiscard]] explicit operator bool() const { return ordinary_; }

 private:
  static constexpr uid_t kNobody = 65534;
  bool root_;
  bool ordinary_;
};

}  // namespace sonar
