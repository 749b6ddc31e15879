// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace sonar {

/// The known word that somebody may have meant: one that begins so, or differs by a slip or two. Empty where there is none.
[[nodiscard]] std::string suggestion(std::string_view word, const std::vector<std::string>& known);

}  // namespace sonar
