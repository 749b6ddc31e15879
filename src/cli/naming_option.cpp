// SPDX-License-Identifier: Apache-2.0
#include "cli/naming_option.h"

#include <fmt/format.h>

#include <string>

namespace sonar {

Error naming_option(Error error, std::span<const OptionOf> options) {
  for (const auto& [parameter, option] : options) {
    const std::string begins = fmt::format("{} = ", parameter);
    if (error.text.starts_with(begins)) error.text.replace(0, begins.size(), fmt::format("{}: ", option));
  }
  return error;
}

}  // namespace sonar
