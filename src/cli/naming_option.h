// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>

#include "base/result.h"

namespace sonar {

/// A parameter of the library and the option of a verb that sets it.
struct OptionOf {
  std::string_view parameter;
  std::string_view option;
};

/// Where a parameter outside its range was given by an option, the option stands in the message.
[[nodiscard]] Error naming_option(Error error, std::span<const OptionOf> options);

}  // namespace sonar
