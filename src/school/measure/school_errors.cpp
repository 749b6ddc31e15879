// SPDX-License-Identifier: Apache-2.0
#include "school/measure/school_errors.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/check.h"
#include "base/units.h"
#include "school/measure/body_echo.h"
#include "school/measure/cell_steps.h"
#include "school/measure/correct_sizes.h"
#include "school/measure/fading_field.h"
#include "school/measure/measure.h"
#include "school/measure/repeat_ping.h"

namespace sonar {
namespace {

/// So many of a ping's repeats are not under other fading: two thresholds and the steps.
constexpr std::size_t kOthers = 3;
/// So many ways to put a school together of its pings' fadings: with 16, what they are drawn by adds as much as their number.
constexpr std::size_t kDraws = 64;
constexpr std::size_t kCorrectedVolume = error_at("volume_corrected_m3");
constexpr std::size_t kCorrectedSv = error_at("sv_corrected_db");

/// Finds the figures that have an error, by the number of their column in a table.
struct FigureFinder {
  struct Place {
    std::size_t column;
    std::size_t figure;
  };
  std::vector<Place> found;  ///< rising
  std::size_t column = 0;
  void operator()(std::string_view name, std::string_view, const auto&) {
    for (std::size_t i = 0; i < kErrorCount; ++i) {
      if (kErrorColumns[i].figure == name) found.push_back({column, i});
    }
    ++column;
  }
};

/// visit(figure, value) for each figure of a row that has an error.
template <class Row>
void for_each_figure(Row& row, const auto& visit) {
  static const std::vector<FigureFinder::Place> kPlaces = [] {
    FigureFinder finder;
    Row any;
    columns(finder, any);
    return finder.found;
  }();
  std::size_t column = 0;
  auto next = kPlaces.begin();
  const auto visitor = [&](std::string_view, std::string_view, auto&& value) {
    if (next == kPlaces.end() || column++ != next->column) return;
    if constexpr (std::is_same_v<std::remove_cvref_t<decltype(value)>, double>) visit(next->figure, value);
    ++next;
  };
  columns(visitor, row);
}

template <class Row>
FigureValues read_figures(Row row) {
  FigureValues out = unknown_figures();
  for_each_figure(row, [&](std::size_t i, double value) { out[i] = value; });
  return out;
}

/// Which of a ping's n repeats goes into the k-th of the school's: each as often, in another order for each ping.
std::size_t turned(std::size_t k, std::size_t ping, std::size_t n) {
  std::array<std::size_t, kFadings> order{};
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::uint64_t random = mixed(ping * kDraws + k / n);
  for (std::size_t i = n; i > 1; --i) {  // Fisher & Yates
    std::swap(order[i - 1], order[random % i]);
    random /= i;
  }
  return order[k % n];
}

/// A school's pings, each with the repeats that tell how its figures scatter.
class RepeatedSchool {
 public:
  RepeatedSchool(std::span<const SchoolPingRow> rows, std::span<const Repeats* const> repeats,
                 const SummariseParams& summary)
      : summary_(summary), rows_(rows.begin(), rows.end()), others_(rows_) {
    std::vector<std::size_t> known;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      figures_.push_back(figures_of(rows_[i]));
      // They may come from a file that anyone can write.
      if (repeats[i]->size() >= 2 + kOthers && repeats[i]->size() <= kFadings + kOthers) known.push_back(i);
    }
    std::size_t at = 0;
    for (std::size_t i = 0; i < rows_.size() && !known.empty(); ++i) {
      while (at + 1 < known.size() && known[at] + known[at + 1] < 2 * i) ++at;
      sources_.push_back({known[at], repeats[known[at]]});
      fadings_ = std::min(fadings_, repeats[known[at]]->size() - kOthers);
    }
  }
  [[nodiscard]] bool known() const { return !sources_.empty(); }
  /// Of the ping that has fewest.
  [[nodiscard]] std::size_t fadings() const { return fadings_; }
  /// The school under the k-th fading of all its pings.
  [[nodiscard]] FigureValues under_fading(std::size_t k) {
    return repeated([&](std::size_t ping, std::size_t n) { return turned(k, ping, n - kOthers); });
  }
  /// Under the threshold that stands so far from the end of its repeats.
  [[nodiscard]] FigureValues at_threshold(std::size_t from_end) {
    return repeated([&](std::size_t, std::size_t n) { return n - from_end; });
  }

