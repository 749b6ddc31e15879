// SPDX-License-Identifier: Apache-2.0
#include "pipeline/recipe/parameter_table.h"

#include <cmath>

namespace sonar {

std::string ParameterTable::range(const FieldInfo& info) {
  if (!std::isfinite(info.min) && !std::isfinite(info.max)) return "";
  if (!std::isfinite(info.max)) return fmt::format("{} or more", info.min);
  if (!std::isfinite(info.min)) return fmt::format("{} or less", info.max);
  return fmt::format("{} .. {}", info.min, info.max);
}

void ParameterTable::row(std::string_view name, std::string_view value, std::string_view unit, std::string_view range,
                         std::string_view text) {
  sections_[section_].rows.push_back(
      fmt::format("| `{}{}` | {} | {} | {} | {} |\n", prefix_, name, value, unit, range, text));
}

std::string ParameterTable::markdown() const {
  std::string text;
  for (const Section& section : sections_) {
    if (section.rows.empty()) continue;
    if (!text.empty()) text += "\n";
    text +=
        fmt::format("## {}\n\n| Parameter | Value | Unit | Range | Meaning |\n|---|---|---|---|---|\n", section.title);
    for (const std::string& row : section.rows) text += row;
  }
  return text;
}

}  // namespace sonar
