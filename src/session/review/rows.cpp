// SPDX-License-Identifier: Apache-2.0
#include "session/review/rows.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <string_view>

#include "session/lists/cells.h"

namespace sonar {
namespace {

std::string plain(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\t' || c == '\n' || c == '\r'; }, ' ');
  return text;
}

std::string lower(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return out;
}

/// "Volume corrected" -> "volumecorrected", as a filter's word names it.
std::string column_word(std::string_view title) {
  std::string out = lower(title);
  std::erase(out, ' ');
  return out;
}

/// A word "depth>80" of a filter.
struct Comparison {
  std::string column;
  std::string_view how;
  double limit = 0.0;
};

std::optional<Comparison> comparison_of(const std::string& word) {
  constexpr std::array<std::string_view, 5> kHow{"<=", ">=", "<", ">", "="};
  for (const std::string_view how : kHow) {
    const auto at = word.find(how);
    if (at == std::string::npos || at == 0) continue;
    Comparison made{word.substr(0, at), how, 0.0};
    const char* begin = word.data() + at + how.size();
    const char* end = word.data() + word.size();
    const auto [after, problem] = std::from_chars(begin, end, made.limit);
    if (problem == std::errc() && after == end) return made;
  }
  return std::nullopt;
}

bool holds(double value, const Comparison& comparison) {
  if (comparison.how == "<") return value < comparison.limit;
  if (comparison.how == "<=") return value <= comparison.limit;
  if (comparison.how == ">") return value > comparison.limit;
  if (comparison.how == ">=") return value >= comparison.limit;
  return value == comparison.limit;
}

/// Empty where no column is meant.
std::optional<bool> compared(const Rows& rows, std::size_t row, const Comparison& comparison) {
  const auto& columns = rows.columns();
  for (std::size_t c = 0; c < columns.size(); ++c) {
    if (!column_word(columns[c].title).starts_with(comparison.column)) continue;
    const Cell cell = rows.cell(row, c);
    const auto* number = std::get_if<double>(&cell.key);
    return number != nullptr && holds(*number, comparison);
  }
  return std::nullopt;
}

bool word_matches(const Rows& rows, std::size_t row, const std::string& word) {
  if (const auto comparison = comparison_of(word)) {
    if (const auto is = compared(rows, row, *comparison)) return *is;
  }
  for (std::size_t c = 0; c < rows.columns().size(); ++c) {
    if (lower(rows.cell(row, c).text).find(word) != std::string::npos) return true;
  }
  return false;
}

}  // namespace

bool row_matches(const Rows& rows, std::size_t row, const std::string& filter) {
  const std::string words = lower(filter);
  for (std::size_t at = 0; at < words.size();) {
    const std::size_t end = std::min(words.find(' ', at), words.size());
    if (end > at && !word_matches(rows, row, words.substr(at, end - at))) return false;
    at = end + 1;
  }
  return true;
}

bool cell_less(const Cell& a, const Cell& b, bool descending) {
  const bool a_unknown = std::holds_alternative<std::monostate>(a.key);
  const bool b_unknown = std::holds_alternative<std::monostate>(b.key);
  // A widget turns the order round for a falling sort; unknown stays last all the same.
  if (a_unknown || b_unknown) return descending ? a_unknown && !b_unknown : b_unknown && !a_unknown;
  return a.key < b.key;
}

std::string tab_separated(const Rows& rows, const std::vector<std::size_t>& which) {
  std::string text;
  const auto& columns = rows.columns();
  const auto title = [&](std::size_t c, const char* of) {
    text += plain(columns[c].title + of + (columns[c].unit.empty() ? "" : " [" + columns[c].unit + "]"));
  };
  std::vector<bool> with_errors;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    with_errors.push_back(
        std::ranges::any_of(which, [&](std::size_t row) { return std::isfinite(rows.cell(row, c).se); }));
    text += c == 0 ? "" : "\t";
    title(c, "");
    if (!with_errors[c]) continue;
    text += '\t';
    title(c, " standard error");
  }
  text += '\n';
  for (const std::size_t row : which) {
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const Cell cell = rows.cell(row, c);
      const bool told = std::isfinite(cell.se);
      text += c == 0 ? "" : "\t";
      text += plain(told ? cell.brief : cell.text);
      if (with_errors[c]) text += "\t" + (told ? number_cell(cell.se, cell.decimals).text : std::string());
    }
    text += '\n';
  }
  return text;
}

}  // namespace sonar