  /// Variance of a figure that cells let stand still under all fadings though it may move, by the pings that summarise() uses.
  [[nodiscard]] double hidden_variance(std::size_t figure) const {
    const auto is_whole = [](const SchoolPingRow& row) { return row.touches_edge == 0; };
    const bool any_whole = std::any_of(rows_.begin(), rows_.end(), is_whole);
    double square = 0.0;
    double looks = 0.0;
    double pings = 0.0;
    std::size_t last = rows_.size();
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      if (any_whole && !is_whole(rows_[i])) continue;
      const Source& source = sources_[i];
      const double step = static_cast<double>(source.repeats->back()[figure]);
      square += step * step;
      pings += 1.0;
      if (source.ping != last) looks += static_cast<double>(source.repeats->size() - kOthers);
      last = source.ping;
    }
    const double share = 0.5 / (looks + 1.0);
    return square / pings * share * (1.0 - share) / pings;
  }

 private:
  struct Source {
    std::size_t ping;
    const Repeats* repeats;
  };

  /// which(ping, n) = index of its repeat among n
  FigureValues repeated(const auto& which) {
    bool told = true;  // how the corrected volume scatters
    for (std::size_t i = 0; i < others_.size(); ++i) {
      const auto& [ping, repeats] = sources_[i];
      const auto& repeat = (*repeats)[which(i, repeats->size())];
      for_each_figure(others_[i], [&](std::size_t at, double& value) {
        const auto again = static_cast<double>(repeat[at]);
        value = at == kCorrectedVolume ? figures_[i][at] * again : figures_[i][at] + (again - figures_[ping][at]);
      });
      // summarise() takes the echo of pings that know a corrected volume: no repeat changes which.
      if (std::isfinite(others_[i].volume_corrected_m3)) continue;
      told = told && std::isnan(figures_[i][kCorrectedVolume]);
      others_[i].volume_corrected_m3 = figures_[i][kCorrectedVolume];
    }
    FigureValues out = figures_of(summarise(others_, summary_));
    if (!told) out[kCorrectedVolume] = out[kCorrectedSv] = kUnknown;
    return out;
  }

  const SummariseParams& summary_;
  std::vector<SchoolPingRow> rows_;
  std::vector<SchoolPingRow> others_;
  std::vector<FigureValues> figures_;
  std::vector<Source> sources_;
  std::size_t fadings_ = kFadings;
};

/// Puts shares of their mean in the place of corrected volumes: in one ping alone they differ from what a ping and its
/// neighbours tell. A look that hides the body takes the share of the one before; unknown where half of them hide it.
/// looks  under other fading, and two other thresholds
void put_volume_shares(Repeats& looks) {
  const auto is_known = [](const auto& look) { return std::isfinite(look[kCorrectedVolume]); };
  const auto thresholds = looks.end() - 2;
  double sum = 0.0;
  std::ptrdiff_t known = 0;
  for (auto look = looks.begin(); look != thresholds; ++look) {
    if (!is_known(*look)) continue;
    sum += static_cast<double>((*look)[kCorrectedVolume]);
    ++known;
  }
  const bool tells = 2 * known > thresholds - looks.begin() && std::all_of(thresholds, looks.end(), is_known);
  double share = tells ? 1.0 : kUnknown;
  for (auto& look : looks) {
    if (tells && is_known(look)) share = static_cast<double>(look[kCorrectedVolume]) * static_cast<double>(known) / sum;
    look[kCorrectedVolume] = static_cast<float>(share);
  }
}

