// SPDX-License-Identifier: Apache-2.0
#include "session/slices/slice_look.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/units.h"

namespace sonar {

FlagStyle flag_style(const DisplayParams& display) {
  FlagStyle style;
  const SampleFlags faults = kFault;
  switch (display.removed) {
    case NoiseLook::shown:
      break;
    case NoiseLook::hatched:
      style.hatched = faults;
      style.faded = kNeverMember;
      break;
    case NoiseLook::transparent:
      style.hidden = faults | kNeverMember;
      break;
  }
  if (display.weak == NoiseLook::hatched) style.hatched |= SampleFlags::low_snr;
  if (display.weak == NoiseLook::transparent) style.faded |= SampleFlags::low_snr;
  return style;
}

SvColours slice_colours(const Workspace& workspace) {
  const SvScale& scale = workspace.display.values().scale;
  if (workspace.curve_follows_scale()) return sv_colours(scale);
  return sv_colours(workspace.view_curve(), scale.threshold_db, scale.no_data);
}

void flag_weak_rows(const StagedPing& ping, const std::vector<int>& rows, double margin_db, View3<SampleFlags> out) {
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

std::optional<double> signal_to_noise_db(const StagedPing& ping, int row, int sample) {
  const Background background = ping.background();
  const std::int16_t count = ping.filtered->counts.view().row(row)[static_cast<std::size_t>(sample)];
  if (!background.known(row) || count == kNoData) return std::nullopt;
  const std::int16_t calibration = background.calibration.row(row)[static_cast<std::size_t>(sample)];
  if (calibration == kNoData) return std::nullopt;
  return db_from_counts(count - calibration - background.power_counts(row));
}

}  // namespace sonar
