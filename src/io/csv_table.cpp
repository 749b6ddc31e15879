// SPDX-License-Identifier: Apache-2.0
#include "io/csv_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <utility>

#include "io/atomic_file.h"

namespace sonar {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

/// Reads records one after the other and counts lines.
class Reader {
 public:
  Reader(std::string_view text, const std::string& file) : text_(text), file_(file) {
    if (text_.starts_with(kByteOrderMark)) text_.remove_prefix(kByteOrderMark.size());
  }

  [[nodiscard]] bool at_end() const { return at_ >= text_.size(); }

  /// An empty line gives a record with one empty field.
  Result<CsvRecord> next() {
    CsvRecord record;
    record.line = line_;
    for (;;) {
      std::string field;
      if (auto read = peek() == '"' ? quoted(field, record.line) : plain(field); !read) return pass_on(read);
      record.fields.push_back(std::move(field));
      if (peek() != ',') break;
      ++at_;
    }
    if (peek() == '\r') ++at_;
    if (!at_end()) {
      ++at_;
      ++line_;
    }
    return record;
  }

 private:
  [[nodiscard]] char peek(std::size_t ahead = 0) const {
    return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\n';
  }
  [[nodiscard]] bool at_line_end() const { return peek() == '\n' || (peek() == '\r' && peek(1) == '\n'); }

  Result<void> plain(std::string& field) {
    while (!at_end() && peek() != ',' && !at_line_end()) field += text_[at_++];
    return {};
  }

  Result<void> quoted(std::string& field, std::int64_t first_line) {
    ++at_;
    for (;;) {
      if (at_end()) {
        return fail(ErrorCode::format, fmt::format("line {}: a quote is never closed", first_line), {.file = file_});
      }
      const char c = text_[at_++];
      if (c == '"' && (at_end() || text_[at_] != '"')) break;
      if (c == '"') ++at_;
      if (c == '\n') ++line_;
      field += c;
    }
    if (at_end() || peek() == ',' || at_line_end()) return {};
    return fail(ErrorCode::format, fmt::format("line {}: text after a closing quote", line_), {.file = file_});
  }

  std::string_view text_;
  const std::string& file_;
  std::size_t at_ = 0;
  std::int64_t line_ = 1;
};

bool is_blank(const CsvRecord& record) { return record.fields.size() == 1 && record.fields.front().empty(); }

tl::unexpected<Error> bad_field(const CsvTable& table, const CsvRecord& record, std::size_t column,
                                std::string_view wanted) {
  return fail(ErrorCode::format,
              fmt::format("line {}: column '{}' holds '{}'; {} was expected", record.line, table.header[column],
                          record.fields[column].substr(0, 40), wanted),
              {.file = table.file});
}

}  // namespace

std::string csv_field(std::string_view text) {
  // Unquoted, a byte order mark at a file's beginning would be skipped.
  const bool plain = text.find_first_of(",\"\r\n") == std::string_view::npos && !text.starts_with(kByteOrderMark);
  if (plain) return std::string(text);
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

std::optional<std::size_t> CsvTable::column(std::string_view name) const {
  const auto found = std::find(header.begin(), header.end(), name);
  if (found == header.end()) return std::nullopt;
  return static_cast<std::size_t>(found - header.begin());
}

Result<std::size_t> CsvTable::require_column(std::string_view name) const {
  if (const auto found = column(name)) return *found;
  return fail(ErrorCode::format, fmt::format("line 1: there is no column '{}'", name), {.file = file});
}

Result<double> CsvTable::number(const CsvRecord& record, std::size_t column) const {
  const std::string& text = record.fields[column];
  if (text.empty()) return std::numeric_limits<double>::quiet_NaN();
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  // "inf" and "nan" are numbers to from_chars; what is unknown stands as an empty field.
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) {
    return bad_field(*this, record, column, "a number");
  }
  return value;
}

Result<std::int64_t> CsvTable::whole(const CsvRecord& record, std::size_t column) const {
  const std::string& text = record.fields[column];
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || text.empty()) {
    return bad_field(*this, record, column, "a whole number");
  }
  return value;
}

Result<CsvTable> parse_csv(std::string_view text, std::string file) {
  CsvTable table;
  table.file = std::move(file);
  Reader reader(text, table.file);
  while (!reader.at_end()) {
    auto record = reader.next();
    if (!record) return pass_on(record);
    if (is_blank(*record) && (table.header.empty() || table.header.size() > 1)) continue;
    if (table.header.empty()) {
      table.header = std::move(record->fields);
      continue;
    }
    if (record->fields.size() != table.header.size()) {
      return fail(ErrorCode::format,
                  fmt::format("line {}: {} fields; the header has {}", record->line, record->fields.size(),
                              table.header.size()),
                  {.file = table.file});
    }
    table.records.push_back(std::move(*record));
  }
  if (table.header.empty()) return fail(ErrorCode::format, "has no header row", {.file = table.file});
  std::vector<std::string> names = table.header;
  std::sort(names.begin(), names.end());
  if (const auto twice = std::adjacent_find(names.begin(), names.end()); twice != names.end()) {
    return fail(ErrorCode::format, fmt::format("line 1: column '{}' stands twice", *twice), {.file = table.file});
  }
  return table;
}

Result<CsvTable> read_csv(const std::filesystem::path& path) {
  const auto text = read_file(path);
  if (!text) return pass_on(text);
  return parse_csv(*text, path.string());
}

}  // namespace sonar
