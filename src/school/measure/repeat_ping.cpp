// SPDX-License-Identifier: Apache-2.0
#include "school/measure/repeat_ping.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "base/units.h"
#include "school/detect/noise_level.h"
#include "school/fading.h"
#include "school/grow/grow.h"
#include "school/measure/echo_row.h"

namespace sonar {
namespace {

/// splitmix64 (Steele, Lea & Flood 2014): a number for each number, whatever the order they are asked in.
std::uint64_t mixed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27U)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31U);
}
/// In (0, 1).
double uniform(std::uint64_t x) { return (static_cast<double>(mixed(x) >> 12U) + 0.5) / 4503599627370496.0; }

/// Mean length of blocks of k and k + 1 voxels, so that the mean square over the mean is the wanted number of voxels that
/// fade as one: the variance of a sum then is right.
double block_length(double alike) {
  const double k = std::floor(alike);
  return k * (k + 1.0) / (2.0 * k + 1.0 - alike);
}

/// Number of the block that a voxel lies in, counted from the grid's origin.
std::uint64_t block_of(int voxel, double length, double offset) {
  return static_cast<std::uint64_t>(std::floor((voxel + offset * length) / length) + 1.0);
}

std::int16_t clamped(double counts) {
  return static_cast<std::int16_t>(
      std::clamp(std::round(counts), static_cast<double>(kMinCount), static_cast<double>(kMaxCount)));
}

}  // namespace

PingRepeater::PingRepeater(const MeasureInput& ping, const PingMask& mask, const MedianParams& median,
                           double tolerance_db)
    : ping_(ping), mask_(mask), median_(median), tolerance_db_(tolerance_db) {
  constexpr int kBeams = 4;  // what the whole school's echo is summed over
  constexpr int kSamples = 32;
  const Shape3 shape = ping.sv.shape();
  box_ = box_of(mask, shape.beams).enlarged(kBeams, kBeams, kSamples).clipped(shape);
  const Shape3 size{box_.fans(), box_.beams(), box_.samples()};
  members_ = Array3<std::uint8_t>(size);
  next_to_ = Array3<std::uint8_t>(size);
  const int reach = median.kernel_samples / 2;
  std::size_t i = 0;
  for (const Run& run : mask.runs) {
    const int fan = run.row / shape.beams - box_.first_fan;
    const int beam = run.row % shape.beams - box_.first_beam;
    const int from = run.first_sample - box_.first_sample;
    for (int s = 0; s < run.count; ++s) members_(fan, beam, from + s) = mask.confidence[i++];
    for (int f = std::max(0, fan - 1); f <= std::min(size.fans - 1, fan + 1); ++f) {
      for (int b = std::max(0, beam - 1); b <= std::min(size.beams - 1, beam + 1); ++b) {
        const auto row = next_to_.row(f, b);
        std::fill(row.begin() + std::max(0, from - reach),
                  row.begin() + std::min(size.samples, from + run.count + reach), 1);
      }
    }
  }
  const int middle = mask.runs[mask.runs.size() / 2].row;
  const VoxelsAlike alike = voxels_alike_each_way(*ping.grid, ping.sector->range().spacing_m, ping.pulse_m, middle);
  alike_[0] = alike.fans;
  alike_[1] = alike.beams;
  alike_[2] = alike.samples;
  echo_of_level_ = echo_of_level();
}

double PingRepeater::echo_of_level() const {
  double echo = 0.0;
  double level = 0.0;
  for (const Run& run : mask_.runs) {
    const EchoRow row(ping_, run.row, 1.0);
    const auto sv = ping_.sv.row(run.row);
    const auto filtered = ping_.filtered.row(run.row);
    const int beams = ping_.sector->beams();
    const double solid_angle = ping_.sector->solid_angle_sr(run.row / beams, run.row % beams);
    for (int s = run.first_sample; s < run.end(); ++s) {
      const auto i = static_cast<std::size_t>(s);
      if (!row.heard(s) || filtered[i] == kNoData) continue;
      const double volume = solid_angle * ping_.sector->shell_m3_per_sr(s);
      echo += volume * linear_from_count(sv[i]);
      level += volume * linear_from_count(filtered[i]);
    }
  }
  return counts_from_db(echo > 0.0 && level > 0.0 ? db_from_linear(echo / level) : -kMedianOfMean_db);
}

Array3<std::int16_t> PingRepeater::fading(std::uint64_t seed) const {
  Array3<std::int16_t> counts(members_.shape());
  const std::uint64_t key = mixed(seed);
  std::array<double, 3> length{};
  std::array<double, 3> offset{};
  for (std::size_t k = 0; k < 3; ++k) {
    length[k] = block_length(alike_[k]);
    offset[k] = uniform(key + k + 1);
  }
  for (int f = 0; f < box_.fans(); ++f) {
    const std::uint64_t of_fan = mixed(key ^ block_of(box_.first_fan + f, length[0], offset[0]));
    for (int b = 0; b < box_.beams(); ++b) {
      const std::uint64_t of_beam = mixed(of_fan ^ block_of(box_.first_beam + b, length[1], offset[1]));
      std::uint64_t last = 0;
      std::int16_t echo = 0;
      const auto row = counts.row(f, b);
      for (int s = 0; s < box_.samples(); ++s) {
        const std::uint64_t block = block_of(box_.first_sample + s, length[2], offset[2]);
        if (s == 0 || block != last)
          echo = clamped(counts_from_db(db_from_linear(-std::log(uniform(of_beam ^ block)))));
        last = block;
        row[static_cast<std::size_t>(s)] = echo;
      }
    }
  }
  return counts;
}

