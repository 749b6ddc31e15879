// SPDX-License-Identifier: Apache-2.0
// sonar_bench_errors [BODIES [LOOKS [PINGS [SEED [FADING]]]]]: whether the standard errors of schools tell how schools scatter.
// Random bodies (ellipsoids, bent and hollow ones), each looked at LOOKS times in PINGS pings, are masked by the program's own
// growth from the body's loudest voxel of the look, and measured. What is measured meets other errors too, drawn anew for each
// look: of the threshold, the calibration, the sound speed and the tilt, as large as the recipe's. Truth is the mean of what 30
// other looks are measured as without these: the band tells how well a figure can be repeated, and not how far off a mask is
// from the school. No look is left out. For each column: the looks whose figure has a band and those where it has none, the
// share of looks whose 95 % band holds the truth, 95 % limits of that share (Wilson, looks taken as independent), and the root
// of mean squares of told over true errors by fading. FADING: own (each fan has its frequency) or shared (all fans one). Ends
// with 1 where the limits of a column lie outside 93 to 97 %.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <optional>
#include <string>
#include <vector>

#include "school/grow/grow.h"
#include "school/measure/correct_sizes.h"
#include "school/measure/measure.h"
#include "school/measure/school_errors.h"
#include "school_looks.h"

namespace sonar::bench {
namespace {

constexpr double kPulse_m = 1.5104;
constexpr double kTolerance_db = 10.0;
constexpr int kTruthLooks = 30;
constexpr double kNormal = 1.95996;

/// Of the processor: others may be at work as well.
double ms_since(std::clock_t start) { return 1000.0 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC; }

struct Costs {
  double measuring = 0.0;
  double repeating = 0.0;
  int pings = 0;
};

/// One school, as often as it is looked at.
class School {
 public:
  School(Random& random, bool own_frequencies, int pings)
      : random_(random), body_(random_body(random)), water_(body_, own_frequencies), pings_(pings) {
    fill(water_, body_, random);
    truth_ = test::truth_of(water_.expected);
    const Shape3 shape = water_.expected.shape();
    flags_ = Array3<SampleFlags>(shape);
    flat_.emplace(shape);
    IndexBox box = box_of(truth_, shape.beams).enlarged(3, 3, 40).clipped(shape);
    fading_.emplace(water_, box, kPulse_m, own_frequencies);
    box_ = box;
    placement_.transducer = {60.0, 4.0};
    placement_.transducer_depth_m = 7.0;
  }

