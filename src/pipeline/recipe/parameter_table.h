// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "base/describe.h"

namespace sonar {

/// Visitor that writes a described parameter struct down, as Markdown: what a user sets in one table, then the rest, which
/// experts set, in one table a group.
class ParameterTable {
 public:
  explicit ParameterTable(std::string title) { sections_.push_back({std::move(title), {}}); }

  void field(std::string_view name, bool& value, const FieldInfo& info) {
    row(name, value ? "true" : "false", info.unit, "false, true", info.text, info.tier);
  }
  void field(std::string_view name, std::string& value, const FieldInfo& info) {
    row(name, fmt::format("\"{}\"", value), info.unit, "", info.text, info.tier);
  }
  void field(std::string_view name, int& value, const FieldInfo& info) { number(name, value, info); }
  void field(std::string_view name, double& value, const FieldInfo& info) { number(name, value, info); }
  template <class E>
  void choice(std::string_view name, E& value, ChoiceNames names, const ChoiceInfo& info) {
    const std::string_view chosen = names[static_cast<std::size_t>(value)];
    row(name, fmt::format("\"{}\"", chosen), "", fmt::format("{}", fmt::join(names, ", ")), info.text, info.tier);
  }
  template <class P>
  void group(std::string_view name, P& parameters, std::string_view text) {
    const std::string outer_prefix = prefix_;
    const std::size_t outer_section = section_;
    prefix_ += std::string(name) + ".";
    section_ = sections_.size();
    sections_.push_back({fmt::format("`{}{}`: {}", outer_prefix, name, text), {}});
    describe(*this, parameters);
    prefix_ = outer_prefix;
    section_ = outer_section;
  }
  [[nodiscard]] std::string markdown() const;
  /// "  grow.tolerance_db (10 dB): what it does" of those that a user sets, for --help.
  [[nodiscard]] std::string basic_text() const { return basic_text_; }

 private:
  struct Section {
    std::string title;
    std::vector<std::string> rows;
  };

  template <class T>
  void number(std::string_view name, T value, const FieldInfo& info) {
    row(name, fmt::format("{}", value), info.unit, range(info), info.text, info.tier);
  }
  static std::string range(const FieldInfo& info);
  void row(std::string_view name, std::string_view value, std::string_view unit, std::string_view range,
           std::string_view text, Tier tier);

  std::string prefix_;
  std::size_t section_ = 0;
  std::vector<Section> sections_;
  std::vector<std::string> basic_rows_;
  std::string basic_text_;
};

}  // namespace sonar
