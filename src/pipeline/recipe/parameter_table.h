// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "base/describe.h"

namespace sonar {

/// Visitor that writes a described parameter struct down for its user, as Markdown: one table a group.
class ParameterTable {
 public:
  explicit ParameterTable(std::string title) { sections_.push_back({std::move(title), {}}); }

  void field(std::string_view name, bool& value, const FieldInfo& info) {
    row(name, value ? "true" : "false", info.unit, "false, true", info.text);
  }
  void field(std::string_view name, std::string& value, const FieldInfo& info) {
    row(name, fmt::format("\"{}\"", value), info.unit, "", info.text);
  }
  void field(std::string_view name, int& value, const FieldInfo& info) { number(name, value, info); }
  void field(std::string_view name, double& value, const FieldInfo& info) { number(name, value, info); }
  template <class E>
  void choice(std::string_view name, E& value, ChoiceNames names, std::string_view text) {
    const std::string_view chosen = names[static_cast<std::size_t>(value)];
    row(name, fmt::format("\"{}\"", chosen), "", fmt::format("{}", fmt::join(names, ", ")), text);
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

 private:
  struct Section {
    std::string title;
    std::vector<std::string> rows;
  };
  template <class T>
  void number(std::string_view name, T value, const FieldInfo& info) {
    row(name, fmt::format("{}", value), info.unit, range(info), info.text);
  }
  static std::string range(const FieldInfo& info);
  void row(std::string_view name, std::string_view value, std::string_view unit, std::string_view range,
           std::string_view text);

  std::string prefix_;
  std::size_t section_ = 0;
  std::vector<Section> sections_;
};

}  // namespace sonar