double PingRepeater::loud_part_db(View3<const std::int16_t> change) const {
  constexpr double kLoud = 0.95;
  std::vector<double> before;
  std::vector<double> after;
  for (const Run& run : mask_.runs) {
    const auto counts = ping_.filtered.row(run.row);
    const auto moved = change.row(run.row / ping_.sv.shape().beams - box_.first_fan,
                                  run.row % ping_.sv.shape().beams - box_.first_beam);
    for (int s = run.first_sample; s < run.end(); ++s) {
      const std::int16_t count = counts[static_cast<std::size_t>(s)];
      if (count == kNoData) continue;
      before.push_back(count);
      after.push_back(count + moved[static_cast<std::size_t>(s - box_.first_sample)]);
    }
  }
  if (before.empty()) return 0.0;
  const auto rank = static_cast<std::ptrdiff_t>(kLoud * static_cast<double>(before.size() - 1));
  std::nth_element(before.begin(), before.begin() + rank, before.end());
  std::nth_element(after.begin(), after.begin() + rank, after.end());
  return db_from_counts(after[static_cast<std::size_t>(rank)] - before[static_cast<std::size_t>(rank)]);
}

PingMask PingRepeater::moved_mask(View3<const std::int16_t> change, double threshold_db) const {
  const int beams = ping_.sv.shape().beams;
  const double before = counts_from_db(ping_.threshold_db);
  const double now = counts_from_db(threshold_db);
  const double tolerance = counts_from_db(tolerance_db_);
  PingMask out;
  for (int f = 0; f < box_.fans(); ++f) {
    for (int b = 0; b < box_.beams(); ++b) {
      const int row = (box_.first_fan + f) * beams + box_.first_beam + b;
      const auto level = ping_.filtered.row(row);
      const auto flags = ping_.flags.row(row);
      const auto moved = change.row(f, b);
      PingMask run;
      bool holds = false;  // a member of old: nothing grows apart from the school
      const auto end_run = [&] {
        if (holds) {
          out.runs.insert(out.runs.end(), run.runs.begin(), run.runs.end());
          out.confidence.insert(out.confidence.end(), run.confidence.begin(), run.confidence.end());
        }
        run = {};
        holds = false;
      };
      for (int s = 0; s < box_.samples(); ++s) {
        const int sample = box_.first_sample + s;
        const auto i = static_cast<std::size_t>(sample);
        const std::uint8_t confidence = members_(f, b, s);
        const bool was = confidence > 0;
        const bool above = level[i] != kNoData && level[i] >= before;
        const double later = level[i] + moved[static_cast<std::size_t>(s)];
        bool is = was;
        // What stands against its threshold a human decided, or what lay beside it did: it stays.
        if (was == above && level[i] != kNoData) is = later >= now;
        if (!was && is) {
          const bool taken = ping_.others != nullptr && confidence_at(*ping_.others, row, sample) > 0;
          is = next_to_(f, b, s) > 0 && !any(flags[i] & kNeverMember) && !taken;
        }
        if (!is) {
          end_run();
          continue;
        }
        if (run.runs.empty()) run.runs.push_back({row, sample, 0});
        ++run.runs.back().count;
        const double below = was ? tolerance * std::sqrt(1.0 - confidence / 255.0) : tolerance;
        const double moved_below = std::clamp(below - moved[static_cast<std::size_t>(s)], 0.0, tolerance) / tolerance;
        run.confidence.push_back(quantised_confidence(1.0 - moved_below * moved_below));
        const bool beside = (b > 0 && members_(f, b - 1, s) > 0) ||
                            (b + 1 < box_.beams() && members_(f, b + 1, s) > 0) ||
                            (f > 0 && members_(f - 1, b, s) > 0) || (f + 1 < box_.fans() && members_(f + 1, b, s) > 0);
        holds = holds || was || beside;
      }
      end_run();
    }
  }
  return out;
}

PingMask PingRepeater::under_fading(std::uint64_t seed) {
  const Shape3 shape = ping_.sv.shape();
  if (sv_.all().empty()) {  // each repeat writes the same box anew
    sv_ = Array3<std::int16_t>(shape);
    filtered_ = Array3<std::int16_t>(shape);
    std::copy(ping_.sv.all().begin(), ping_.sv.all().end(), sv_.all().begin());
    std::copy(ping_.filtered.all().begin(), ping_.filtered.all().end(), filtered_.all().begin());
  }
  const Array3<std::int16_t> echo = fading(seed);
  Array3<std::int16_t> change(echo.shape());
  const Array3<SampleFlags> sound(echo.shape());
  median_into(echo.view(), sound.view(), median_, change.view());
  const double median_counts = counts_from_db(kMedianOfMean_db);
  for (std::int16_t& one : change.all()) one = clamped(one - median_counts);
  for (int f = 0; f < box_.fans(); ++f) {
    for (int b = 0; b < box_.beams(); ++b) {
      const int row = (box_.first_fan + f) * shape.beams + box_.first_beam + b;
      const auto was = ping_.filtered.row(row);
      const auto sv = sv_.view().row(row);
      const auto filtered = filtered_.view().row(row);
      for (int s = 0; s < box_.samples(); ++s) {
        const auto i = static_cast<std::size_t>(box_.first_sample + s);
        if (was[i] == kNoData) continue;
        if (sv[i] != kNoData) sv[i] = clamped(was[i] + echo_of_level_ + echo(f, b, s));
        filtered[i] = clamped(was[i] + change(f, b, s));
      }
    }
  }
  return moved_mask(std::as_const(change).view(), ping_.threshold_db + loud_part_db(std::as_const(change).view()));
}

PingMask PingRepeater::at_threshold(double step_db) const {
  const Array3<std::int16_t> none(members_.shape());
  return moved_mask(none.view(), ping_.threshold_db + step_db);
}

}  // namespace sonar
