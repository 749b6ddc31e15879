// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace sonar {

/// A field as RFC 4180 wants it: in quotes where it holds a comma, a quote or a line break.
[[nodiscard]] std::string csv_field(std::string_view text);

/// One record of a CSV file.
struct CsvRecord {
  std::int64_t line = 0;            ///< 1-based line where the record starts
  std::vector<std::string> fields;  ///< as many as the header has
};

/// A table of text with one header row (RFC 4180; LF or CRLF, a UTF-8 byte order mark is skipped, empty lines too).
struct CsvTable {
  std::string file;  ///< for messages
  std::vector<std::string> header;
  std::vector<CsvRecord> records;

  [[nodiscard]] std::optional<std::size_t> column(std::string_view name) const;
  /// Column that must be there. errors: format, naming file and column
  [[nodiscard]] Result<std::size_t> require_column(std::string_view name) const;
  /// Number in a field; NaN where it is empty. errors: format, naming file, line, column (not finite too)
  [[nodiscard]] Result<double> number(const CsvRecord& record, std::size_t column) const;
  /// Whole number in a field. errors: format (empty too)
  [[nodiscard]] Result<std::int64_t> whole(const CsvRecord& record, std::size_t column) const;
};

/// errors  format: no header, a name twice, a record of another length than the header, an open quote
[[nodiscard]] Result<CsvTable> parse_csv(std::string_view text, std::string file);
/// errors  also not_found, io
[[nodiscard]] Result<CsvTable> read_csv(const std::filesystem::path& path);

}  // namespace sonar
