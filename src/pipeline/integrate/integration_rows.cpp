// SPDX-License-Identifier: Apache-2.0
#include "pipeline/integrate/integration_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <string>
#include <utility>

#include "base/units.h"
#include "school/integrate/stratified_mean.h"

namespace sonar {
namespace {

/// NASC of an s_a: MacLennan, Fernandes & Dalen 2002.
constexpr double kNascOfSa = 4.0 * std::numbers::pi * kMetresPerNauticalMile * kMetresPerNauticalMile;
constexpr double kLimitErrors = 3.0;  ///< standard errors of noise alone that a mean must stand out by (IUPAC's limit)
constexpr double kDbOfRelative = 10.0 / std::numbers::ln10;

double db_or_unknown(double linear) { return linear > 0.0 ? db_from_linear(linear) : kUnknown; }

double ratio(double a, double b) { return b > 0.0 ? a / b : kUnknown; }

/// What of some echo was given back for extinction, added to a row.
template <class Row>
void add_extinction(double nasc_of_echo, const CellSums& cell, Row& row) {
  const auto add = [nasc_of_echo](double& nasc, double echo_m2) {
    nasc = (std::isnan(nasc) ? 0.0 : nasc) + nasc_of_echo * echo_m2;
  };
  add(row.nasc_extinction_m2_nmi2, cell.extinction_m2);
  add(row.nasc_extinction_low_m2_nmi2, cell.extinction_low_m2);
  add(row.nasc_extinction_high_m2_nmi2, cell.extinction_high_m2);
}

NascRow nasc_row(const EffortUnit& unit, const UnitSums& sums, const CellLayout& layout, const CellKey& key,
                 const CellSums& cell) {
  NascRow row;
  row.stratum = unit.stratum;
  row.transect = unit.transect;
  row.edsu = unit.edsu;
  row.range_from_m = key.first * layout.range_bin_m;
  row.range_to_m = std::min((key.first + 1) * layout.range_bin_m, layout.max_range_m);
  row.depth_from_m = layout.depth_m(key.second);
  row.depth_to_m = layout.depth_m(key.second + 1);
  row.volume_m3 = cell.heard_m3;
  row.valid_fraction = ratio(cell.heard_m3, cell.water_m3);
  row.height_m = ratio(cell.water_m3, sums.area_m2.at(key.first));
  if (!(cell.heard_m3 > 0.0)) return row;
  const double sv = cell.echo_m2 / cell.heard_m3;
  const double nasc_of_echo = kNascOfSa * row.height_m / cell.heard_m3;  // of each m^2 of echo
  row.beam_filling = cell.beam_m3 / cell.heard_m3;
  row.snr_db = cell.noise_m2 > 0.0 ? db_or_unknown(cell.echo_m2 / cell.noise_m2) : kUnknown;
  row.noise_sv_db = db_or_unknown(cell.noise_m2 / cell.heard_m3);
  row.sv_limit_db = db_or_unknown(kLimitErrors * std::sqrt(cell.noise_m4) / cell.heard_m3);
  row.sv_mean_db = db_or_unknown(sv);
  row.sv_se_db = sv > 0.0 ? kDbOfRelative * std::sqrt(cell.variance_m4) / cell.echo_m2 : kUnknown;
  row.sv_layer_db = db_or_unknown(sv / row.beam_filling);
  row.sa_m2_m2 = sv * row.height_m;
  row.nasc_m2_nmi2 = nasc_of_echo * cell.echo_m2;
  row.nasc_se_m2_nmi2 = nasc_of_echo * std::sqrt(cell.variance_m4);
  row.nasc_layer_m2_nmi2 = row.nasc_m2_nmi2 / row.beam_filling;
  if (!sums.schools_known) return row;
  row.filled_fraction = cell.school_m3 / cell.heard_m3;
  row.sv_school_db = db_or_unknown(ratio(cell.school_m2, cell.school_m3));
  row.sv_rest_db = db_or_unknown(ratio(cell.echo_m2 - cell.school_m2, cell.heard_m3 - cell.school_m3));
  row.nasc_school_m2_nmi2 = nasc_of_echo * cell.school_m2;
  row.nasc_school_se_m2_nmi2 = nasc_of_echo * std::sqrt(cell.school_m4);
  row.nasc_rest_m2_nmi2 = row.nasc_m2_nmi2 - row.nasc_school_m2_nmi2;
  if (sums.extinction_corrected) add_extinction(nasc_of_echo, cell, row);
  return row;
}

/// A depth channel over all range bins of a unit.
struct Channel {
  CellSums sums;
  double height_m = 0.0;  ///< of it that the sector reaches, at the range where it reaches most
};

std::map<int, Channel> channels_of(const UnitSums& sums) {
  std::map<int, Channel> channels;
  for (const auto& [key, cell] : sums.cells) {
    if (!(cell.heard_m3 > 0.0)) continue;
    Channel& channel = channels[key.second];
    channel.sums += cell;
    channel.height_m = std::max(channel.height_m, cell.water_m3 / sums.area_m2.at(key.first));
  }
  return channels;
}

/// NASC of a unit: its channels' mean s_v over all ranges times their heights. That of one layer which all fish are in has
/// the mean s_v sum s_v V / sum F V, where F is the share of the beam in the layer; channels corrected so do not add up.
void add_column(const UnitSums& sums, const CellLayout& layout, EffortRow& row) {
  const std::map<int, Channel> channels = channels_of(sums);
  if (channels.empty()) return;
  CellSums all;
  double nasc = 0.0;
  double school = 0.0;
  double variance = 0.0;
  double school_variance = 0.0;
  for (const auto& [channel, of] : channels) {
    const double nasc_of_echo = kNascOfSa * of.height_m / of.sums.heard_m3;
    nasc += nasc_of_echo * of.sums.echo_m2;
    school += nasc_of_echo * of.sums.school_m2;
    variance += nasc_of_echo * nasc_of_echo * of.sums.whole_m4;
    school_variance += nasc_of_echo * nasc_of_echo * of.sums.whole_school_m4;
    if (sums.schools_known && sums.extinction_corrected) add_extinction(nasc_of_echo, of.sums, row);
    all += of.sums;
  }
  row.volume_m3 = all.heard_m3;
  row.snr_db = all.noise_m2 > 0.0 ? db_or_unknown(all.echo_m2 / all.noise_m2) : kUnknown;
  row.nasc_m2_nmi2 = nasc;
  row.nasc_se_m2_nmi2 = std::sqrt(variance);
  if (layout.is_layer()) row.nasc_layer_m2_nmi2 = nasc * ratio(all.heard_m3, all.beam_m3);
  if (!sums.schools_known) return;
  row.filled_fraction = all.school_m3 / all.heard_m3;
  row.nasc_school_m2_nmi2 = school;
  row.nasc_school_se_m2_nmi2 = std::sqrt(school_variance);
  row.nasc_rest_m2_nmi2 = nasc - school;
}

EffortRow effort_row(const EffortUnit& unit, const UnitSums& sums, const CellLayout& layout) {
  EffortRow row;
  row.stratum = unit.stratum;
  row.transect = unit.transect;
  row.type = std::string(name(unit.type));
  row.edsu = unit.edsu;
  row.first_time_utc = unit.times.front();
  row.last_time_utc = unit.times.back();
  const Geographic& middle = unit.transducers[unit.transducers.size() / 2];
  row.latitude = middle.latitude_deg;
  row.longitude = middle.longitude_deg;
  if (unit.type == EffortType::transect) row.from_nmi = unit.from_m / kMetresPerNauticalMile;
  row.distance_nmi = unit.sailed_m / kMetresPerNauticalMile;
  row.n_pings = std::ssize(unit.times);
  row.n_pings_used = sums.pings;
  row.n_pings_without_position = std::count_if(unit.transducers.begin(), unit.transducers.end(),
                                               [](const Geographic& place) { return std::isnan(place.latitude_deg); });
  if (unit.type == EffortType::off) return row;
  if (sums.schools_known && sums.pings > 0) row.n_schools = static_cast<double>(sums.schools.size());
  add_column(sums, layout, row);
  return row;
}

/// A column that is averaged on the way up, weighted by distance.
struct AveragedColumn {
  double EffortRow::*of_unit;
  double StratumRow::*mean;
  double StratumRow::*se;  ///< null = none is told
};
constexpr std::array<AveragedColumn, 6> kAveraged{{
    {&EffortRow::nasc_m2_nmi2, &StratumRow::nasc_m2_nmi2, &StratumRow::nasc_se_m2_nmi2},
    {&EffortRow::nasc_school_m2_nmi2, &StratumRow::nasc_school_m2_nmi2, &StratumRow::nasc_school_se_m2_nmi2},
    {&EffortRow::nasc_layer_m2_nmi2, &StratumRow::nasc_layer_m2_nmi2, &StratumRow::nasc_layer_se_m2_nmi2},
    {&EffortRow::nasc_extinction_m2_nmi2, &StratumRow::nasc_extinction_m2_nmi2, nullptr},
    {&EffortRow::nasc_extinction_low_m2_nmi2, &StratumRow::nasc_extinction_low_m2_nmi2, nullptr},
    {&EffortRow::nasc_extinction_high_m2_nmi2, &StratumRow::nasc_extinction_high_m2_nmi2, nullptr},
}};

void put(StratumRow& row, const AveragedColumn& column, const MeanWithError& of) {
  row.*column.mean = of.mean;
  if (column.se != nullptr) row.*column.se = of.se;
}

/// A transect's mean over its EDSUs by their lengths. Neighbouring ones are alike, so they tell no error of it.
std::vector<StratumRow> transect_rows(std::span<const EffortRow> effort) {
  std::vector<std::vector<const EffortRow*>> units;
  std::vector<StratumRow> rows;
  for (const EffortRow& unit : effort) {
    if (unit.edsu == 0) continue;
    std::size_t at = 0;
    while (at < rows.size() && rows[at].transect != unit.transect) ++at;
    if (at == rows.size()) {
      rows.push_back({.level = "transect", .stratum = unit.stratum, .transect = unit.transect, .n_transects = 1});
      units.emplace_back();
    }
    ++rows[at].n_edsu;
    rows[at].distance_nmi += unit.distance_nmi;
    units[at].push_back(&unit);
  }
  for (std::size_t at = 0; at < rows.size(); ++at) {
    for (const AveragedColumn& column : kAveraged) {
      std::vector<WeightedValue> values;
      for (const EffortRow* unit : units[at]) values.push_back({unit->distance_nmi, unit->*column.of_unit});
      put(rows[at], column, {transect_mean(values).mean, kUnknown});
    }
  }
  return rows;
}

/// What rows on the level below add up to.
StratumRow row_over(const char* level, std::span<const StratumRow* const> parts) {
  StratumRow row;
  row.level = level;
  for (const StratumRow* part : parts) {
    row.n_transects += part->n_transects;
    row.n_edsu += part->n_edsu;
    row.distance_nmi += part->distance_nmi;
  }
  return row;
}

std::vector<StratumRow> stratum_rows(std::span<const StratumRow> transects) {
  std::map<std::string, std::vector<const StratumRow*>> strata;
  for (const StratumRow& transect : transects) strata[transect.stratum].push_back(&transect);
  std::vector<StratumRow> rows;
  for (const auto& [stratum, own] : strata) {
    StratumRow& row = rows.emplace_back(row_over("stratum", own));
    row.stratum = stratum;
    for (const AveragedColumn& column : kAveraged) {
      std::vector<WeightedValue> values;
      for (const StratumRow* transect : own) values.push_back({transect->distance_nmi, transect->*column.mean});
      put(row, column, transect_mean(values));
    }
  }
  return rows;
}

StratumRow survey_row(std::span<const StratumRow> strata) {
  std::vector<const StratumRow*> own;
  for (const StratumRow& stratum : strata) own.push_back(&stratum);
  StratumRow row = row_over("survey", own);
  for (const AveragedColumn& column : kAveraged) {
    std::vector<WeightedMean> values;
    for (const StratumRow& stratum : strata) {
      const double se = column.se != nullptr ? stratum.*column.se : kUnknown;
      values.push_back({stratum.distance_nmi, {stratum.*column.mean, se}});
    }
    put(row, column, stratified_mean(values));
  }
  return row;
}

}  // namespace

IntegrationTables integration_tables(std::span<const EffortUnit> units, std::span<const UnitSums> sums,
                                     const CellLayout& layout) {
  IntegrationTables tables;
  for (std::size_t i = 0; i < units.size(); ++i) {
    tables.effort.push_back(effort_row(units[i], sums[i], layout));
    if (units[i].type == EffortType::off) continue;
    for (const auto& [key, cell] : sums[i].cells) {
      tables.nasc.push_back(nasc_row(units[i], sums[i], layout, key, cell));
    }
  }
  tables.strata = transect_rows(tables.effort);
  const std::vector<StratumRow> strata = stratum_rows(tables.strata);
  tables.strata.insert(tables.strata.end(), strata.begin(), strata.end());
  if (!strata.empty()) tables.strata.push_back(survey_row(strata));
  return tables;
}

std::string extinction_text(const IntegrationTables& tables) {
  if (tables.strata.empty() || std::isnan(tables.strata.back().nasc_extinction_m2_nmi2)) return {};
  const StratumRow& survey = tables.strata.back();
  return fmt::format(
      "schools' extinction is corrected (measure.extinction.correct): {:.3g} m2 nmi-2 of the NASC was given back, "
      "{:.3g} to {:.3g} at the ends of the ratio's interval; see nasc_extinction_m2_nmi2",
      survey.nasc_extinction_m2_nmi2, survey.nasc_extinction_low_m2_nmi2, survey.nasc_extinction_high_m2_nmi2);
}

}  // namespace sonar
