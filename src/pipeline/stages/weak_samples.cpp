// SPDX-License-Identifier: Apache-2.0
#include "pipeline/stages/weak_samples.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

#include "base/units.h"

namespace sonar {

void flag_weak_rows(const StagedPing& ping, std::span<const int> rows, double margin_db, View3<SampleFlags> out) {
  const Background background = ping.background();
  for (const int row : rows) {
    const auto flags = ping.filtered->flags.view().row(row);
    const auto to = out.row(row);
    if (!background.known(row)) {
      std::copy(flags.begin(), flags.end(), to.begin());
      continue;
    }
    const auto counts = ping.filtered->counts.view().row(row);
    const auto calibration = background.calibration.row(row);
    const int level =
        static_cast<int>(std::lround(std::clamp(background.power_counts(row) + counts_from_db(margin_db), -1e6, 1e6)));
    for (std::size_t s = 0; s < to.size(); ++s) {
      // Without a calibration the limit lies below every count.
      const bool weak = counts[s] != kNoData && counts[s] < level + calibration[s];
      to[s] = weak ? flags[s] | SampleFlags::low_snr : flags[s];
    }
  }
}

Array3<std::int16_t> counts_put_back(const StagedPing& ping, SampleFlags reasons) {
  Array3<std::int16_t> out = ping.filtered->counts;
  const auto flags = ping.filtered->flags.all();
  const auto recorded = ping.sv.counts.all();
  const auto to = out.all();
  for (std::size_t i = 0; i < to.size(); ++i) {
    const SampleFlags out_for = flags[i] & kNotFiltered;
    if (any(out_for) && (out_for & reasons) == out_for) to[i] = recorded[i];
  }
  return out;
}

std::optional<double> signal_to_noise_db(const StagedPing& ping, int row, int sample) {
  const Background background = ping.background();
  const std::int16_t count = ping.filtered->counts.view().row(row)[static_cast<std::size_t>(sample)];
  if (!background.known(row) || count == kNoData) return std::nullopt;
  const std::int16_t calibration = background.calibration.row(row)[static_cast<std::size_t>(sample)];
  if (calibration == kNoData) return std::nullopt;
  return db_from_counts(count - calibration - background.power_counts(row));
}

void flag_weak(const StagedPing& ping, double margin_db, View3<SampleFlags> out) {
  std::vector<int> rows(static_cast<std::size_t>(out.shape().rows()));
  std::iota(rows.begin(), rows.end(), 0);
  flag_weak_rows(ping, rows, margin_db, out);
}

}  // namespace sonar