/// Figures of one ping's looks, corrected sizes by each look alone under the shape of beam that is likeliest for all.
Repeats figures_of_looks(const std::vector<MeasuredSchool>& looks, const MeasureParams& measure) {
  std::vector<SchoolThroughPings> alone;
  for (const MeasuredSchool& look : looks) alone.push_back({&look});
  Repeats repeats;
  for (const SchoolPingRow& row : correct_sizes(alone, measure)) {
    const FigureValues figures = figures_of(row);
    std::transform(figures.begin(), figures.end(), repeats.emplace_back().begin(),
                   [](double v) { return static_cast<float>(v); });
  }
  put_volume_shares(repeats);
  return repeats;
}

/// Their standard deviation, so much wider that 1.96 of it are the 95 % of Student's t for kErrorFreedom.
/// fadings  of a ping: where they are few, each comes up several times and the mean of a ping's hardly differs
double spread(const std::vector<double>& values, std::size_t fadings) {
  constexpr double kStudent = 2.1314 / 1.95996;
  if (2 * values.size() < kDraws) return kUnknown;
  // What stands still has exactly none: its mean may differ from it by what is rounded.
  if (std::all_of(values.begin(), values.end(), [&](double v) { return v == values.front(); })) return 0.0;
  double mean = 0.0;
  for (const double v : values) mean += v / static_cast<double>(values.size());
  double square = 0.0;
  for (const double v : values) square += (v - mean) * (v - mean);
  const auto n = static_cast<double>(fadings);
  return kStudent * std::sqrt(square / static_cast<double>(values.size()) * n / (n - 1.0));
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
                        std::uint64_t seed, std::size_t fadings, const MeasureParams& measure,
                        const ErrorParams& params) {
  // Unfiltered, the echo's own fading cannot be told from what fades.
  if (!params.enabled || fadings == 0 || !median.enabled || ping.filtered.data() == nullptr ||
      std::isnan(ping.threshold_db)) {
    return {};
  }
  std::vector<MeasuredSchool> looks;
  const auto add = [&](const MeasureInput& input, const PingMask& other) {
    MeasuredSchool& look = looks.emplace_back();
    if (other.empty()) return;
    look.row = measure_row(input, other, measure);
    if (std::isfinite(look.row.range_m)) look.body = body_echo(input, other, measure);
  };
  PingRepeater repeater(ping, mask, median, tolerance_db);
  for (std::size_t k = 0; k < fadings; ++k) {
    const PingMask other = repeater.under_fading(seed + k);
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
  Repeats repeats = figures_of_looks(looks, measure);
  repeats.emplace_back();
  const FigureValues steps = cell_steps(ping, mask, measure_row(ping, mask, measure));
  std::transform(steps.begin(), steps.end(), repeats.back().begin(), [](double v) { return static_cast<float>(v); });
  return repeats;
}

FigureValues school_errors(std::span<const SchoolPingRow> rows, std::span<const Repeats* const> repeats,
                           const SummariseParams& summary, const ErrorParams& params) {
  SONAR_CHECK(rows.size() == repeats.size() && !rows.empty());
  FigureValues errors = unknown_figures();
  RepeatedSchool again(rows, repeats, summary);
  if (!again.known()) return errors;
  std::vector<FigureValues> others;
  for (std::size_t k = 0; k < kDraws; ++k) others.push_back(again.under_fading(k));
  const FigureValues below = again.at_threshold(3);
  const FigureValues above = again.at_threshold(2);
  const SchoolRow school = summarise(rows, summary);
  const FigureValues figures = figures_of(school);
  for (std::size_t i = 0; i < kErrorCount; ++i) {
    std::vector<double> known;
    for (const FigureValues& one : others) {
      if (std::isfinite(one[i])) known.push_back(one[i]);
    }
    const double by_threshold = 0.5 * (above[i] - below[i]);
    const double common = common_error(kErrorColumns[i], figures[i], school, params);
    const double by_fading = std::max(spread(known, again.fadings()), std::sqrt(again.hidden_variance(i)));
    if (is_count(kErrorColumns[i].figure) && by_fading == 0.0 && by_threshold == 0.0) continue;
    errors[i] = std::sqrt(by_fading * by_fading + by_threshold * by_threshold + common * common);
  }
  return errors;
}

}  // namespace sonar
