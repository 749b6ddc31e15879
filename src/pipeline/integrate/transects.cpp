// SPDX-License-Identifier: Apache-2.0
#include "pipeline/integrate/transects.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include "io/csv.h"

namespace sonar {
namespace {

constexpr std::array<std::string_view, 5> kColumns{"name", "stratum", "type", "start_utc", "stop_utc"};

/// A line as it stands.
struct TransectLine {
  std::string name;
  std::string stratum;
  std::string type;
  TimeNs start_utc = 0;
  TimeNs stop_utc = 0;
};

template <class Visitor>
void columns(Visitor& v, TransectLine& r) {
  v(kColumns[0], "", r.name);
  v(kColumns[1], "", r.stratum);
  v(kColumns[2], "", r.type);
  v(kColumns[3], "", TimeColumn{r.start_utc});
  v(kColumns[4], "", TimeColumn{r.stop_utc});
}

/// A transect and the line that tells it.
struct Told {
  Transect transect;
  std::int64_t line = 0;
};

tl::unexpected<Error> refused(const CsvTable& table, std::int64_t line, const std::string& what) {
  return fail(ErrorCode::format, fmt::format("line {}: {}", line, what), {.file = table.file});
}

Result<Told> told_by(const CsvTable& table, const CsvRecord& record) {
  TransectLine line;
  CsvRowReader reader(table, record);
  columns(reader, line);
  if (!reader.status()) return pass_on(reader.status());
  const auto type = std::find(kEffortTypeNames.begin(), kEffortTypeNames.end(), line.type);
  if (type == kEffortTypeNames.end()) {
    return refused(table, record.line, fmt::format("type '{}'; expected transect or off", line.type.substr(0, 40)));
  }
  const auto which = static_cast<EffortType>(type - kEffortTypeNames.begin());
  if (which == EffortType::transect && line.name.empty())
    return refused(table, record.line, "the transect has no name");
  if (line.start_utc == 0 || line.stop_utc == 0) {
    return refused(table, record.line, "start_utc and stop_utc: expected a time like 2026-11-21T19:57:26Z in each");
  }
  if (line.stop_utc < line.start_utc) return refused(table, record.line, "stop_utc lies before start_utc");
  return Told{{line.name, line.stratum, which, line.start_utc, line.stop_utc}, record.line};
}

Result<void> require_one_at_a_time(const CsvTable& table, const std::vector<Told>& told) {
  const Told* before = nullptr;
  for (const Told& one : told) {
    if (one.transect.type != EffortType::transect) continue;
    if (before != nullptr && one.transect.start_utc < before->transect.stop_utc) {
      return refused(table, one.line,
                     fmt::format("transect '{}' begins before '{}' of line {} ends; a ping belongs to one transect",
                                 one.transect.name, before->transect.name, before->line));
    }
    const auto same = std::find_if(told.begin(), told.end(), [&](const Told& other) {
      return &other != &one && other.transect.type == EffortType::transect && other.transect.name == one.transect.name;
    });
    if (same != told.end()) {
      return refused(
          table, std::max(one.line, same->line),
          fmt::format("transect '{}' stands in line {} too; interruptions of a transect are lines of type off",
                      one.transect.name, std::min(one.line, same->line)));
    }
    before = &one;
  }
  return {};
}

}  // namespace

Result<std::vector<Transect>> transects_of(const CsvTable& table) {
  for (const std::string& name : table.header) {
    if (std::find(kColumns.begin(), kColumns.end(), name) != kColumns.end()) continue;
    return refused(table, 1,
                   fmt::format("column '{}' is none of name, stratum, type, start_utc, stop_utc", name.substr(0, 40)));
  }
  for (const std::string_view needed : kColumns) {
    if (auto there = table.require_column(needed); !there) return pass_on(there);
  }
  std::vector<Told> told;
  for (const CsvRecord& record : table.records) {
    auto one = told_by(table, record);
    if (!one) return pass_on(one);
    told.push_back(std::move(*one));
  }
  std::stable_sort(told.begin(), told.end(), [](const Told& a, const Told& b) {
    return std::tie(a.transect.start_utc, a.transect.stop_utc) < std::tie(b.transect.start_utc, b.transect.stop_utc);
  });
  if (auto single = require_one_at_a_time(table, told); !single) return pass_on(single);
  std::vector<Transect> transects;
  for (Told& one : told) transects.push_back(std::move(one.transect));
  if (transects.empty()) return fail(ErrorCode::format, "expected a line for each transect, found none", {table.file});
  return transects;
}

Result<std::vector<Transect>> read_transects(const std::filesystem::path& path) {
  const auto table = read_csv(path);
  if (!table) return pass_on(table);
  return transects_of(*table);
}

}  // namespace sonar
