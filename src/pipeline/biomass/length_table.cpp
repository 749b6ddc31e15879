// SPDX-License-Identifier: Apache-2.0
#include "pipeline/biomass/length_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace sonar {
namespace {

constexpr double kMostAmount = 1e9;  ///< of a line; the sum of all is a number

tl::unexpected<Error> refused(const CsvTable& table, std::int64_t line, const std::string& what) {
  return fail(ErrorCode::format, fmt::format("line {}: {}", line, what), {.file = table.file});
}

}  // namespace

Result<FishLengths> fish_lengths_of(const CsvTable& table) {
  const auto length = table.require_column("length_cm");
  if (!length) return pass_on(length);
  const auto count = table.column("count");
  const auto fraction = table.column("fraction");
  if (table.header.size() != 2 || count.has_value() == fraction.has_value()) {
    return refused(table, 1, "expected the columns length_cm,count or length_cm,fraction");
  }
  FishLengths lengths;
  double sum = 0.0;
  for (const CsvRecord& record : table.records) {
    const auto cm = table.number(record, *length);
    if (!cm) return pass_on(cm);
    const auto amount = table.number(record, count ? *count : *fraction);
    if (!amount) return pass_on(amount);
    if (!(*cm > 0.0 && *cm <= 1000.0)) return refused(table, record.line, "expected a length above 0 cm, up to 1000");
    if (!(*amount >= 0.0 && *amount <= kMostAmount) || (count && *amount != std::floor(*amount))) {
      return refused(table, record.line,
                     count ? "expected a whole number of fish in count, from 0 to 1e9"
                           : "expected a share in fraction, from 0 to 1e9");
    }
    const bool twice = std::any_of(lengths.classes.begin(), lengths.classes.end(),
                                   [&](const LengthClass& other) { return other.length_cm == *cm; });
    if (twice) return refused(table, record.line, fmt::format("the length {:g} cm stands twice", *cm));
    lengths.classes.push_back({*cm, *amount});
    sum += *amount;
  }
  if (!(sum > 0.0)) return fail(ErrorCode::format, "tells of no fish", {.file = table.file});
  for (LengthClass& of : lengths.classes) of.share /= sum;
  if (count) lengths.measured = sum;
  return lengths;
}

Result<FishLengths> read_fish_lengths(const std::filesystem::path& path) {
  const auto table = read_csv(path);
  if (!table) return pass_on(table);
  return fish_lengths_of(*table);
}

Result<std::map<std::string, double>> stratum_areas_of(const CsvTable& table) {
  const auto stratum = table.require_column("stratum");
  if (!stratum) return pass_on(stratum);
  const auto area = table.require_column("area_nmi2");
  if (!area) return pass_on(area);
  std::map<std::string, double> areas;
  for (const CsvRecord& record : table.records) {
    const auto nmi2 = table.number(record, *area);
    if (!nmi2) return pass_on(nmi2);
    if (!(*nmi2 > 0.0)) return refused(table, record.line, "expected an area above 0 nmi2");
    const std::string& name = record.fields[*stratum];
    if (!areas.emplace(name, *nmi2).second) {
      return refused(table, record.line, fmt::format("the stratum '{}' stands twice", name.substr(0, 40)));
    }
  }
  return areas;
}

Result<std::map<std::string, double>> read_stratum_areas(const std::filesystem::path& path) {
  const auto table = read_csv(path);
  if (!table) return pass_on(table);
  return stratum_areas_of(*table);
}

}  // namespace sonar
