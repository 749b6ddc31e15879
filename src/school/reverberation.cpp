// SPDX-License-Identifier: Apache-2.0
#include "school/reverberation.h"

#include <algorithm>
#include <cstddef>
#include <numbers>

#include "base/units.h"

namespace sonar {
namespace {

constexpr int kStep = 8;  ///< samples between two looks: the filter is longer than that

/// From which count on a sample of each row stands out of its beam's noise, less the beam's calibration.
std::vector<int> noise_limits(const Background& noise, double above_db, std::size_t rows) {
  const double median_db = db_from_linear(std::numbers::ln2) + above_db;
  std::vector<int> limits(rows, kMinCount);
  for (std::size_t row = 0; row < rows; ++row) {
    if (!noise.known(static_cast<int>(row))) continue;
    limits[row] = static_cast<int>(noise.power_counts(static_cast<int>(row)) + counts_from_db(median_db));
  }
  return limits;
}

struct Water {
  View3<const std::int16_t> sv;
  View3<const SampleFlags> flags;
  const Background& noise;
  const DetectParams& params;
  std::vector<int> noise_limit;  ///< [row]

  [[nodiscard]] bool stands_out(int row, std::size_t sample, int count) const {
    const int limit = noise_limit[static_cast<std::size_t>(row)];
    return limit == kMinCount || count > limit + noise.calibration.row(row)[sample];
  }
};

/// The water_share quantile of what is open at one sample; kMinCount where that is no louder than least.
std::int16_t level_at(const Water& water, std::size_t sample, int least, std::vector<std::int16_t>& values) {
  const auto& [sv, flags, noise, params, noise_limit] = water;
  const double share = params.water_share;
  values.clear();
  std::size_t loud = 0;
  for (int row = 0; row < static_cast<int>(sv.shape().rows()); ++row) {
    const std::int16_t count = sv.row(row)[sample];
    if (count == kNoData || any(flags.row(row)[sample] & kNeverMember)) continue;
    const bool is_loud = count > least && water.stands_out(row, sample, count);
    values.push_back(is_loud ? count : std::int16_t{kMinCount});
    loud += is_loud ? 1 : 0;
  }
  const auto open = static_cast<double>(values.size());
  if (open < params.water_open_share * static_cast<double>(sv.shape().rows())) return kMinCount;
  if (static_cast<double>(loud) <= (1.0 - share) * open) return kMinCount;
  const auto rank = values.begin() + static_cast<std::ptrdiff_t>(share * open);
  std::nth_element(values.begin(), rank, values.end());
  return *rank;
}

}  // namespace

std::vector<std::int16_t> reverberation_counts(View3<const std::int16_t> sv, View3<const SampleFlags> flags,
                                               const Background& noise, const DetectParams& params) {
  const int samples = sv.shape().samples;
  std::vector<std::int16_t> level(static_cast<std::size_t>(samples), kMinCount);
  if (!(params.water_share > 0.0) || !(params.water_share < 1.0)) return level;
  std::vector<std::int16_t> values;
  values.reserve(sv.shape().rows());
  const Water water{sv, flags, noise, params, noise_limits(noise, params.water_above_noise_db, sv.shape().rows())};
  const int least = least_background(params);
  const auto look = [&](int sample) { return int{level_at(water, static_cast<std::size_t>(sample), least, values)}; };
  int here = samples > 0 ? look(0) : kMinCount;
  for (int first = 0; first < samples; first += kStep) {
    const int next = first + kStep < samples ? look(first + kStep) : here;
    for (int s = first; s < std::min(first + kStep, samples); ++s) {
      const bool both = here > kMinCount && next > kMinCount;
      const int between = both ? here + (next - here) * (s - first) / kStep : std::max(here, next);
      level[static_cast<std::size_t>(s)] = static_cast<std::int16_t>(between);
    }
    here = next;
  }
  return level;
}

}  // namespace sonar
