// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "model/sounder.h"

namespace sonar::simrad {

struct Con0 {
  SounderConfig config;
  std::string problem;      ///< why not all of it could be read; empty = sound
  std::string bad_numbers;  ///< the first beam with a number that is not finite; empty = none
};

/// Family from the sounder's name.
[[nodiscard]] SounderKind kind_of(const std::string& sounder_name);

/// Reads the body of a CON0: header and as many whole 320-byte beam blocks as there are, never more
/// than it says. Numbers that are not finite become NaN; texts are cut at their first NUL.
[[nodiscard]] Con0 parse_con0(std::span<const std::byte> body);

}  // namespace sonar::simrad
