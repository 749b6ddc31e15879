// SPDX-License-Identifier: Apache-2.0
#include "pipeline/biomass/ts_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "io/csv.h"

namespace sonar {
namespace {

/// A line as it stands; NaN = an empty field.
struct TsLine {
  TsRelation relation;
  std::string aspect;
  std::string recalled;
};

template <class Visitor>
void columns(Visitor& v, TsLine& r) {
  FishDirectivity& fish = r.relation.directivity;
  v("name", "", r.relation.name);
  v("species", "", r.relation.species);
  v("frequency_from_khz", "kHz", r.relation.frequency_from_khz);
  v("frequency_to_khz", "kHz", r.relation.frequency_to_khz);
  v("aspect", "", r.aspect);
  v("m_db", "dB", r.relation.m_db);
  v("b_db", "dB", r.relation.b_db);
  v("d_db", "dB", r.relation.d_db);
  v("line_share", "1", fish.line_share);
  v("any_aspect_share", "1", fish.any_aspect_share);
  v("heading_sd_deg", "degrees", fish.heading_sd_deg);
  v("tilt_sd_deg", "degrees", fish.tilt_sd_deg);
  v("recalled", "", r.recalled);
  v("source", "", r.relation.source);
}

/// What is wrong with a line's figures; empty where nothing is.
std::string problem_of(const TsLine& line) {
  const TsRelation& r = line.relation;
  const auto within = [](double value, double least, double most) { return value >= least && value <= most; };
  if (r.name.empty()) return "the relation has no name";
  if (r.species.empty()) return "the relation has no species";
  if (!within(r.frequency_from_khz, 1.0, 1000.0) || !within(r.frequency_to_khz, r.frequency_from_khz, 1000.0)) {
    return "expected frequency_from_khz and frequency_to_khz, 1 to 1000, the lower one first";
  }
  if (std::find(kTsAspectNames.begin(), kTsAspectNames.end(), line.aspect) == kTsAspectNames.end()) {
    return fmt::format("aspect '{}'; expected dorsal or side", line.aspect.substr(0, 40));
  }
  if (!within(r.m_db, -100.0, 100.0) || !within(r.b_db, -200.0, 0.0) || !within(r.d_db, -100.0, 100.0)) {
    return "expected m_db and d_db from -100 to 100, and b_db from -200 to 0";
  }
  if (line.recalled != "yes" && line.recalled != "no") {
    return fmt::format("recalled '{}'; expected yes or no", line.recalled.substr(0, 40));
  }
  if (r.source.empty()) return "the relation has no source";
  const FishDirectivity& fish = r.directivity;
  if (!fish.known()) return {};
  if (!within(fish.line_share, 0.001, 1.0) || !within(fish.any_aspect_share, 0.0, 1.0)) {
    return "expected line_share from 0.001 to 1 (or empty), and with it any_aspect_share from 0 to 1";
  }
  if (!within(fish.heading_sd_deg, 0.0, 180.0) || !within(fish.tilt_sd_deg, 0.0, 90.0)) {
    return "expected with a line_share heading_sd_deg from 0 to 180 and tilt_sd_deg from 0 to 90";
  }
  return {};
}

Result<TsRelation> relation_of(const CsvTable& table, const CsvRecord& record) {
  TsLine line;
  CsvRowReader reader(table, record);
  columns(reader, line);
  if (!reader.status()) return pass_on(reader.status());
  if (std::isnan(line.relation.d_db)) line.relation.d_db = 0.0;
  if (const std::string problem = problem_of(line); !problem.empty()) {
    return fail(ErrorCode::format, fmt::format("line {}: {}", record.line, problem), {.file = table.file});
  }
  line.relation.aspect = static_cast<TsAspect>(std::find(kTsAspectNames.begin(), kTsAspectNames.end(), line.aspect) -
                                               kTsAspectNames.begin());
  line.relation.recalled = line.recalled == "yes";
  return std::move(line.relation);
}

bool overlaps(const TsRelation& relation, double from_khz, double to_khz) {
  return relation.frequency_from_khz <= to_khz && relation.frequency_to_khz >= from_khz;
}

}  // namespace

Result<std::vector<TsRelation>> ts_relations_of(const CsvTable& table) {
  std::vector<TsRelation> relations;
  for (const CsvRecord& record : table.records) {
    auto relation = relation_of(table, record);
    if (!relation) return pass_on(relation);
    const bool twice = std::any_of(relations.begin(), relations.end(),
                                   [&](const TsRelation& other) { return other.name == relation->name; });
    if (twice) {
      return fail(ErrorCode::format, fmt::format("line {}: the name '{}' stands twice", record.line, relation->name),
                  {.file = table.file});
    }
    relations.push_back(std::move(*relation));
  }
  if (relations.empty()) {
    return fail(ErrorCode::format, "expected a line for each relation, found none", {.file = table.file});
  }
  return relations;
}

Result<std::vector<TsRelation>> read_ts_table(const std::filesystem::path& path) {
  const auto table = path.empty() ? parse_csv(ts_presets_csv(), "the program's TS table") : read_csv(path);
  if (!table) return pass_on(table);
  return ts_relations_of(*table);
}

Result<TsRelation> ts_relation_named(std::span<const TsRelation> table, const std::string& name) {
  std::string names;
  for (const TsRelation& relation : table) {
    if (relation.name == name) return relation;
    names += (names.empty() ? "" : ", ") + relation.name;
  }
  return fail(ErrorCode::not_found, fmt::format("no TS relation is named '{}'; there are {}", name, names));
}

std::vector<TsRelation> ts_choices(std::span<const TsRelation> table, const TsRelation& chosen, double from_khz,
                                   double to_khz) {
  std::vector<TsRelation> of_species;
  std::vector<TsRelation> fitting;
  for (const TsRelation& relation : table) {
    if (relation.species != chosen.species) continue;
    of_species.push_back(relation);
    if (relation.name == chosen.name || overlaps(relation, from_khz, to_khz)) fitting.push_back(relation);
  }
  return fitting.size() < 2 ? of_species : fitting;
}

std::string ts_text(const TsRelation& r) {
  std::string text = fmt::format("{}: {}, TS = {:g} log10 L {} {:g}", r.name, r.species, r.m_db,
                                 r.b_db < 0.0 ? '-' : '+', std::abs(r.b_db));
  if (r.d_db != 0.0) {
    text += fmt::format(" {} {:g} log10(1 + z/10)", r.d_db < 0.0 ? '-' : '+', std::abs(r.d_db));
  }
  text += r.frequency_from_khz == r.frequency_to_khz
              ? fmt::format(" dB, {:g} kHz", r.frequency_from_khz)
              : fmt::format(" dB, {:g} to {:g} kHz", r.frequency_from_khz, r.frequency_to_khz);
  text += fmt::format(", {}", name(r.aspect));
  if (r.directivity.known()) {
    text += fmt::format(" broadside, falling off with the angle as a line of {:g} of the length does",
                        r.directivity.line_share);
  }
  return text + fmt::format("; {}{}", r.source, r.recalled ? " (recalled: check it)" : "");
}

}  // namespace sonar
