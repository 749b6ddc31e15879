// SPDX-License-Identifier: Apache-2.0
#include "school/candidates.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "base/units.h"
#include "school/recorded_ends.h"

namespace sonar {
namespace {

constexpr int kBlock = 16;
constexpr int kSumTable = 3072;  // 36 dB apart the weaker adds less than a thousandth

/// What the weaker of two levels adds to the stronger, counts, by their distance in counts.
const std::array<int, kSumTable>& added_counts() {
  static const std::array<int, kSumTable> table = [] {
    std::array<int, kSumTable> t{};
    for (int d = 0; d < kSumTable; ++d) {
      const double sum_db = 10.0 * std::log10(1.0 + linear_from_db(-db_from_counts(d)));
      t[static_cast<std::size_t>(d)] = static_cast<int>(std::lround(counts_from_db(sum_db)));
    }
    return t;
  }();
  return table;
}

int level_sum(int a, int b) {
  const int apart = std::abs(a - b);
  return std::max(a, b) + (apart < kSumTable ? added_counts()[static_cast<std::size_t>(apart)] : 0);
}

int rounded_counts(double counts) {
  return static_cast<int>(std::lround(std::clamp(counts, double{kMinCount}, double{kMaxCount})));
}

/// By which every median of Rayleigh-fading echo lies below its mean.
int median_of_mean_counts() {
  static const int counts = rounded_counts(counts_from_db(db_from_linear(std::numbers::ln2)));
  return counts;
}

}  // namespace

Thresholder::Thresholder(View3<const std::int16_t> sv, View3<const SampleFlags> flags, const Background& background,
                         WaterLevels water, const PingMask* taken)
    : sv_(sv),
      flags_(flags),
      background_(background),
      water_(std::move(water)),
      taken_(taken),
      ends_(recorded_ends(flags)) {
  water_.reverberation.resize(static_cast<std::size_t>(sv.shape().samples), kMinCount);
  if (taken_ != nullptr) taken_rows_ = index_rows(taken_->runs, sv.shape().rows());
}

void Thresholder::cut(int row, int first, int end, std::vector<Run>& runs) const {
  if (taken_ != nullptr) {
    const auto r = static_cast<std::size_t>(row);
    for (int i = taken_rows_[r]; i < taken_rows_[r + 1]; ++i) {
      const Run& run = taken_->runs[static_cast<std::size_t>(i)];
      if (run.end() <= first || run.first_sample >= end) continue;
      if (run.first_sample > first) runs.push_back({row, first, run.first_sample - first});
      first = std::max(first, static_cast<int>(run.end()));
    }
  }
  if (first < end) runs.push_back({row, first, end - first});
}

std::vector<Run> Thresholder::candidates(double floor_db, double margin_db) const {
  const int floor = rounded_counts(counts_from_db(floor_db));
  const Shape3 shape = sv_.shape();
  std::vector<Run> runs;
  // The water's level is a median of many as the filtered samples are; the margin counts from means.
  const int above_water = rounded_counts(counts_from_db(margin_db)) - median_of_mean_counts();
  const double above_noise = std::max(counts_from_db(margin_db), static_cast<double>(water_.noise_reach));
  std::vector<int> quiet_limit(water_.reverberation.size());
  std::transform(water_.reverberation.begin(), water_.reverberation.end(), quiet_limit.begin(),
                 [&](int water) { return std::max(floor, water + above_water); });
  for (int row = 0; row < static_cast<int>(shape.rows()); ++row) {
    const std::int16_t* counts = sv_.row(row).data();
    const SampleFlags* flags = flags_.row(row).data();
    const bool known = background_.known(row);
    const int level = known ? rounded_counts(background_.power_counts(row) + above_noise) : 0;
    const std::int16_t* table = known ? background_.calibration.row(row).data() : nullptr;
    const auto limit = [&](int s) {
      const int quiet = quiet_limit[static_cast<std::size_t>(s)];
      return table != nullptr ? std::max(quiet, level + table[s]) : quiet;
    };
    const int recorded = ends_[static_cast<std::size_t>(row / shape.beams)];
    int start = -1;
    for (int block = 0; block < recorded; block += kBlock) {
      const int end = std::min(block + kBlock, recorded);
      if (start < 0 && end - block == kBlock) {
        int hit = 0;
        for (int j = 0; j < kBlock; ++j) hit |= counts[block + j] >= floor ? 1 : 0;
        if (hit == 0) continue;
      }
      for (int s = block; s < end; ++s) {
        const bool member = counts[s] >= floor && counts[s] >= limit(s) && !any(flags[s] & kNeverMember);
        if (member && start < 0) start = s;
        if (!member && start >= 0) {
          cut(row, start, s, runs);
          start = -1;
        }
      }
    }
    if (start >= 0) cut(row, start, recorded, runs);
  }
  return runs;
}

std::vector<Run> Thresholder::above(const IndexBox& box, double level_db, double rest_db) const {
  const int level = rounded_counts(std::ceil(counts_from_db(level_db) - 1e-9));
  const int rest = rounded_counts(counts_from_db(rest_db));
  std::vector<Run> runs;
  for (int fan = box.first_fan; fan <= box.last_fan; ++fan) {
    const int last = std::min(box.last_sample, ends_[static_cast<std::size_t>(fan)] - 1);
    for (int beam = box.first_beam; beam <= box.last_beam; ++beam) {
      const int row = fan * sv_.shape().beams + beam;
      const auto counts = sv_.row(row);
      const auto flags = flags_.row(row);
      const bool known = background_.known(row);
      const int mean = known ? rounded_counts(background_.power_counts(row)) : 0;
      const auto limit = [&](std::size_t s) {
        int median = water_.reverberation[s];
        if (known) median = std::max(median, mean + median_of_mean_counts() + background_.calibration.row(row)[s]);
        return std::max(level_sum(level, median), median - median_of_mean_counts() + rest);
      };
      int start = -1;
      for (int s = box.first_sample; s <= last + 1; ++s) {
        const auto i = static_cast<std::size_t>(s);
        const bool member = s <= last && counts[i] >= level && counts[i] != kNoData && !any(flags[i] & kNeverMember) &&
                            counts[i] >= limit(i);
        if (member && start < 0) start = s;
        if (!member && start >= 0) {
          cut(row, start, s, runs);
          start = -1;
        }
      }
    }
  }
  return runs;
}

}  // namespace sonar
