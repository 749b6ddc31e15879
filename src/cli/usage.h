// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <span>
#include <string>
#include <vector>

namespace sonar {

[[nodiscard]] std::vector<std::string> verb_names(const CLI::App& app);

/// "there is no verb 'rum'; did you mean run?"
[[nodiscard]] std::string no_verb_text(const CLI::App& app, const std::string& name);

/// What was wrong with a call, in plain words: the parser's own speak of arguments that are not expected.
/// words   of the call, the program's name first
[[nodiscard]] std::string usage_text(const CLI::App& app, const CLI::ParseError& error, std::span<char*> words);

}  // namespace sonar
