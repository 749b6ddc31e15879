// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/describe.h"
#include "cli/one_of.h"

namespace sonar {

/// "first_hit_db" -> "first-hit-db".
[[nodiscard]] std::string with_dashes(std::string_view name);

/// Visitor: makes a flag of every field of a described struct, which outlives the parser. A switch that is on becomes what
/// turns it off.
class DescribedFlags {
 public:
  struct Made {
    std::string flag;
    std::string suits;  ///< as FieldInfo's
  };

  /// group  heading in the help
  /// suits  of fields that say nothing themselves
  DescribedFlags(CLI::App& verb, std::string group, std::string suits, std::vector<Made>& made)
      : verb_(verb), group_(std::move(group)), suits_(std::move(suits)), made_(made) {}

  void field(std::string_view name, bool& value, const FieldInfo& info);
  void field(std::string_view name, int& value, const FieldInfo& info);
  void field(std::string_view name, double& value, const FieldInfo& info);
  void field(std::string_view name, std::string& value, const FieldInfo& info);
  template <class E>
  void choice(std::string_view name, E& value, ChoiceNames names, const ChoiceInfo& info) {
    std::vector<std::string> spelled;
    for (const std::string_view one : names) spelled.push_back(with_dashes(one));
    const auto take = [&value, spelled](const std::string& text) {
      value = static_cast<E>(std::find(spelled.begin(), spelled.end(), text) - spelled.begin());
    };
    const std::string initial = spelled[static_cast<std::size_t>(value)];
    auto* option = verb_.add_option_function<std::string>("--" + with_dashes(name), take, sentence(info.text));
    // Tables and recipes write underscores.
    const auto dashed = [](std::string& text) {
      text = with_dashes(text);
      return std::string{};
    };
    option->transform(CLI::Validator(dashed, ""));
    add(option->check(one_of(spelled))->default_str(initial), info.suits);
  }
  template <class P>
  void group(std::string_view, P& p, std::string_view) {
    describe(*this, p);
  }

 private:
  static std::string sentence(std::string_view text);
  static std::string flag_of(std::string_view name, const FieldInfo& info);
  void add(CLI::Option* option, std::string_view suits);

  CLI::App& verb_;
  std::string group_;
  std::string suits_;
  std::vector<Made>& made_;
};

}  // namespace sonar
