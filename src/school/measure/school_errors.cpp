// SPDX-License-Identifier: Apache-2.0
#include "school/measure/school_errors.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <string_view>
#include <utility>

#include "base/check.h"
#include "base/units.h"
#include "school/measure/fading_field.h"
#include "school/measure/measure.h"
#include "school/measure/repeat_ping.h"

namespace sonar {
namespace {

/// Collects the figures that have an error, by their columns' names.
struct FigureReader {
  FigureValues& out;
  void operator()(std::string_view, std::string_view, const auto&) const {}
  void operator()(std::string_view name, std::string_view, double& value) const {
    for (std::size_t i = 0; i < kErrorCount; ++i) {
      if (kErrorColumns[i].figure == name) out[i] = value;
    }
  }
};

/// Puts figures in their places, the reverse.
struct FigureWriter {
  const std::array<float, kErrorCount>& in;
  void operator()(std::string_view, std::string_view, const auto&) const {}
  void operator()(std::string_view name, std::string_view, double& value) const {
    for (std::size_t i = 0; i < kErrorCount; ++i) {
      if (kErrorColumns[i].figure == name) value = static_cast<double>(in[i]);
    }
  }
};

template <class Row>
FigureValues read_figures(Row row) {
  FigureValues out = unknown_figures();
  FigureReader reader{out};
  columns(reader, row);
  return out;
}

/// Which of a ping's repeats under n fadings goes into the school's: each as often, in another order for each ping.
std::size_t turned(std::size_t k, std::size_t ping, std::size_t n) {
  std::array<std::size_t, kFadings> order{};
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::uint64_t random = mixed(ping * kFadings + k / n);
  for (std::size_t i = n; i > 1; --i) {  // Fisher & Yates
    std::swap(order[i - 1], order[random % i]);
    random /= i;
  }
  return order[k % n];
}

/// The school's figures if all its pings were measured in other ways. which(ping) = index of its repeat
FigureValues repeated(std::span<const SchoolPingRow> rows, std::span<const Repeats* const> repeats, const auto& which,
                      const SummariseParams& summary) {
  std::vector<SchoolPingRow> others(rows.begin(), rows.end());
  for (std::size_t i = 0; i < others.size(); ++i) {
    FigureWriter writer{(*repeats[i])[which(i)]};
    columns(writer, others[i]);
    // summarise() takes the echo of pings that know a corrected volume, which a repeat does not change.
  }
  return figures_of(summarise(others, summary));
}

/// Their standard deviation, so much wider that 1.96 of it are the 95 % of Student's t for as many.
/// fadings  of a ping: where they are few, each comes up several times and the mean of a ping's hardly differs
double spread(const std::vector<double>& values, std::size_t fadings) {
  // 15 degrees of freedom; where repeats are put together of shared fadings they know as much as some 10 independent ones.
  const double student = (fadings == kFadings ? 2.1314 : 2.2622) / 1.95996;
  if (2 * values.size() < kFadings) return kUnknown;
  double mean = 0.0;
  for (const double v : values) mean += v / static_cast<double>(values.size());
  double square = 0.0;
  for (const double v : values) square += (v - mean) * (v - mean);
  const auto n = static_cast<double>(fadings);
  return student * std::sqrt(square / static_cast<double>(values.size()) * n / (n - 1.0));
}

bool is_level(std::string_view figure) { return figure.starts_with("sv_") && figure.ends_with("_db"); }
bool is_echo(std::string_view figure) { return figure == "backscatter_m2" || figure == "nasc_m2_nmi2"; }

/// Power of the sound speed that a figure goes with: lengths with the first, as the sector is similar to itself; sv too, by the
/// square of the range over the length of the pulse.
int power_of_sound_speed(const ErrorColumn& column) {
  if (column.figure == "backscatter_m2") return 4;  // sv over a volume
  if (column.figure == "nasc_m2_nmi2") return 2;    // sv over a height
  if (column.unit == "m") return 1;
  if (column.unit == "m2") return 2;
  return column.unit == "m3" ? 3 : 0;
}

/// Of so many repeats none may show what happens in one look of twenty.
bool is_count(std::string_view figure) { return figure.starts_with("n_") || figure == "vacuole_fraction"; }
bool is_depth(std::string_view figure) { return figure == "depth_m" || figure == "surface_distance_m"; }

/// By what is alike in all pings, threshold apart.
double common_error(const ErrorColumn& column, double figure, const SchoolRow& school, const ErrorParams& params) {
  const double calibration_db = std::isfinite(school.backscatter_calibration_se_db)
                                    ? school.backscatter_calibration_se_db
                                    : params.calibration_db;
  const double by_speed = params.sound_speed_percent / 100.0;
  double variance = std::pow(power_of_sound_speed(column) * figure * by_speed, 2);
  if (is_level(column.figure))
    variance += calibration_db * calibration_db + std::pow(db_from_linear(1.0 + by_speed), 2);
  if (is_echo(column.figure)) variance += std::pow(figure * (linear_from_db(calibration_db) - 1.0), 2);
  if (is_depth(column.figure)) variance += std::pow(school.horizontal_range_m * rad_from_deg(params.tilt_deg), 2);
  return std::sqrt(variance);
}

}  // namespace

FigureValues figures_of(const SchoolPingRow& row) { return read_figures(row); }
FigureValues figures_of(const SchoolRow& row) { return read_figures(row); }

Repeats measure_repeats(const MeasureInput& ping, const PingMask& mask, const MedianParams& median, double tolerance_db,
                        std::uint64_t seed, std::size_t pings, const MeasureParams& measure,
                        const ErrorParams& params) {
  Repeats repeats;
  // Unfiltered, the echo's own fading cannot be told from what fades.
  if (!params.enabled || !median.enabled || ping.filtered.data() == nullptr || std::isnan(ping.threshold_db)) {
    return repeats;
  }
  const auto add = [&](const MeasureInput& input, const PingMask& other) {
    repeats.emplace_back();
    const FigureValues figures = other.empty() ? unknown_figures() : figures_of(measure_row(input, other, measure));
    std::transform(figures.begin(), figures.end(), repeats.back().begin(),
                   [](double v) { return static_cast<float>(v); });
  };
  PingRepeater repeater(ping, mask, median, tolerance_db);
  const int fadings = fadings_of_ping(pings);
  for (int k = 0; k < fadings; ++k) {
    const PingMask other = repeater.under_fading(seed + static_cast<std::uint64_t>(k));
    MeasureInput input = ping;
    input.sv = repeater.sv();
    input.filtered = repeater.filtered();
    input.threshold_db = repeater.threshold_db();
    add(input, other);
  }
  for (const double step_db : {-params.threshold_db, params.threshold_db}) {
    MeasureInput input = ping;
    input.threshold_db += step_db;
    add(input, repeater.at_threshold(step_db));
  }
  return repeats;
}

FigureValues school_errors(std::span<const SchoolPingRow> rows, std::span<const Repeats* const> repeats,
                           const SummariseParams& summary, const ErrorParams& params) {
  SONAR_CHECK(rows.size() == repeats.size() && !rows.empty());
  FigureValues errors = unknown_figures();
  std::size_t fadings = kFadings;  // of the ping that has fewest
  for (const Repeats* one : repeats) {
    // They may come from a file that anyone can write.
    if (one->size() < kLeastFadings + 2 || one->size() > kFadings + 2) return errors;
    fadings = std::min(fadings, one->size() - 2);
  }
  std::vector<FigureValues> others;
  for (std::size_t k = 0; k < kFadings; ++k) {
    const auto which = [&](std::size_t ping) { return turned(k, ping, repeats[ping]->size() - 2); };
    others.push_back(repeated(rows, repeats, which, summary));
  }
  const auto last = [&](std::size_t back) {
    return repeated(
        rows, repeats, [&](std::size_t ping) { return repeats[ping]->size() - back; }, summary);
  };
  const FigureValues below = last(2);
  const FigureValues above = last(1);
  const SchoolRow school = summarise(rows, summary);
  const FigureValues figures = figures_of(school);
  for (std::size_t i = 0; i < kErrorCount; ++i) {
    std::vector<double> known;
    for (std::size_t k = 0; k < kFadings; ++k) {
      if (std::isfinite(others[k][i])) known.push_back(others[k][i]);
    }
    const double by_threshold = 0.5 * (above[i] - below[i]);
    const double common = common_error(kErrorColumns[i], figures[i], school, params);
    const double by_fading = spread(known, fadings);
    if (is_count(kErrorColumns[i].figure) && by_fading == 0.0 && by_threshold == 0.0) continue;
    errors[i] = std::sqrt(by_fading * by_fading + by_threshold * by_threshold + common * common);
  }
  return errors;
}

}  // namespace sonar
