// SPDX-License-Identifier: Apache-2.0
#include "school/nadir_ring.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "base/units.h"

namespace sonar {
namespace {

constexpr int kStep = 4;  ///< samples between two looks: the filter is longer than that

std::int16_t median_of(std::vector<std::int16_t>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// What a fan hears at a sample, whatever the beam; kNoData where too few beams are open.
class FanLevel {
 public:
  FanLevel(View3<const std::int16_t> sv, View3<const SampleFlags> flags, const Background& noise,
           const DetectParams& params)
      : sv_(sv), flags_(flags), noise_(noise), least_known_(params.side_lobe_known_share * sv.shape().beams) {}

  std::int16_t operator()(int fan, int sample) {
    values_.clear();
    const auto s = static_cast<std::size_t>(sample);
    for (int beam = 0; beam < sv_.shape().beams; ++beam) {
      const std::int16_t count = sv_.row(fan, beam)[s];
      if (count != kNoData && !any(flags_.row(fan, beam)[s] & kNeverMember)) values_.push_back(count);
    }
    if (values_.empty() || static_cast<double>(values_.size()) < least_known_) return kNoData;
    return median_of(values_);
  }

  /// What the noise of half its beams gives there after the filter; kMinCount where no noise is known. It becomes louder
  /// with range by itself.
  std::int16_t noise(int fan, int sample) {
    values_.clear();
    for (int beam = 0; beam < sv_.shape().beams; ++beam) {
      const int row = fan * sv_.shape().beams + beam;
      if (!noise_.known(row)) continue;
      const double mean = noise_.power_counts(row) + noise_.calibration.row(row)[static_cast<std::size_t>(sample)];
      const double filtered = mean + counts_from_db(kMedianOfMean_db);
      values_.push_back(static_cast<std::int16_t>(std::clamp<double>(filtered, kMinCount, kMaxCount)));
    }
    return values_.empty() ? kMinCount : median_of(values_);
  }

 private:
  View3<const std::int16_t> sv_;
  View3<const SampleFlags> flags_;
  const Background& noise_;
  double least_known_;
  std::vector<std::int16_t> values_;
};

double share_within(const PingMask& mask, int first, int end) {
  int inside = 0;
  for (const Run& run : mask.runs) {
    inside += std::max(std::min(run.end(), end) - std::max(run.first_sample, first), 0);
  }
  return static_cast<double>(inside) / static_cast<double>(mask.voxels());
}

}  // namespace

bool is_nadir_ring(const PingMask& mask, const IndexBox& box, const Seabed& seabed, const Sector& sector,
                   View3<const std::int16_t> sv, View3<const SampleFlags> flags, const Background& noise,
                   const DetectParams& params) {
  if (!(params.ring_rise_db > 0.0) || !seabed.found || mask.empty()) return false;
  const int samples = sv.shape().samples;
  const double nearest_m = seabed.offset_m / std::hypot(1.0, seabed.slope_x, seabed.slope_y);
  const auto sample_at = [&](double share) {
    return std::clamp(static_cast<int>(sector.range().sample_at(share * nearest_m)), 0, samples);
  };
  const int first = sample_at(1.0 - params.ring_before);
  const int end = sample_at(1.0 + params.ring_reach);
  const int water_first = sample_at(1.0 - params.ring_water_first);
  const int water_end = sample_at(1.0 - params.ring_water_end);
  if (share_within(mask, first, end) < params.ring_inside_share) return false;
  FanLevel level(sv, flags, noise, params);
  std::vector<std::int16_t> rises;
  std::vector<std::int16_t> before;
  for (int fan = box.first_fan; fan <= box.last_fan; ++fan) {
    before.clear();
    for (int s = water_first; s < water_end; s += kStep) {
      if (const std::int16_t count = level(fan, s); count != kNoData) before.push_back(count);
    }
    if (before.empty()) continue;
    const int water = median_of(before);
    int most = kMinCount;
    for (int s = first; s < end; s += kStep) {
      const int count = level(fan, s);
      if (count != kNoData) most = std::max(most, count - std::max<int>(water, level.noise(fan, s)));
    }
    if (most > kMinCount) rises.push_back(static_cast<std::int16_t>(std::min<int>(most, kMaxCount)));
  }
  if (rises.empty() || db_from_counts(median_of(rises)) < params.ring_rise_db) return false;
  std::vector<std::int16_t> above;
  for (const Run& run : mask.runs) {
    for (int s = run.first_sample; s < run.end(); s += kStep) {
      const int around = level(run.row / sv.shape().beams, s);
      const int here = sv.row(run.row)[static_cast<std::size_t>(s)];
      above.push_back(static_cast<std::int16_t>(std::clamp(here - around, int{kMinCount}, int{kMaxCount})));
    }
  }
  return db_from_counts(median_of(above)) < params.ring_clear_db;
}

}  // namespace sonar
