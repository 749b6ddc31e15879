// SPDX-License-Identifier: Apache-2.0
#include "school/detect/thresholder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "base/units.h"
#include "school/recorded_ends.h"

namespace sonar {
namespace {

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
  static const int counts = rounded_counts(counts_from_db(kMedianOfMean_db));
  return counts;
}

}  // namespace

Thresholder::RowWater::RowWater(const Background& background, const WaterLevels* water, int row, int beams) {
  if (background.known(row)) {
    power_ = rounded_counts(background.power_counts(row));
    calibration_ = background.calibration.row(row).data();
  }
  if (water == nullptr || !water->known()) return;
  water_ = water;
  const auto fan = static_cast<std::size_t>(row / beams) * static_cast<std::size_t>(water->places);
  level_ = water->level.data() + fan;
  reach_ = water->reach.data() + fan;
  blocks_ = 1.0 / water->block_samples;
  places_ = water->stretch_of(row) * blocks_;
  if (!water->patch.empty()) patch_ = water->patch.data() + static_cast<std::ptrdiff_t>(row) * water->blocks;
}

/// table  values at the middle of each of `count` pieces of range
/// at     0 = the middle of the first
template <class Value>
double Thresholder::RowWater::between(const Value* table, int count, double at) {
  at = std::clamp(at, 0.0, static_cast<double>(count - 1));
  const int piece = static_cast<int>(at);
  const int next = std::min(piece + 1, count - 1);
  const double here = table[piece];
  const double there = table[next];
  if (here <= kMinCount || there <= kMinCount) return std::max(here, there);
  return here + (there - here) * (at - piece);
}

double Thresholder::RowWater::at_place(const std::int16_t* table, int sample) const {
  return between(table, water_->places, (sample + 0.5) * places_ - 0.5);
}

int Thresholder::RowWater::mean(int sample) const {
  int level = kMinCount;
  if (calibration_ != nullptr) level = std::max(level, power_ + calibration_[sample]);
  if (water_ != nullptr) level = std::max(level, static_cast<int>(at_place(level_, sample)));
  if (patch_ != nullptr && level > kMinCount) {
    level += static_cast<int>(kPatchStep * between(patch_, water_->blocks, (sample + 0.5) * blocks_ - 0.5));
  }
  return level;
}

int Thresholder::RowWater::reach(int sample) const {
  return water_ == nullptr ? 0 : static_cast<int>(at_place(reach_, sample));
}

Thresholder::Thresholder(View3<const std::int16_t> sv, View3<const SampleFlags> flags, const Background& background,
                         const WaterLevels* water, const PingMask* taken)
    : sv_(sv), flags_(flags), background_(background), water_(water), taken_(taken), ends_(recorded_ends(flags)) {
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

template <class Member>
void Thresholder::collect(int row, int first, int end, const Member& member, std::vector<Run>& runs) const {
  end = std::min(end, ends_[static_cast<std::size_t>(row / sv_.shape().beams)]);
  int start = -1;
  for (int s = first; s < end; ++s) {
    const bool inside = member(s);
    if (inside && start < 0) start = s;
    if (!inside && start >= 0) {
      cut(row, start, s, runs);
      start = -1;
    }
  }
  if (start >= 0) cut(row, start, end, runs);
}

std::vector<Run> Thresholder::above_background(double margin_db) const {
  const int margin = rounded_counts(counts_from_db(margin_db)) + median_of_mean_counts();
  std::vector<Run> runs;
  for (int row = 0; row < static_cast<int>(sv_.shape().rows()); ++row) {
    const std::int16_t* counts = sv_.row(row).data();
    const SampleFlags* flags = flags_.row(row).data();
    const RowWater water(background_, water_, row, sv_.shape().beams);
    const auto member = [&](int s) {
      return counts[s] != kNoData && !any(flags[s] & kNeverMember) && counts[s] >= water.mean(s) + margin;
    };
    collect(row, 0, sv_.shape().samples, member, runs);
  }
  return runs;
}

std::vector<Run> Thresholder::above(const IndexBox& box, double level_db, double least_db) const {
  const int level = rounded_counts(std::ceil(counts_from_db(level_db) - 1e-9));
  const int least = rounded_counts(counts_from_db(least_db));
  std::vector<Run> runs;
  for (int fan = box.first_fan; fan <= box.last_fan; ++fan) {
    for (int beam = box.first_beam; beam <= box.last_beam; ++beam) {
      const int row = fan * sv_.shape().beams + beam;
      const std::int16_t* counts = sv_.row(row).data();
      const SampleFlags* flags = flags_.row(row).data();
      const RowWater water(background_, water_, row, sv_.shape().beams);
      const auto member = [&](int s) {
        if (counts[s] < level || counts[s] == kNoData || any(flags[s] & kNeverMember)) return false;
        const int mean = water.mean(s);
        return counts[s] >= level_sum(level, mean + median_of_mean_counts()) &&
               counts[s] >= mean + std::max(least, water.reach(s));
      };
      collect(row, box.first_sample, box.last_sample + 1, member, runs);
    }
  }
  return runs;
}

void Thresholder::background(int row, int first, int step, std::span<double> sv) const {
  const RowWater water(background_, water_, row, sv_.shape().beams);
  for (double& value : sv) {
    const int mean = water.mean(std::min(first, sv_.shape().samples - 1));
    value = mean > kMinCount ? linear_from_db(db_from_counts(mean)) : 0.0;
    first += step;
  }
}

}  // namespace sonar
