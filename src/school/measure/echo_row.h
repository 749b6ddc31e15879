// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>

#include "base/units.h"
#include "model/volume.h"
#include "school/detect/noise_level.h"
#include "school/measure/measure_input.h"

namespace sonar {

/// One row's echo, linear; faulty samples are filled from the filtered volume.
class EchoRow {
 public:
  EchoRow(const MeasureInput& ping, int row, double background_factor)
      : sv_(ping.sv.row(row)),
        flags_(ping.flags.row(row)),
        background_(ping.background, row),
        background_factor_(background_factor) {
    if (ping.filtered.data() != nullptr) filtered_ = ping.filtered.row(row);
  }
  /// Whether the sample itself is sound, so that nothing stands in for it.
  [[nodiscard]] bool heard(int sample) const {
    const auto i = static_cast<std::size_t>(sample);
    return !any(flags_[i] & (kFault | kNeverMember)) && sv_[i] != kNoData;
  }
  /// Echo and the background in it; false where nothing is known.
  [[nodiscard]] bool at(int sample, double& echo, double& background) const {
    const auto i = static_cast<std::size_t>(sample);
    if (any(flags_[i] & kNeverMember)) return false;
    background = background_factor_ * background_(sample);
    if (heard(sample)) {
      echo = linear_from_count(sv_[i]);
      return true;
    }
    if (filtered_.empty() || filtered_[i] == kNoData) return false;
    echo = linear_from_count(filtered_[i]) / std::numbers::ln2;  // median of Rayleigh fading
    return true;
  }

 private:
  std::span<const std::int16_t> sv_;
  std::span<const SampleFlags> flags_;
  std::span<const std::int16_t> filtered_;
  RowBackground background_;
  double background_factor_;
};

}  // namespace sonar
