// SPDX-License-Identifier: Apache-2.0
#include "pipeline/exports/avoidance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <string_view>
#include <utility>

#include "base/units.h"
#include "model/school_totals.h"

namespace sonar {
namespace {

constexpr double kWake_m = 25.0;  ///< half of a ship's wake in breadth, and its depth

struct Axis {
  std::string_view name;
  double SchoolPingRow::*column;
  double bin;
};
constexpr std::array<Axis, 3> kAxes{{{"range_m", &SchoolPingRow::range_m, 50.0},
                                     {"relative_bearing_deg", &SchoolPingRow::relative_bearing_deg, 30.0},
                                     {"time_to_cpa_s", &SchoolPingRow::time_to_cpa_s, 30.0}}};

struct Figure {
  double SchoolPingRow::*column;
  double AvoidanceRow::*mean;
  double AvoidanceRow::*error;
  std::array<double AvoidanceRow::*, 3> quartiles;
  bool decibels = false;
};
using P = SchoolPingRow;
using A = AvoidanceRow;
constexpr std::array<Figure, 7> kFigures{{
    {&P::speed_smoothed_mps,
     &A::speed_smoothed_mps,
     &A::speed_smoothed_se_mps,
     {&A::speed_smoothed_p25_mps, &A::speed_smoothed_p50_mps, &A::speed_smoothed_p75_mps}},
    {&P::speed_away_mps,
     &A::speed_away_mps,
     &A::speed_away_se_mps,
     {&A::speed_away_p25_mps, &A::speed_away_p50_mps, &A::speed_away_p75_mps}},
    {&P::speed_away_water_mps,
     &A::speed_away_water_mps,
     &A::speed_away_water_se_mps,
     {&A::speed_away_water_p25_mps, &A::speed_away_water_p50_mps, &A::speed_away_water_p75_mps}},
    {&P::course_away_deg,
     &A::course_away_deg,
     &A::course_away_se_deg,
     {&A::course_away_p25_deg, &A::course_away_p50_deg, &A::course_away_p75_deg}},
    {&P::depth_m, &A::depth_m, &A::depth_se_m, {&A::depth_p25_m, &A::depth_p50_m, &A::depth_p75_m}},
    {&P::vertical_speed_smoothed_mps,
     &A::vertical_speed_smoothed_mps,
     &A::vertical_speed_smoothed_se_mps,
     {&A::vertical_speed_smoothed_p25_mps, &A::vertical_speed_smoothed_p50_mps, &A::vertical_speed_smoothed_p75_mps}},
    {&P::sv_mean_db,
     &A::sv_mean_db,
     &A::sv_mean_se_db,
     {&A::sv_mean_p25_db, &A::sv_mean_p50_db, &A::sv_mean_p75_db},
     true},
}};

struct Mean {
  double sum = 0.0;
  double count = 0.0;
  void add(double value) {
    if (!std::isfinite(value)) return;
    sum += value;
    count += 1.0;
  }
  [[nodiscard]] double value() const { return count > 0.0 ? sum / count : kUnknown; }
};

/// What one school did in one bin.
struct OfSchool {
  std::int64_t pings = 0;
  std::array<Mean, kFigures.size()> figures;
};
/// By number of the school.
using Bin = std::map<std::size_t, OfSchool>;

/// By observation and number in it.
using Schools = std::map<std::pair<std::string_view, std::int64_t>, std::size_t>;

Schools schools_of(std::span<const CountedSchool> counted) {
  Schools out;
  for (std::size_t i = 0; i < counted.size(); ++i) {
    for (const SchoolRow* row : counted[i].rows) out[{row->observation, row->school_id}] = i;
  }
  return out;
}

bool may_be_wake(const SchoolPingRow& row) { return row.wake_distance_m < kWake_m && row.depth_min_m < kWake_m; }

void add(const SchoolPingRow& row, OfSchool& to) {
  ++to.pings;
  for (std::size_t k = 0; k < kFigures.size(); ++k) {
    const double value = row.*kFigures[k].column;
    to.figures[k].add(kFigures[k].decibels ? linear_from_db(value) : value);
  }
}

/// Mean over schools and its standard error, from what each of them has.
void take_figure(const Bin& bin, std::size_t k, AvoidanceRow& out) {
  Mean mean;
  for (const auto& [number, school] : bin) mean.add(school.figures[k].value());
  Mean square;
  for (const auto& [number, school] : bin) {
    const double off = school.figures[k].value() - mean.value();
    square.add(off * off);
  }
  const double error = mean.count > 1.0 ? std::sqrt(square.sum / (mean.count - 1.0) / mean.count) : kUnknown;
  const Figure& figure = kFigures[k];
  out.*figure.mean = figure.decibels && mean.value() > 0.0 ? db_from_linear(mean.value()) : mean.value();
  // Of a few tenths of the value, the error in dB is that of first order.
  out.*figure.error = figure.decibels ? 10.0 / std::log(10.0) * error / mean.value() : error;
}

/// Of what the schools have, in between where a share falls between two of them: the usual rule of statistics programs
/// (type 7 of Hyndman and Fan 1996).
void take_quartiles(const Bin& bin, std::size_t k, AvoidanceRow& out) {
  const Figure& figure = kFigures[k];
  std::vector<double> values;
  for (const auto& [number, school] : bin) {
    const double value = school.figures[k].value();
    const double told = figure.decibels ? db_from_linear(value) : value;
    if (std::isfinite(told)) values.push_back(told);
  }
  if (values.empty()) return;
  std::sort(values.begin(), values.end());
  for (std::size_t i = 0; i < figure.quartiles.size(); ++i) {
    const double at = 0.25 * static_cast<double>(i + 1) * static_cast<double>(values.size() - 1);
    const auto below = static_cast<std::size_t>(at);
    const std::size_t above = std::min(below + 1, values.size() - 1);
    out.*figure.quartiles[i] = std::lerp(values[below], values[above], at - static_cast<double>(below));
  }
}

AvoidanceRow row_of(const Axis& axis, std::int64_t number, const Bin& bin) {
  AvoidanceRow out;
  out.against = axis.name;
  out.from = static_cast<double>(number) * axis.bin;
  out.to = out.from + axis.bin;
  out.n_schools = static_cast<std::int64_t>(bin.size());
  for (const auto& [school, found] : bin) out.n_pings += found.pings;
  for (std::size_t k = 0; k < kFigures.size(); ++k) {
    take_figure(bin, k, out);
    take_quartiles(bin, k, out);
  }
  return out;
}

}  // namespace

std::vector<AvoidanceRow> avoidance_table(std::span<const ObservationProduct> products) {
  const std::vector<CountedSchool> counted = counted_schools(products);
  const Schools schools = schools_of(counted);
  std::vector<AvoidanceRow> out;
  for (const Axis& axis : kAxes) {
    std::map<std::int64_t, Bin> bins;
    for (const ObservationProduct& product : products) {
      for (const SchoolPingRow& row : product.school_pings) {
        const double at = row.*axis.column;
        const auto school = schools.find({row.observation, row.school_id});
        if (school == schools.end() || !std::isfinite(at) || may_be_wake(row)) continue;
        add(row, bins[static_cast<std::int64_t>(std::floor(at / axis.bin))][school->second]);
      }
    }
    for (const auto& [number, bin] : bins) out.push_back(row_of(axis, number, bin));
  }
  return out;
}

}  // namespace sonar