  /// One look, of several pings; repeats are wanted where they are not null.
  std::vector<SchoolPingRow> look(double tolerance_db, std::vector<Repeats>* repeats, Costs& costs) {
    std::vector<MeasuredSchool> seen;
    for (int ping = 0; ping < pings_; ++ping) {
      see();
      const double loud_db = db_from_counts(percentile(filtered_.view(), truth_, 0.95));
      const std::array<VoxelIndex, 1> seed{loudest()};
      const PingMask mask =
          grow(filtered_.view(), flags_.view(), MemberTable::one_sided(loud_db, tolerance_db), seed, {});
      const MeasureInput input = input_of(loud_db - tolerance_db);
      const auto start = std::clock();
      seen.push_back(measure(input, mask, measure_));
      seen.back().row.ping_index = ping;
      seen.back().row.time_utc = TimeNs{2'000'000'000} * ping;
      if (repeats == nullptr) continue;
      costs.measuring += ms_since(start);
      const auto again = std::clock();
      repeats->push_back(measure_repeats(
          input, mask, MedianParams{}, kTolerance_db, random_(),
          fadings_of_ping(static_cast<std::size_t>(ping), static_cast<std::size_t>(pings_)), measure_, errors_));
      costs.repeating += ms_since(again);
      ++costs.pings;
    }
    SchoolThroughPings school;
    for (const MeasuredSchool& one : seen) school.push_back(&one);
    return correct_sizes({school}, measure_);
  }

 private:
  void see() {
    const Array3<double> fading = fading_->look(random_);
    const Shape3 shape = water_.expected.shape();
    const double noise = linear_from_db(test::kNoise_db);
    counts_ = Array3<std::int16_t>(shape, count_from_linear(noise));
    for (int f = 0; f < box_.fans(); ++f) {
      for (int b = 0; b < box_.beams(); ++b) {
        for (int s = 0; s < box_.samples(); ++s) {
          const double sv = water_.expected(box_.first_fan + f, box_.first_beam + b, box_.first_sample + s);
          counts_(box_.first_fan + f, box_.first_beam + b, box_.first_sample + s) =
              count_from_linear((sv + noise) * fading(f, b, s));
        }
      }
    }
    filtered_ = test::filtered(counts_, flags_);
  }

  [[nodiscard]] VoxelIndex loudest() const {
    VoxelIndex at{truth_.runs.front().row, truth_.runs.front().first_sample};
    std::int16_t most = kMinCount;
    for (const Run& run : truth_.runs) {
      for (int s = run.first_sample; s < run.end(); ++s) {
        const std::int16_t count = filtered_.view().row(run.row)[static_cast<std::size_t>(s)];
        if (count > most) at = {run.row, s}, most = count;
      }
    }
    return at;
  }

  [[nodiscard]] MeasureInput input_of(double threshold_db) const {
    MeasureInput input;
    input.sv = counts_.view();
    input.filtered = filtered_.view();
    input.flags = flags_.view();
    input.sector = &water_.sector;
    input.grid = &water_.grid;
    input.background = {flat_->power_db, flat_->calibration.view()};
    input.placement = placement_;
    input.pulse_m = kPulse_m;
    input.threshold_db = threshold_db;
    return input;
  }

  Random& random_;
  Body body_;
  Water water_;
  int pings_;
  PingMask truth_;
  Array3<SampleFlags> flags_;
  std::optional<test::FlatBackground> flat_;
  std::optional<Fading> fading_;
  IndexBox box_;
  Placement placement_;
  Array3<std::int16_t> counts_;
  Array3<std::int16_t> filtered_;
  MeasureParams measure_;

 public:
  ErrorParams errors_ = [] {
    ErrorParams params;
    params.enabled = true;
    return params;
  }();
};

/// Of one column.
struct Tally {
  int looks = 0;
  int covered = 0;
  int unknown = 0;  ///< a figure, and no error
  double told = 0.0;
  double scatter = 0.0;
  double bias = 0.0;
};

/// What calibration, sound speed and tilt make of a figure.
double disturbed(const ErrorColumn& column, double figure, double horizontal_range_m, double calibration_db,
                 double faster, double tilt_rad) {
  if (column.figure == "depth_m" || column.figure == "surface_distance_m") {
    return 7.0 + (figure - 7.0) * faster + horizontal_range_m * tilt_rad;
  }
  const bool is_level = column.figure.starts_with("sv_") && column.figure.ends_with("_db");
  if (is_level) return figure + calibration_db + db_from_linear(faster);
  if (column.figure == "backscatter_m2") return figure * linear_from_db(calibration_db) * std::pow(faster, 4);
  if (column.figure == "nasc_m2_nmi2") return figure * linear_from_db(calibration_db) * std::pow(faster, 2);
  const int power = column.unit == "m" ? 1 : column.unit == "m2" ? 2 : column.unit == "m3" ? 3 : 0;
  return figure * std::pow(faster, power);
}

void test_school(School& school, int looks, Random& random, std::array<Tally, kErrorCount>& tallies, Costs& costs) {
  std::array<std::vector<double>, kErrorCount> others;
  for (int k = 0; k < kTruthLooks; ++k) {
    const FigureValues figures = figures_of(summarise(school.look(kTolerance_db, nullptr, costs), {}));
    for (std::size_t i = 0; i < kErrorCount; ++i) {
      if (std::isfinite(figures[i])) others[i].push_back(figures[i]);
    }
  }
  std::normal_distribution<double> normal;
  for (int k = 0; k < looks; ++k) {
    std::vector<Repeats> repeats;
    const ErrorParams& params = school.errors_;
    const auto rows = school.look(kTolerance_db + params.threshold_db * normal(random), &repeats, costs);
    std::vector<const Repeats*> all;
    for (const Repeats& one : repeats) all.push_back(&one);
    const SchoolRow row = summarise(rows, {});
    const FigureValues figures = figures_of(row);
    const FigureValues errors = school_errors(rows, all, {}, params);
    ErrorParams fading_only;
    fading_only.threshold_db = fading_only.calibration_db = fading_only.sound_speed_percent = fading_only.tilt_deg =
        0.0;
    for (Repeats& one : repeats) {
      if (!one.empty()) one.end()[-2] = one.end()[-3];
    }
    const FigureValues by_fading = school_errors(rows, all, {}, fading_only);
    const double calibration_db = params.calibration_db * normal(random);
    const double faster = 1.0 + params.sound_speed_percent / 100.0 * normal(random);
    const double tilt_rad = rad_from_deg(params.tilt_deg) * normal(random);
    for (std::size_t i = 0; i < kErrorCount; ++i) {
      if (!std::isfinite(figures[i]) || others[i].size() < kTruthLooks / 2) continue;
      Tally& tally = tallies[i];
      if (!std::isfinite(errors[i])) {
        ++tally.unknown;
        continue;
      }
      double mean = 0.0;
      double variance = 0.0;
      for (const double one : others[i]) mean += one / static_cast<double>(others[i].size());
      for (const double one : others[i])
        variance += (one - mean) * (one - mean) / static_cast<double>(others[i].size() - 1);
      const bool changes = variance > 1e-18 * mean * mean;  // rounding
      const double seen =
          disturbed(kErrorColumns[i], figures[i], row.horizontal_range_m, calibration_db, faster, tilt_rad);
      ++tally.looks;
      if (std::abs(seen - mean) <= kNormal * errors[i] + 1e-9 * std::abs(mean)) ++tally.covered;  // rounding

      if (!changes) continue;
      // in units of the figure's mean, so that no large school outweighs all others
      const double scale = 1.0 / std::max(std::abs(mean), 0.1);
      tally.told += std::pow(by_fading[i] * scale, 2);
      tally.scatter += variance * scale * scale;
    }
  }
}

struct Limits {
  double low = 0.0;
  double high = 1.0;
};
/// source  Wilson 1927
Limits wilson(int hits, int tries) {
  const double n = tries;
  const double p = hits / n;
  const double z2 = kNormal * kNormal;
  const double middle = (p + z2 / (2.0 * n)) / (1.0 + z2 / n);
  const double half = kNormal / (1.0 + z2 / n) * std::sqrt(p * (1.0 - p) / n + z2 / (4.0 * n * n));
  return {middle - half, middle + half};
}

bool print(const std::array<Tally, kErrorCount>& tallies) {
  bool good = true;
  fmt::print("{:26} {:>6} {:>8} {:>7} {:>14} {:>10}\n", "figure", "looks", "no band", "in band", "95 % limits",
             "told/true");
  for (std::size_t i = 0; i < kErrorCount; ++i) {
    const Tally& tally = tallies[i];
    if (tally.looks == 0) {
      fmt::print("{:26} {:>6} {:>8}\n", kErrorColumns[i].figure, 0, tally.unknown);
      continue;
    }
    const Limits limits = wilson(tally.covered, tally.looks);
    const bool inside = limits.high >= 0.93 && limits.low <= 0.97;
    good = good && inside;
    const double ratio = tally.scatter > 0.0 ? std::sqrt(tally.told / tally.scatter) : 0.0;
    fmt::print("{:26} {:6} {:8} {:6.1f}% {:6.1f}-{:5.1f}% {:10.2f}{}\n", kErrorColumns[i].figure, tally.looks,
               tally.unknown, 100.0 * tally.covered / tally.looks, 100.0 * limits.low, 100.0 * limits.high, ratio,
               inside ? "" : "  outside 93 to 97 %");
  }
  return good;
}

int run(int bodies, int looks, int pings, std::uint64_t seed, bool own_frequencies) {
  Random random(seed);
  std::array<Tally, kErrorCount> tallies{};
  Costs costs;
  for (int body = 0; body < bodies; ++body) {
    School school(random, own_frequencies, pings);
    test_school(school, looks, random, tallies, costs);
  }
  fmt::print("{} bodies, {} looks each, {} pings a look, seed {}, fans of {}\n", bodies, looks, pings, seed,
             own_frequencies ? "own frequencies" : "one frequency");
  fmt::print("measuring {:.1f} ms, measuring again {:.1f} ms of processor time a school ping\n",
             costs.measuring / costs.pings, costs.repeating / costs.pings);
  return print(tallies) ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace
}  // namespace sonar::bench

int main(int argc, char** argv) {
  const auto number = [&](int at, long otherwise) {
    return argc > at ? std::strtol(argv[at], nullptr, 10) : otherwise;
  };
  const bool own = argc <= 5 || std::string(argv[5]) == "own";
  return sonar::bench::run(static_cast<int>(number(1, 250)), static_cast<int>(number(2, 4)),
                           static_cast<int>(number(3, 1)), static_cast<std::uint64_t>(number(4, 1)), own);
}
