// SPDX-License-Identifier: Apache-2.0
#include "school/noise_reach.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "base/units.h"

namespace sonar {
namespace {

constexpr int kStep = 16;  ///< samples between two looks: neighbours share most of the filter's box

int quantile(std::vector<int>& values, double share) {
  const auto rank = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size()));
  std::nth_element(values.begin(), rank, values.end());
  return *rank;
}

}  // namespace

std::int16_t noise_reach(View3<const std::int16_t> sv, View3<const SampleFlags> flags, const Background& noise,
                         std::span<const std::int16_t> reverberation, const DetectParams& params) {
  const int least = least_background(params);
  std::vector<int> above;
  const int samples = sv.shape().samples;
  for (int row = 0; row < static_cast<int>(sv.shape().rows()); ++row) {
    if (!noise.known(row)) continue;
    const auto power = static_cast<int>(std::lround(noise.power_counts(row)));
    const std::int16_t* calibration = noise.calibration.row(row).data();
    const std::int16_t* counts = sv.row(row).data();
    const SampleFlags* flag = flags.row(row).data();
    for (int s = row % kStep; s < samples; s += kStep) {
      if (reverberation[static_cast<std::size_t>(s)] > kMinCount) continue;
      if (calibration[s] == kNoData || counts[s] == kNoData || any(flag[s] & kNeverMember)) continue;
      const int level = power + calibration[s];
      if (level >= least) above.push_back(counts[s] - level);
    }
  }
  if (above.size() < static_cast<std::size_t>(params.noise_min_samples)) return kMinCount;
  const int middle = quantile(above, 0.5);
  const int low = quantile(above, params.noise_low_percentile / 100.0);
  const double reach = middle + params.noise_sigmas * (middle - low);
  const double most = std::trunc(counts_from_db(params.background_margin_db + params.noise_most_db));
  return static_cast<std::int16_t>(std::clamp(reach, double{kMinCount}, most));
}

}  // namespace sonar
