// SPDX-License-Identifier: Apache-2.0
#include "publish/reports/report_columns.h"

#include <algorithm>
#include <array>

#include "base/utf8.h"
#include "publish/reports/report_cells.h"
#include "view/maps/map_items.h"
#include "view/theme.h"

namespace sonar {
namespace {

constexpr double kGap_px = 6.0;       ///< between columns
constexpr double kWidestText = 22.0;  ///< of a column, in sizes of its text: longer texts get more lines
constexpr std::string_view kJoins = "_/-";
constexpr std::array<std::string_view, 3> kKeys{"observation", "school_id", "ping_index"};

double width_of(std::string_view text, double size_px) { return text_width_px(std::string(text).c_str(), size_px); }

/// Where the character that begins at `at` ends.
std::size_t next_character(std::string_view text, std::size_t at) {
  for (++at; at < text.size() && (static_cast<unsigned char>(text[at]) & 0xC0U) == 0x80U;) ++at;
  return at;
}

/// As much of a word's beginning as a line has room for; one character at least.
std::size_t fitting(std::string_view word, double width_px, double size_px) {
  std::size_t fits = next_character(word, 0);
  std::size_t joined = 0;
  for (std::size_t end = fits; end <= word.size() && width_of(word.substr(0, end), size_px) <= width_px;) {
    fits = end;
    if (kJoins.find(word[end - 1]) != std::string_view::npos) joined = end;
    if (end == word.size()) return end;
    end = next_character(word, end);
  }
  return joined > 0 ? joined : fits;
}

void add_line(std::vector<std::string>& lines, std::string_view line, double width_px, double size_px) {
  while (width_of(line, size_px) > width_px) {
    const std::size_t end = fitting(line, width_px, size_px);
    if (end >= line.size()) break;
    lines.emplace_back(line.substr(0, end));
    line.remove_prefix(end);
  }
  lines.emplace_back(line);
}

/// Of the parts that a name may be broken into.
double widest_part(std::string_view name, double size_px) {
  double widest = 0.0;
  for (std::size_t at = 0; at < name.size();) {
    const std::size_t join = name.find_first_of(kJoins, at);
    const std::size_t end = join == std::string_view::npos ? name.size() : join + 1;
    widest = std::max(widest, width_of(name.substr(at, end - at), size_px));
    at = end;
  }
  return widest;
}

PaperColumn measured(const CsvTable& table, std::size_t index, std::size_t rows, double size_px) {
  const std::string& name = table.header[index];
  double widest = widest_part(name, size_px);
  for (std::size_t r = 0; r < rows; ++r) {
    widest = std::max(widest, width_of(report_cell(name, table.records[r].fields[index]).text, size_px));
  }
  return {index, std::min(widest, kWidestText * size_px) + kGap_px};
}

}  // namespace

std::vector<std::string> text_lines(std::string_view text, double width_px, double size_px) {
  const std::string clean = clean_utf8(text);
  std::vector<std::string> lines;
  for (std::size_t at = 0; at <= clean.size();) {
    const std::size_t end = std::min(clean.find('\n', at), clean.size());
    const auto parts = wrapped(clean.substr(at, end - at), width_px, size_px);
    if (parts.empty()) lines.emplace_back();
    for (const std::string& part : parts) add_line(lines, part, width_px, size_px);
    at = end + 1;
  }
  return lines;
}

std::vector<std::vector<PaperColumn>> column_blocks(const CsvTable& table, std::size_t rows, double width_px,
                                                    double size_px) {
  std::vector<PaperColumn> keys;
  std::vector<PaperColumn> others;
  for (const std::size_t index : columns_with_values(table)) {
    const bool key = std::ranges::find(kKeys, table.header[index]) != kKeys.end();
    (key ? keys : others).push_back(measured(table, index, rows, size_px));
  }
  if (keys.empty() && !others.empty()) {
    keys.push_back(others.front());
    others.erase(others.begin());
  }
  if (keys.empty()) return {};
  double keys_px = 0.0;
  for (const PaperColumn& key : keys) keys_px += key.width_px;
  std::vector<std::vector<PaperColumn>> blocks{keys};
  double used = keys_px;
  for (const PaperColumn& column : others) {
    if (used + column.width_px > width_px && blocks.back().size() > keys.size()) {
      blocks.push_back(keys);
      used = keys_px;
    }
    blocks.back().push_back(column);
    used += column.width_px;
  }
  return blocks;
}

}  // namespace sonar
