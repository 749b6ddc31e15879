// SPDX-License-Identifier: Apache-2.0
#include "pipeline/recipe/parameter_table.h"

#include <cmath>

namespace sonar {
namespace {

constexpr std::string_view kHead = "| Parameter | Value | Unit | Range | Meaning |\n|---|---|---|---|---|\n";

}  // namespace

std::string ParameterTable::range(const FieldInfo& info) {
  if (!std::isfinite(info.min) && !std::isfinite(info.max)) return "";
  if (!std::isfinite(info.max)) return fmt::format("{} or more", info.min);
  if (!std::isfinite(info.min)) return fmt::format("{} or less", info.max);
  return fmt::format("{} .. {}", info.min, info.max);
}

void ParameterTable::row(std::string_view name, std::string_view value, std::string_view unit, std::string_view range,
                         std::string_view text, Tier tier) {
  std::string row = fmt::format("| `{}{}` | {} | {} | {} | {} |\n", prefix_, name, value, unit, range, text);
  if (tier == Tier::expert) {
    sections_[section_].rows.push_back(std::move(row));
    return;
  }
  basic_rows_.push_back(std::move(row));
  basic_text_ += fmt::format("  {}{} ({}{}{})\n      {}\n", prefix_, name, value,
                             unit.empty() || unit == "1" ? "" : " ", unit == "1" ? "" : unit, text);
}

std::string ParameterTable::markdown() const {
  std::string text;
  std::string_view level = "##";
  if (!basic_rows_.empty()) {
    text = fmt::format("## What a user sets\n\n{}{}\n## For experts\n", kHead, fmt::join(basic_rows_, ""));
    level = "###";
  }
  for (const Section& section : sections_) {
    if (section.rows.empty()) continue;
    if (!text.empty()) text += "\n";
    text += fmt::format("{} {}\n\n{}{}", level, section.title, kHead, fmt::join(section.rows, ""));
  }
  return text;
}

}  // namespace sonar
