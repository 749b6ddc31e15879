// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

namespace sonar {

/// Refuses what is no number between least and most; the parser's own range lets "nan" through.
[[nodiscard]] CLI::Validator within(double least, double most);

}  // namespace sonar
